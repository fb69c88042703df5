# SPDX-License-Identifier: MIT
"""The viewer of a page of differences, compared with decoded pictures, pixel by pixel."""
import base64
import json
import re
import time

import png
from browser import PATIENCE

LACK = {"expected": "no frame in the golden", "actual": "no actual frame"}
CAPTIONS = {"expected": "expected (golden)", "actual": "actual", "difference": "difference × 16"}
PANES = "document.querySelectorAll('figure')"


def decoded(frame):
    start = "data:image/png;base64,"
    return {kind: frame[kind] and png.decode(base64.b64decode(frame[kind].removeprefix(start)))
            for kind in CAPTIONS}


def gaps(a, b):
    return [[abs(x - y) for x, y in zip(p, q)] for p, q in zip(a.rows, b.rows)]


def first_difference(shown, wanted):
    return next((i // 3 for i, (a, b) in enumerate(zip(shown, wanted)) if a != b), None)


class Viewer:
    """Failures are sentences. `pictures` are those of a frame: expected, actual, difference."""

    def __init__(self, browser):
        self.browser, self.failures = browser, []

    def expect(self, holds, words):
        if not holds:
            self.failures.append(words)

    def texts(self, selector):
        """Only texts that are visible."""
        return self.browser.value(f"""[...document.querySelectorAll({json.dumps(selector)})]
            .filter(e => e.checkVisibility()).map(e => e.textContent.trim())""")

    def wait(self, condition, words):
        deadline = time.monotonic() + PATIENCE
        while not (holds := self.browser.value(condition)) and time.monotonic() < deadline:
            time.sleep(0.02)
        self.expect(holds, f"waited in vain: {words}")

    def settle(self):
        self.wait("document.querySelector('#viewer').ariaBusy === 'false'", "the viewer is busy")

    def button(self, text):
        """Clicks it, and settles."""
        self.browser.click(f"[...document.querySelectorAll('#bar button')].find("
                           f"b => b.textContent.includes({json.dumps(text)}))")
        self.settle()

    def press(self, key, shift=False):
        self.browser.press(key, shift)
        self.settle()

    def box(self, pane):
        """The place of the canvas in the window, the part of it that is visible, and the zoom."""
        return self.browser.value(f"""(() => {{
            const figure = {PANES}[{pane}], canvas = figure.querySelector('canvas');
            figure.scrollIntoView({{block: 'start', behavior: 'instant'}});
            const scroll = figure.querySelector('.scroll');
            const box = canvas.getBoundingClientRect(), outer = scroll.getBoundingClientRect();
            const [left, top, right, bottom] =
                [box.left, box.top, box.right, box.bottom].map(Math.round);
            const from = [Math.max(left, Math.ceil(outer.left + 1), 0),
                          Math.max(top, Math.ceil(outer.top + 1), 0)];
            const to = [Math.min(right, Math.floor(outer.left) + scroll.clientWidth, innerWidth),
                        Math.min(bottom, Math.floor(outer.top) + scroll.clientHeight, innerHeight)];
            return {{left, top, from, to, zoom: box.width / canvas.width,
                     size: [canvas.width, canvas.height]}}; }})()""")

    def shows(self, pane, picture, words, seam=None):
        """Compares the visible part of a pane with a picture, pixel by pixel. Columns beside the
        seam, where the divider is drawn, are left out."""
        box = self.box(pane)
        zoom, (x0, y0), (x1, y1) = round(box["zoom"]), box["from"], box["to"]
        self.expect(box["size"] == [picture.width, picture.height] and x1 - x0 > 4 and y1 - y0 > 4,
                    f"{words}: of another size, or hardly visible: {box}")
        shot = png.decode(self.browser.screenshot(x0, y0, x1 - x0, y1 - y0))
        columns = [(x - box["left"]) // zoom for x in range(x0, x1)]
        skip = None if seam is None else box["left"] + seam * zoom - x0
        for y, row in enumerate(shot.rows):
            source = picture.rows[(y + y0 - box["top"]) // zoom]
            wanted = b"".join(source[3 * x:3 * x + 3] for x in columns)
            if skip is not None:
                start, end = 3 * max(skip - 1, 0), 3 * max(skip + 1, 0)
                row, wanted = (text[:start] + text[end:] for text in (row, wanted))
            if row != wanted:
                column = first_difference(row, wanted)
                self.expect(False, f"{words}: another pixel: column {column}, row {y} of {box}")
                return

    def captions(self):
        return self.texts("figcaption")

    def pane(self, pane, kind, pictures, words):
        """One picture alone in a pane."""
        caption, wanted = self.captions()[pane], CAPTIONS[kind]
        if pictures[kind]:
            self.expect(caption == wanted, f"{words}: the caption is {caption}")
            self.shows(pane, pictures[kind], f"{words}, {kind}")
            return
        lack = LACK.get(kind) or next(LACK[k] for k in LACK if not pictures[k])
        self.expect(caption == f"{wanted}: {lack}", f"{words}: the caption is {caption}")
        self.expect(self.is_blank(pane), f"{words}: a picture where {kind} is missing")

    def is_blank(self, pane, columns=None):
        start, end = columns or (0, None)
        return self.browser.value(f"""(() => {{
            const canvas = {PANES}[{pane}].querySelector('canvas');
            const width = {json.dumps(end)} === null ? canvas.width : {json.dumps(end)} - {start};
            return canvas.getContext('2d').getImageData({start}, 0, width, canvas.height)
                .data.every(byte => byte === 0); }})()""")

    def flip(self, pictures, words):
        self.button("flip")
        if self.captions()[0].startswith("actual"):
            self.press(" ")
        self.pane(0, "expected", pictures, f"{words}, flip")
        self.press(" ")
        self.pane(0, "actual", pictures, f"{words}, flip by Space")
        box = self.box(0)
        place = [(a + b) / 2 for a, b in zip(box["from"], box["to"])]
        self.browser.mouse("mousePressed", place)
        self.browser.mouse("mouseReleased", place)
        self.pane(0, "expected", pictures, f"{words}, flip by a click")
        self.expect(len(self.captions()) == 1, f"{words}, flip: {self.captions()}")

    def slide(self, pictures, words):
        self.button("slide")
        box = self.box(0)
        zoom, (x0, y0), (x1, y1) = box["zoom"], box["from"], box["to"]
        y, third = (y0 + y1) / 2, (x1 - x0) // 3
        self.browser.mouse("mousePressed", (x0 + third, y))
        self.divider(pictures, (x0 + third - box["left"]) / zoom, f"{words}, pressed")
        y = sum(self.box(0)[key][1] for key in ("from", "to")) / 2
        self.browser.mouse("mouseMoved", (x0 + 2 * third, y), held=True)
        self.browser.mouse("mouseReleased", (x0 + 2 * third, y))
        at = self.divider(pictures, (x0 + 2 * third - box["left"]) / zoom, f"{words}, dragged")
        self.browser.mouse("mouseMoved", (x0 + third, y))
        self.divider(pictures, at, f"{words}, released")
        for key, shift, step in (("ArrowLeft", False, -1), ("ArrowRight", True, 10),
                                 ("ArrowRight", False, 1), ("ArrowLeft", True, -10)):
            self.press(key, shift)
            at = self.divider(pictures, at + step, f"{words}, {key}")

    def divider(self, pictures, wanted, words):
        """Returns where it is."""
        at = self.browser.value("Number(document.querySelector('.divider').ariaValueNow)")
        known = next(p for p in pictures.values() if p)
        self.expect(abs(at - min(max(wanted, 0), known.width)) <= 0.51,
                    f"{words}: the divider is at {at}, not {wanted}")
        sides = [("expected", (0, at)), ("actual", (at, known.width))]
        for kind, (start, end) in sides:
            if not pictures[kind]:
                self.expect(LACK[kind] in self.captions()[0] and
                            (start == end or self.is_blank(0, (start, end))),
                            f"{words}: a picture where {kind} is missing")
        if all(pictures[kind] for kind, _ in sides):
            left, right = pictures["expected"], pictures["actual"]
            rows = [a[:3 * at] + b[3 * at:] for a, b in zip(left.rows, right.rows)]
            self.shows(0, png.Picture(left.width, left.height, rows), f"{words}, slide", seam=at)
            self.line(at, words)
        return at

    def line(self, at, words):
        """Where the divider is drawn: a black and a white column."""
        box = self.box(0)
        x = box["left"] + round(at * box["zoom"])
        if box["from"][0] < x < box["to"][0]:
            row = png.decode(self.browser.screenshot(x - 1, box["from"][1], 2, 1)).rows[0]
            self.expect(row == b"\0\0\0\xff\xff\xff", f"{words}: the line is {list(row)}")

    def side(self, pictures, words):
        self.button("side by side")
        for pane, kind in enumerate(("expected", "actual")):
            self.pane(pane, kind, pictures, f"{words}, side by side")

    def difference(self, pictures, words):
        self.button("difference")
        self.pane(0, "difference", pictures, f"{words}, difference")

    def hover(self, pictures, words):
        for pane in range(len(self.captions())):
            box = self.box(pane)
            spans = list(zip(box["from"], box["to"]))
            for share in (0.02, 0.37, 0.71, 0.99):
                place = [int(a + share * (b - a)) for a, b in spans]
                self.browser.mouse("mouseMoved", place)
                self.readout(pictures, box, place, words)
        self.browser.mouse("mouseMoved", (1, 1))
        texts = [" ".join(text.split()) for text in self.texts("#spot")]
        self.expect(not re.search(r"\d", texts[0]), f"{words}: away from the picture: {texts}")

    def readout(self, pictures, box, place, words):
        x, y = (int((at - start) // box["zoom"])
                for at, start in zip(place, (box["left"], box["top"])))
        colours = {kind: pictures[kind] and pictures[kind].pixel(x, y) for kind in LACK}
        plain = lambda colour: " ".join(map(str, colour)) if colour else "–"
        gap = all(colours.values()) and [abs(a - b) for a, b in zip(*colours.values())]
        wanted = (f"x {x}, y {y}expected {plain(colours['expected'])}"
                  f"actual {plain(colours['actual'])}difference {plain(gap)}")
        [text] = self.texts("#spot")
        self.expect(text == wanted, f"{words}: under the mouse: {text}, not {wanted}")
        swatches = self.browser.value("""[...document.querySelectorAll('.swatch:not([hidden])')]
            .map(e => getComputedStyle(e).backgroundColor)""")
        self.expect(swatches == [f"rgb({', '.join(map(str, c))})" for c in colours.values() if c],
                    f"{words}: the swatches are {swatches}")

    def scrolling(self):
        """The wheel over one pane scrolls both."""
        offsets = ("[...document.querySelectorAll('.scroll')]"
                   ".map(s => [s.scrollLeft, s.scrollTop])")
        for pane, distance in ((0, 90), (1, -40), (1, 70), (0, -300)):
            box = self.box(pane)
            place = [(a + b) / 2 for a, b in zip(box["from"], box["to"])]
            self.browser.mouse("mouseMoved", place)
            wanted = self.browser.value(f"""(() => {{ const s = document.querySelector('.scroll');
                return [[s.scrollLeft, s.scrollWidth - s.clientWidth],
                        [s.scrollTop, s.scrollHeight - s.clientHeight]].map(
                    ([now, most]) => Math.min(Math.max(now + {distance}, 0), most)); }})()""")
            self.browser.wheel(place, distance)
            self.wait(f"{offsets}.every(([x, y]) => Math.abs(x - {wanted[0]}) <= 1 &&"
                      f" Math.abs(y - {wanted[1]}) <= 1)",
                      f"a wheel over pane {pane} scrolls both to {wanted}")
        self.browser.mouse("mouseMoved", (1, 1))

    def zoom_to_largest(self, frame, pictures):
        """Without the mouse, zooming shows the largest difference; with it, the pixel under it."""
        self.press("b")
        self.press("4")
        found = re.search(r"x (\d+), y (\d+)", self.texts("#facts")[0])
        if found:
            self.is_visible([int(x) for x in found.groups()], "the largest difference")
        boxes = [self.box(pane) for pane in (0, 1)]
        offsets = [[box["from"][i] - box[key] for i, key in enumerate(("left", "top"))]
                   for box in boxes]
        self.expect(offsets[0] == offsets[1], f"the panes are scrolled apart: {offsets}")
        self.side(pictures, "zoomed to the largest difference")
        self.scrolling()
        self.hover(pictures, "zoomed to the largest difference")
        self.press("1")
        box = self.box(0)
        place = [int(a + 0.15 * (b - a)) for a, b in zip(box["from"], box["to"])]
        self.browser.mouse("mouseMoved", place)
        self.press("4")
        self.is_visible([at - box[key] for at, key in zip(place, ("left", "top"))],
                        "the pixel under the mouse")
        self.browser.mouse("mouseMoved", (1, 1))
        self.press("1")

    def is_visible(self, pixel, words):
        box = self.box(0)
        spans = [((start - origin) / 4, (end - origin) / 4) for start, end, origin
                 in zip(box["from"], box["to"], (box["left"], box["top"]))]
        self.expect(all(low - 1 <= at <= high + 1 for at, (low, high) in zip(pixel, spans)),
                    f"zooming hides {words}, {pixel}; visible: {spans}")
