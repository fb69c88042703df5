#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Opens a page of `oiler report` in Chromium and compares its contents with its own data.

    report_page.py PAGE    a line per failure; exits with 0 or 1

Needs Debian's chromium and nothing else.
"""
import json
import re
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from browser import failures_of

DATA = r'<script type="application/json" id="data">(.*?)</script>'
RAISED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹−", "-0123456789-")
PREFIX = {"n": 1e-9, "µ": 1e-6, "m": 1e-3, "": 1}


def shown(text, unit=""):
    """The number that a text such as `1.23·10⁻⁴ m` or `12.3 mm` stands for; None for a dash."""
    pattern = r"([-−]?[\d.,]+)(?:·10([⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+))?\s*([nµm]?)" + re.escape(unit) + r"(?![\w/])"
    match = re.search(pattern if unit else pattern.replace("([nµm]?)", "()"), text)
    if not match:
        return None
    mantissa = float(match[1].translate(RAISED).replace(",", ""))
    return mantissa * 10.0 ** int((match[2] or "0").translate(RAISED)) * PREFIX[match[3]]


def near(text, expected, unit="", within=0.006):
    value = shown(text, unit)
    if expected is None or value is None:
        return expected is None and value is None
    return abs(value - expected) <= within * abs(expected)


def close_to(a, b):
    return len(a) == len(b) and all(
        abs(x - y) <= 1e-9 * abs(y) for p, q in zip(a, b) for x, y in zip(p, q))


class Check:
    def __init__(self, browser, data):
        self.browser, self.data, self.failures = browser, data, []
        self.tradeoff, self.rows = data["tradeoff"], data["tradeoff"]["rows"]

    def expect(self, holds, words):
        if not holds:
            self.failures.append(words)

    def texts(self, selector):
        return self.browser.value(
            f"[...document.querySelectorAll({json.dumps(selector)})].map(e => e.innerText.trim())")

    def table(self, selector):
        return self.browser.value(f"""[...document.querySelectorAll({json.dumps(selector)})].map(
            r => [...r.cells].map(c => c.innerText.trim()))""")

    def sections(self):
        for part in ("advice", "tradeoff", "stability", "rates", "ledger"):
            there = self.browser.value(f"document.getElementById('{part}') !== null")
            self.expect(there == (self.data[part] is not None),
                        f"section {part} is {'there' if there else 'missing'}")

    def heading(self):
        title = self.tradeoff["title"] or self.tradeoff["scene"]
        self.expect(self.texts("h1") == [title], f"the heading is {self.texts('h1')}")
        # The placeholder of the title is filled by oiler, not by the page's own script.
        self.expect("@TITLE@" not in self.browser.value("document.title"), "@TITLE@ is left")
        self.expect(self.browser.value("document.getElementById('frame').naturalWidth") > 0,
                    "the frame is no picture")
        current, box = self.tradeoff["current"], " ".join(self.texts("#current dd"))
        for word in (current["method"], f"{current['rate']:,} Hz", current["precision"]):
            self.expect(word in box, f"the box of the current setting lacks {word}: {box}")
        row = next((r for r in self.rows if same(r, current)), None)
        if row and row["stable"] and row["position_error"] is not None:
            text = self.texts("#current dd")[3]
            self.expect(near(text, row["position_error"], "m"), f"the current error: {text}")

    def advice(self):
        advice = self.data["advice"]
        paragraphs = self.texts("#conclusion") + self.texts("#advice > p")
        words = [" ".join(paragraph.split()) for paragraph in advice["words"]]
        self.expect(paragraphs == words, f"the advice reads {paragraphs}")
        table = self.table("#advice tbody tr")
        rows = [("advice", advice["advice"]), ("runner-up", advice["runner_up"]),
                ("current", advice["current"]),
                *(("alternative", one) for one in advice["alternatives"] if "rate" in one)]
        rows = [(role, row) for role, row in rows if row]
        self.expect(len(table) == len(rows), f"{len(table)} rows of advice")
        for cells, (role, row) in zip(table, rows):
            self.expect(cells[:4] == [role, row["method"], f"{row['rate']:,}", row["precision"]]
                        and (cells[7] == row["why"] if "why" in row else cells[7])
                        and near(cells[5], row["energy_drift"])
                        and (row["position_error"] is None or near(cells[4], row["position_error"]))
                        and near(cells[6], micro(row["ns_per_second"])),
                        f"advice {row['method']} at {row['rate']} Hz reads {cells}")
            if role == "advice":
                text = " ".join(paragraphs)
                self.expect(row["method"] in text and re.search(rf"\b{row['rate']:,}\b|\b"
                                                                rf"{row['rate']}\b", text),
                            f"no paragraph advises {row['method']} at {row['rate']} Hz")

    def reference(self):
        reference, [text] = self.tradeoff["reference"], self.texts("#reference")
        self.expect(reference["words"] in text, f"the reference reads {text}")
        self.expect(("The errors cover" in text) == bool(reference["why_no_longer"]),
                    f"the time that the errors cover: {text}")

    def run_table(self):
        browser, selector = self.browser, "#tradeoff tbody tr"
        browser.click("document.querySelector('#tradeoff summary')")
        table = self.table(selector)
        self.expect(len(table) == len(self.rows), f"{len(table)} rows of {len(self.rows)} runs")
        for cells, row in zip(table, self.rows):
            self.expect(cells[:3] == [row["method"], row["precision"],
                                       f"{row['rate']:,}"]
                        and (row["below_floor"] or near(cells[3], row["position_error"]))
                        and near(cells[5], row["phase_error"])
                        and near(cells[8], micro(row["ns_per_second"])),
                        f"run {row['method']} at {row['rate']} Hz reads {cells}")
        for direction in (1, -1):
            browser.click("document.querySelectorAll('#tradeoff thead button')[3]")
            errors = [shown(cells[3]) for cells in self.table(selector)]
            numbers = [e for cells, e in zip(self.table(selector), errors)
                       if e is not None and "<" not in cells[3]]
            self.expect(numbers == sorted(numbers, reverse=direction < 0),
                        "sorting by position error does not sort")
        browser.click("document.querySelector('#tradeoff summary')")

    def place(self, row, axis):
        """Where the diagram has a run; None where it cannot have it."""
        floor = self.tradeoff["reference"]["position_floor"]
        x = micro(row["ns_per_second"]) if axis == "time" else row["evaluations"]
        y = floor if row["below_floor"] or row["position_error"] == 0 else row["position_error"]
        return (x, y) if row["stable"] and x and y else None

    def expected_points(self, method, precision, axis):
        runs = [r for r in self.rows if r["method"] == method and r["precision"] == precision]
        runs.sort(key=lambda r: r["rate"])
        return [place for r in runs if (place := self.place(r, axis))]

    def datasets(self, expression="true"):
        return self.browser.value(f"""oilerReport.charts.tradeoff.data.datasets
            .filter(d => {expression}).map(d => ({{label: d.label, method: d.method,
                precision: d.precision, points: d.data.map(p => [p.x, p.y])}}))""")

    def curves(self, methods, precisions, axis, when):
        """What Chart.js holds is what was chosen, no more and no less."""
        held = {(d["method"], d["precision"]): d["points"] for d in self.datasets("d.method")}
        wanted = {(m, p) for m in methods for p in precisions}
        self.expect(set(held) == wanted, f"{when}: curves of {sorted(held)}")
        for key in wanted & set(held):
            expected = self.expected_points(*key, axis)
            self.expect(close_to(held[key], expected),
                        f"{when}: {key} has {held[key][:3]}..., not {expected[:3]}...")

    def marks(self):
        [current] = self.datasets("d.label === 'current setting'")
        row = next((r for r in self.rows if same(r, self.tradeoff["current"])), None)
        place = row and self.place(row, "time")
        expected = [place] if place else []
        self.expect(close_to(current["points"], expected),
                    f"the star of the current setting is at {current['points']}")
        [front] = self.datasets("d.label === 'Pareto front'")
        count = sum(self.place(r, "time") is not None for r in self.rows if r["pareto"])
        points = front["points"]
        self.expect(len(points) == count, f"the Pareto front has {len(points)} of {count}")
        xs, ys = zip(*points) if points else ((), ())
        self.expect(list(xs) == sorted(xs) and list(ys) == sorted(ys, reverse=True),
                    "the Pareto front goes up")
        self.expect(not self.browser.value("""oilerReport.charts.tradeoff.data.datasets
            .find(d => d.label === 'Pareto front').stepped"""),
                    "the Pareto front leaves the points of the runs")
        self.room()

    def room(self):
        """Errors from 1 m to 1 mm have a quarter of the axis, if the marks do not need more."""
        limits = [self.data["advice"]["requirements"].get("position_error")]
        limits += [row["position_error"] for row in self.rows
                   if same(row, self.tradeoff["current"]) and self.place(row, "time")]
        low, high = (self.browser.value(f"oilerReport.charts.tradeoff.scales.y.{edge}")
                     for edge in ("min", "max"))
        needed = min([limit for limit in limits if limit] + [1e-4])
        self.expect(low <= needed, f"the errors begin at {low}, above {needed}")
        self.expect(high / low < 1e12 or needed < 1e-8, f"the errors go from {low} to {high}")

    def filter(self):
        browser = self.browser
        precisions = list(dict.fromkeys(r["precision"] for r in self.rows))
        methods = list(dict.fromkeys(r["method"] for r in self.rows))
        boxes = "document.querySelectorAll('#methods input')"
        notable = browser.value(f"[...{boxes}].filter(b => b.checked).map(b => b.value)")
        wanted = {r["method"] for r in self.rows if r["pareto"]} | {
            *self.data["obvious_methods"], self.tradeoff["current"]["method"]}
        self.expect(wanted & set(methods) <= set(notable), f"chosen at first: {notable}")
        known = lambda some: [m for m in some if m in methods]
        self.curves(known(notable), precisions, "time", "at first")
        browser.click("document.querySelector('[data-choose=all]')")
        self.curves(methods, precisions, "time", "all")
        browser.click("document.querySelector('[data-choose=none]')")
        self.curves([], precisions, "time", "none")
        browser.click(f"document.querySelector('#methods input[value={methods[0]}]')")
        self.curves(methods[:1], precisions, "time", methods[0])
        for precision in precisions:
            browser.click(f"document.querySelector('#precision input[value={precision}]')")
            self.curves(methods[:1], [precision], "time", precision)
        browser.click("document.querySelector('#against input[value=evaluations]')")
        self.curves(methods[:1], precisions[-1:], "evaluations", "evaluations")
        label = browser.value("oilerReport.charts.tradeoff.scales.x.options.title.text")
        self.expect("evaluations" in label, f"the axis of evaluations says {label}")
        browser.click("document.querySelector('#against input[value=time]')")
        browser.click("document.querySelector('#precision input[value=both]')")
        browser.click("document.querySelector('[data-choose=notable]')")
        self.curves(known(notable), precisions, "time", "notable")

    def hover(self, dataset, at):
        """The tooltip of a point, as Chart.js paints it when the mouse is there; None where
        another point is as near."""
        place = self.browser.value(f"""(() => {{
            const chart = oilerReport.charts.tradeoff;
            chart.canvas.scrollIntoView({{block: 'center'}});
            const box = chart.canvas.getBoundingClientRect();
            const i = chart.data.datasets.findIndex(d => {dataset});
            const p = chart.getDatasetMeta(i).data[{at}].getProps(['x', 'y']);
            const row = chart.data.datasets[i].data[{at}].row;
            const isNear = (q, other) => other.row !== row && Math.hypot(q.x - p.x, q.y - p.y) < 4;
            const crowded = chart.data.datasets.some((d, k) =>
                chart.getDatasetMeta(k).data.some((q, j) => isNear(q, d.data[j])));
            return crowded ? null : [box.x + p.x, box.y + p.y]; }})()""")
        if place is None:
            return None
        self.browser.mouse("mouseMoved", (1, 1))
        self.browser.mouse("mouseMoved", place)
        return self.browser.value("""new Promise(done => setTimeout(() => {
            const t = oilerReport.charts.tradeoff.tooltip;
            done(t.opacity ? [t.title, t.body.map(b => b.lines)] : [[], []]); }, 100))""")

    def tooltip(self):
        rows = [r for r in self.rows if self.place(r, "time") and not r["below_floor"]]
        rows.sort(key=lambda r: not same(r, self.tradeoff["current"]))
        hovered = 0
        for row in rows[:20]:
            if hovered < 3 and (tip := self.tip(row)):
                hovered += 1
                self.compare_tip(row, *tip)
        self.expect(hovered or not rows, "no point was free to be hovered over")
        self.browser.click("document.querySelector('#precision input[value=both]')")
        self.browser.click("document.querySelector('[data-choose=notable]')")

    def tip(self, row):
        method, precision = row["method"], row["precision"]
        self.browser.click("document.querySelector('[data-choose=none]')")
        self.browser.click(f"document.querySelector('#methods input[value={method}]')")
        self.browser.click(f"document.querySelector('#precision input[value={precision}]')")
        at = self.expected_points(method, precision, "time").index(self.place(row, "time"))
        return self.hover(f"d.method === '{method}' && d.precision === '{precision}'", at)

    def compare_tip(self, row, titles, bodies):
        name = f"{row['method']}, {row['precision']}, {row['rate']} Hz"
        self.expect(titles == [name], f"over {name} the tooltip says {titles}")
        if titles != [name]:
            return
        lines = dict(line.split(": ", 1) for line in bodies[0] if ": " in line)
        self.expect(near(lines["position error as drawn"], row["position_error"], "m")
                    and near(lines["energy drift"], row["energy_drift"])
                    and near(lines["time"], row["ns_per_second"] * 1e-9, "s")
                    and near(lines["force evaluations"], row["evaluations"], within=0),
                    f"the tooltip of {name} says {lines}")

    def stability(self):
        stability = self.data["stability"]
        held = self.browser.value("""oilerReport.charts.stability.data.datasets.map(
            d => [d.method ?? null, d.data.map(p => [p.x, p.y])])""")
        limits = {one["method"]: one["points"] for one in stability["methods"]}
        for method, points in held:
            if method:
                self.expect(all(y == limit or (limit == 0 and y > 0) for (_, y), (_, limit)
                                in zip(points, limits[method])), f"the limits of {method} differ")
        springs = sorted(p for method, points in held if not method for p in points)
        expected = sorted([s["zeta"], s["omega"] / stability["rate"]] for s in stability["springs"])
        self.expect(close_to(springs, expected), f"springs are at {springs}")
        table = self.table("#stability tbody tr")
        self.expect([cells[0] for cells in table] == [s["name"] for s in stability["springs"]],
                    f"the table of springs has {[cells[0] for cells in table]}")

    def rates(self):
        table = self.browser.value("""[...document.querySelectorAll('#rates tbody tr')].map(
            r => [...r.cells].map(c => [c.innerText.trim(), c.querySelector('.off') !== null]))""")
        rows = [(q, m) for q in self.data["rates"]["quantities"] for m in q["methods"]]
        self.expect(len(table) == len(rows), f"{len(table)} rows of rates, not {len(rows)}")
        for cells, (quantity, method) in zip(table, rows):
            truth, words = quantity["truth"], f"{quantity['name']} by {method['method']}"
            self.expect(cells[0][0] == method["method"], f"{words}: {cells[0][0]}")
            self.expect(near(cells[-1][0], method["spread_percent"]), f"{words}: {cells[-1][0]} %")
            for (text, off), value in zip(cells[1:], method["values"]):
                is_off = (None not in (value, truth)) and abs(value - truth) > 0.01 * abs(truth)
                self.expect(near(text, value) and off == is_off and is_off == (text[0] in "↑↓"),
                            f"{words}: {text} for {value}")

    def ledger(self):
        ledger, table = self.data["ledger"], self.table("#ledger tbody tr")
        self.expect(len(table) == len(ledger["passes"]), f"{len(table)} rows in the ledger")
        for cells, row in zip(table, ledger["passes"]):
            self.expect(cells[0] == row["name"] and near(cells[1], row["saves_ns"])
                        and near(cells[2], row["saves_percent"])
                        and near(cells[3], row["spread_percent"])
                        and near(cells[4], row["changes_position_m"]), f"ledger: {cells}")
        self.expect(self.texts("#ledger li") == list(ledger["flags"]), "the ledger's flags differ")

    def width(self):
        for width in (1280, 400):
            self.browser.resize(width)
            wide = self.browser.value("""new Promise(done => setTimeout(() =>
                done(document.documentElement.scrollWidth), 500))""")
            self.expect(wide <= width, f"at a width of {width} the page is {wide} wide")

    def all(self):
        self.sections()
        self.heading()
        if self.rows:
            for step in (self.reference, self.run_table, self.marks, self.filter, self.tooltip):
                step()
        for part in ("advice", "stability", "rates", "ledger"):
            if self.data[part]:
                getattr(self, part)()
        self.width()


def same(a, b):
    return all(a[key] == b[key] for key in ("method", "rate", "precision"))


def micro(ns):
    return None if ns is None else ns / 1000


def main(arguments):
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    failures = failures_of(Path(arguments[0]), 1280, DATA, Check, "window.oilerReport?.ready === true")
    for failure in failures:
        print(" ".join(str(failure).split()))
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
