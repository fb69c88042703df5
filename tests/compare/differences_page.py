#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Opens pages of differences between frames in Chromium and compares them with their own data.

    differences_page.py [PAGE...]    a line per failure; exits with 0 or 1

Two pages with known pixels and hostile names are made from the template and tested first.
Needs Debian's chromium and nothing else.
"""
import json
import sys
import tempfile
import time
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "support"))
from browser import failures_of
from differences_viewer import Viewer, decoded, gaps
from pictures import hostile_data, plain_data

DATA = r"<script>const data = (.*?);</script>"
TEMPLATE = Path(__file__).resolve().parents[2] / "engine/oiler/compare/differences.html"
NAMES = {"=": "equal", "s": "simulation", "p": "picture", "x": "pixels beyond the tolerance",
         "~": "pixels within the tolerance", "m": "missing"}
COUNTED = {"=": "equal", "s": "simulation", "p": "picture", "x": "pixels", "~": "tolerated",
           "m": "missing"}
LUMINANCE = """(colour) => { const linear = colour.match(/[\\d.]+/g).slice(0, 3).map(c => c / 255)
    .map(c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]; }"""


def number(x, digits=6):
    text = f"{float(f'{x:.{digits}g}'):,.12f}"
    return text.rstrip("0").rstrip(".")


class Check(Viewer):
    def __init__(self, browser, data):
        super().__init__(browser)
        self.data = data

    # Verdict, settings and timeline

    def heading(self):
        data = self.data
        self.expect(self.texts("h1") == [data["verdict"]], f"the verdict is {self.texts('h1')}")
        self.expect(self.texts("#folders code") == [data["golden"], data["actual"]],
                    f"the folders are {self.texts('#folders')}")
        self.expect(self.texts("#findings li") == data["findings"],
                    f"the findings are {self.texts('#findings li')}")
        rows = [[row["name"], row["golden"], row["actual"]] for row in data["settings"]]
        cells = self.texts("#settings tbody :is(th, td)")
        self.expect(cells == sum(rows, []), f"the settings are {cells}")
        self.expect(bool(self.texts("#settings")) == bool(rows), "an empty table of settings")
        first = self.texts("main > *")[0]
        if data["renderer"] is None:
            self.expect(first == data["verdict"], f"first comes {first}")
        else:
            self.expect(first.endswith(data["renderer"]), f"first comes {first}")

    def timeline(self):
        data, timeline = self.data, self.data["timeline"]
        self.expect(len(timeline) == data["counts"]["frames"], f"{len(timeline)} letters")
        cells = self.browser.value("""[...document.querySelectorAll('#strip .cell')].map(e =>
            [e.textContent, e.tagName === 'BUTTON', e.title,
             getComputedStyle(e).backgroundColor])""")
        pictured = {frame["index"] for frame in data["frames"]}
        wanted = [[letter.upper(), index in pictured, f"frame {index}: {NAMES[letter]}"]
                  for index, letter in enumerate(timeline)]
        wrong = [(cell[:3], one) for cell, one in zip(cells, wanted) if cell[:3] != one]
        self.expect(not wrong and len(cells) == len(wanted), f"the cells differ: {wrong[:3]}")
        self.expect(len({cell[3] for cell in cells}) == len(set(timeline)),
                    "two causes have one colour")
        firsts = [str(first) for first in range(0, len(timeline), 10)]
        self.expect(self.texts("#strip small") == firsts, "the numbers above the cells differ")
        self.legend()

    def legend(self):
        data, texts = self.data, self.texts("#legend li")
        for letter, key in COUNTED.items():
            self.expect(data["counts"][key] == data["timeline"].count(letter),
                        f"{key}: {data['counts'][key]} frames, not as the timeline")
        counts = {letter: data["counts"][key] for letter, key in COUNTED.items()}
        wanted = [f"{letter.upper()} {name}: {counts[letter]:,}" for letter, name in NAMES.items()]
        self.expect(texts == wanted, f"the legend is {texts}")

    # Frames

    def go(self, at):
        """By a click on its cell."""
        index = self.data["frames"][at]["index"]
        self.browser.click(f"document.querySelectorAll('#strip .cell')[{index}]")
        self.settle()
        self.is_at(at, "a click on its cell")

    def is_at(self, at, after):
        frame = self.data["frames"][at]
        heading = self.texts("#heading")
        self.expect(heading == [f"Frame {frame['index']}: {frame['cause']}"],
                    f"after {after}: {heading}, not frame {frame['index']}")
        marked = self.browser.value("""[...document.querySelectorAll('#strip .cell')].flatMap(
            (e, i) => e.ariaCurrent === 'true' ? [i] : [])""")
        self.expect(marked == [frame["index"]], f"after {after} the marked cells are {marked}")

    def facts(self, frame, pictures):
        self.expect(self.texts("#text") == [frame["text"]], f"the text is {self.texts('#text')}")
        facts = dict(zip(self.texts("#facts dt"), self.texts("#facts dd")))
        wanted = {"tick": number(frame["tick"]), "time": f"{number(frame['time'])} s"}
        if pictures["expected"] and pictures["actual"]:
            wanted |= self.pixel_facts(frame, pictures)
        self.expect(facts == wanted, f"frame {frame['index']}: {facts}, not {wanted}")

    def pixel_facts(self, frame, pictures):
        """Counted again here."""
        width, height = frame["width"], frame["height"]
        triples = [max(row[i:i + 3]) for row in gaps(pictures["expected"], pictures["actual"])
                   for i in range(0, 3 * width, 3)]
        most, index = max(triples), frame["index"]
        self.expect(most == frame["largest"], f"frame {index}: the largest difference is {most}")
        channel = self.data["tolerance"]["channel"]
        counts = [sum(gap > least for gap in triples) for least in (0, channel)]
        self.expect(frame["differing"] in counts, f"frame {index}: {counts} pixels differ")
        self.expect(abs(frame["share"] - frame["differing"] / (width * height)) < 1e-6,
                    f"frame {index}: the share is {frame['share']}")
        at = triples.index(most)
        where = f" at x {at % width}, y {at // width}" if most else ""
        return {"differing pixels": f"{number(frame['differing'])} of {number(width * height)} "
                                    f"({number(frame['share'] * 100, 3)} %)",
                "largest difference": f"{most} of 255{where}", "size": f"{width} × {height}"}

    def true_difference(self, frame, pictures):
        if pictures["difference"] and pictures["expected"] and pictures["actual"]:
            rows = [bytes(min(255, 16 * gap) for gap in row)
                    for row in gaps(pictures["expected"], pictures["actual"])]
            self.expect(pictures["difference"].rows == rows,
                        f"frame {frame['index']}: the difference is not 16 × that of the pictures")

    def frame(self, at):
        frame, words = self.data["frames"][at], f"frame {self.data['frames'][at]['index']}"
        self.go(at)
        pictures = decoded(frame)
        self.facts(frame, pictures)
        self.true_difference(frame, pictures)
        for mode in (self.flip, self.slide, self.side, self.difference):
            mode(pictures, words)
            self.hover(pictures, f"{words}, {mode.__name__}")
        for zoom in ("2×", "4×", "1×"):
            self.button(zoom)
            self.expect(self.box(0)["zoom"] == int(zoom[0]), f"the zoom is not {zoom}")
            self.flip(pictures, f"{words} at {zoom}")
            self.hover(pictures, f"{words} at {zoom}")
            if zoom == "4×":
                self.slide(pictures, f"{words} at {zoom}")
        if pictures["expected"] and pictures["actual"]:
            self.zoom_to_largest(frame, pictures)

    # Mouse and keys

    def steps(self):
        last = len(self.data["frames"]) - 1
        self.go(0)
        for mode, forth, back in (("f", "ArrowRight", "ArrowLeft"), ("d", "j", "k"),
                                  ("s", "j", "k"), ("b", "ArrowRight", "ArrowLeft")):
            self.press(mode)
            for key, sign in ((forth, 1), (back, -1)):
                for at in range(last)[::1] if sign > 0 else range(last, 0, -1):
                    self.press(key)
                    self.is_at(at + sign, f"{key} in mode {mode}")
                self.press(key)
                self.is_at(last if sign > 0 else 0, f"{key} at the end in mode {mode}")
        if last:
            self.button("next")
            self.is_at(1, "next")
            self.button("previous")
            self.is_at(0, "previous")
        disabled = self.browser.value("""[...document.querySelectorAll('#bar button')]
            .filter(b => b.disabled).map(b => b.textContent)""")
        self.expect(disabled[:1] == ["◂ previous"] and (last > 0) == (len(disabled) == 1),
                    f"at the first frame these buttons are disabled: {disabled}")

    def hurry(self):
        """Clicks faster than pictures load, and the first ones load last; the last click counts."""
        self.browser.value("""(() => { const decode = Image.prototype.decode;
            let delay = 800;
            Image.prototype.decode = async function() {
                await new Promise(done => setTimeout(done, delay *= 0.8));
                return decode.call(this); };
            [...document.querySelectorAll('button.cell')].reverse().forEach(cell => cell.click());
            Image.prototype.decode = decode; })()""")
        time.sleep(1)
        self.settle()
        self.is_at(0, "many clicks")

    def mode_keys(self):
        names = {"s": "slide", "b": "side by side", "d": "difference × 16", "f": "flip"}
        zooms = {"2": "2×", "4": "4×", "1": "1×"}
        for key, name in (names | zooms).items():
            self.press(key)
            pressed = self.browser.value("""[...document.querySelectorAll(
                '#bar [aria-pressed=true]')].map(b => b.textContent)""")
            self.expect(name in pressed and len(pressed) == 2, f"after {key}: {pressed}")
        before = self.captions()
        for key in ("s", " ", "f"):
            self.press(key)
        self.expect(self.captions() == before, "Space flips in mode slide")

    def automatic(self):
        """Four turns take 2 s; the bound is half of it, as the first may come late."""
        self.browser.value("""(() => { window.turns = []; new MutationObserver(() =>
            turns.push([performance.now(), document.querySelector('figcaption').textContent]))
            .observe(document.querySelector('figcaption'), {childList: true}); })()""")
        self.press("f")
        self.browser.value("turns.length = 0")
        self.button("0.5 s")
        start = "turns.filter(([, text], i) => i === 0 || text !== turns[i - 1][1])"
        self.wait(f"{start}.length >= 5", "automatic flips")
        turns = self.browser.value(start)
        self.expect(turns[4][0] - turns[0][0] > 1000, f"the automatic flips are too fast: {turns}")
        self.expect(turns[1][1].split(":")[0] != turns[2][1].split(":")[0], f"no flips: {turns}")
        self.press("a")
        count = self.browser.value("turns.length")
        time.sleep(1.2)
        self.expect(self.browser.value("turns.length") == count, "the flips do not stop")

    # The page as a whole

    def looks(self):
        for scheme in ("light", "dark"):
            self.browser.scheme(scheme)
            contrasts = self.browser.value(f"""(() => {{ const luminance = {LUMINANCE};
                const of = (e) => {{ const style = getComputedStyle(e);
                    const [a, b] = [luminance(style.color), luminance(style.backgroundColor)];
                    return [e.textContent.slice(0, 12), a > b,
                            (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05)]; }};
                return [document.body, ...document.querySelectorAll(
                    '#legend .cell, #bar button:not(:disabled)')].map(of); }})()""")
            self.expect(contrasts[0][1] == (scheme == "dark"), f"the page is not {scheme}")
            faint = [words for words, _, contrast in contrasts if contrast < 4.5]
            self.expect(not faint, f"hardly legible in {scheme} mode: {faint}")
        self.browser.scheme("light")
        for width in (1600, 1000, 400):
            self.browser.resize(width)
            wide = self.browser.value("""new Promise(done => requestAnimationFrame(() =>
                requestAnimationFrame(() => done(document.documentElement.scrollWidth))))""")
            self.expect(wide <= width, f"at a width of {width} the page is {wide} wide")
        self.browser.resize(1000)

    def chosen(self):
        """The first frames, the last, and the first ones with a missing picture."""
        frames = self.data["frames"]
        lacking = [next((at for at, frame in enumerate(frames) if frame[kind] is None), 0)
                   for kind in ("expected", "actual")]
        return sorted({0, 1, *lacking, len(frames) - 1} & set(range(len(frames))))

    def all(self):
        self.heading()
        self.timeline()
        self.expect(bool(self.texts("#viewer")) == bool(self.data["frames"]),
                    "a viewer without frames, or none with frames")
        if self.data["frames"]:
            self.settle()
            self.is_at(0, "opening")
            for at in self.chosen():
                self.frame(at)
            for step in (self.steps, self.hurry, self.mode_keys, self.automatic, self.looks):
                step()
        self.expect(self.browser.value("window.hostile === undefined"), "a text was executed")


def write_page(folder, name, data):
    text = json.dumps(data).replace("<", "\\u003c")
    page = Path(folder) / name
    page.write_text(TEMPLATE.read_text(encoding="utf-8").replace("@DATA@", text), encoding="utf-8")
    return page


def main(arguments):
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        pages = [write_page(folder, "hostile.html", hostile_data()),
                 write_page(folder, "plain.html", plain_data()), *map(Path, arguments)]
        for page in pages:
            failures = failures_of(page, 1000, DATA, Check)
            for failure in failures:
                print(f"{page.name}:", " ".join(str(failure).split()))
            failed = failed or bool(failures)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
