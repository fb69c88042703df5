# SPDX-License-Identifier: MIT
"""Data of a page of differences, with known pixels and with texts that try to become markup."""
import base64

import png

HOSTILE = "</script><script>window.hostile = 1</script><img src=x onerror='window.hostile = 1'>"


def picture(width, height, colour):
    rows = [bytes(value & 255 for x in range(width) for value in colour(x, y))
            for y in range(height)]
    return png.Picture(width, height, rows)


def changed(original, pixels):
    """With channels added at some pixels: {(x, y): (red, green, blue)}."""
    rows = [bytearray(row) for row in original.rows]
    for (x, y), added in pixels.items():
        for channel, value in enumerate(added):
            rows[y][3 * x + channel] += value
    return png.Picture(original.width, original.height, [bytes(row) for row in rows])


def difference(a, b):
    rows = [bytes(min(255, 16 * abs(x - y)) for x, y in zip(p, q)) for p, q in zip(a.rows, b.rows)]
    return png.Picture(a.width, a.height, rows)


def url(image):
    return image and "data:image/png;base64," + base64.b64encode(png.encode(image)).decode()


def frame(index, cause, text, expected, actual):
    both = expected and actual
    known = expected or actual
    gaps = [max(abs(x - y) for x, y in zip(expected.pixel(x, y), actual.pixel(x, y)))
            for y in range(known.height) for x in range(known.width)] if both else [0]
    differing = sum(gap > 0 for gap in gaps)
    return {"index": index, "tick": 100 * index + 7, "time": index / 30, "cause": cause,
            "text": text, "differing": differing,
            "share": differing / (known.width * known.height), "largest": max(gaps),
            "width": known.width, "height": known.height, "expected": url(expected),
            "actual": url(actual), "difference": url(both and difference(expected, actual))}


def hostile_data():
    waves = picture(61, 37, lambda x, y: (5 * x + 3 * y, x * y, 7 * x ^ 11 * y))
    other = picture(61, 37, lambda x, y: (9 * x + y, 255 - x * y, 3 * x ^ 5 * y))
    dots = changed(picture(61, 37, lambda x, y: (2 * x, 3 * y, 90)),
                   {(1, 1): (0, 0, 20), (44, 30): (0, 3, 0)})
    nearly = changed(dots, {(10, 9): (0, 2, 0), (44, 30): (0, 17, 1), (50, 2): (16, 0, 0)})
    large = picture(1300, 900, lambda x, y: (x >> 3, y >> 2, (x + y) >> 4))
    spot = changed(large, {(1201, 777): (40, 0, 0), (3, 4): (0, 1, 0)})
    timeline = list("=" * 21 + "~")
    for index, letter in {3: "p", 4: "x", 9: "m", 10: "m", 12: "s", 13: "p"}.items():
        timeline[index] = letter
    return {
        "golden": f"golden/{HOSTILE}", "actual": f"frames/{HOSTILE}",
        "verdict": f"picture changed at frame 3: body {HOSTILE}",
        "findings": [f"first {HOSTILE}", "second & <b>third</b>"],
        "renderer": f"llvmpipe (LLVM 15) → {HOSTILE}",
        "settings": [{"name": HOSTILE, "golden": "100 <", "actual": HOSTILE},
                     {"name": "rate", "golden": "100", "actual": "120"}],
        "counts": {"frames": 22, "equal": 16, "simulation": 1, "picture": 2, "pixels": 1,
                   "missing": 2},
        "timeline": "".join(timeline), "tolerance": {"channel": 2, "share": 0.01},
        "frames": [frame(3, "picture", f"body {HOSTILE}", waves, other),
                   frame(4, "pixels", "3 pixels differ", dots, nearly),
                   frame(9, "missing", "no frame in the golden", None, other),
                   frame(10, "missing", "no actual frame", waves, None),
                   frame(13, "picture", "1 disc: radius 3 → 4", large, spot)]}


def plain_data():
    """Without renderer, findings, settings and pictures."""
    return {"golden": "tests/golden/spring", "actual": "frames/spring",
            "verdict": "1 frame is missing", "findings": [], "renderer": None, "settings": [],
            "counts": {"frames": 1, "equal": 0, "simulation": 0, "picture": 0, "pixels": 0,
                       "missing": 1},
            "timeline": "m", "tolerance": {"channel": 0, "share": 0}, "frames": []}
