#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Captures the same run twice in different circumstances: `oiler compare` must say equal.

The two captures of a pair differ in threads, in the provider of OpenGL, in the threads and the
vectors of llvmpipe, and in the load of the machine. A capture by softpipe, another renderer, is
compared last: it is equal within the tolerance, or the comparison says that the renderer differs."""

import collections
import json
import random
import shutil
import subprocess
from pathlib import Path

import faults

options = faults.arguments(__doc__.splitlines()[0], count=200, short_count=20)
failures = faults.Failures()
counts = collections.Counter()
scenes = ["article_spring", "chain", "cloth", "jump", "orbit", "salvo", "stiff_and_soft"]
demos = ["hello", "jump", "projectile", "spring_damper"]


def number(low, high, digits=3):
    return round(random.uniform(low, high), digits)


def random_scene(path):
    """Writes a scene of a few bodies with springs, drag and gravity."""
    lines = [
        "[scene]",
        "axes = 2",
        f"rate = {random.choice([30, 60, 97, 240])}",
        f'precision = "{random.choice(["float", "double"])}"',
        f"duration = {number(0.5, 3)}",
        "[gravity]",
        f"acceleration = [0.0, {number(-20, 0)}]",
    ]
    for i in range(random.randint(1, 12)):
        lines += [
            "[[body]]",
            f'name = "b{i}"',
            f"position = [{number(-5, 5)}, {number(-3, 3)}]",
            f"velocity = [{number(-3, 3)}, {number(-3, 3)}]",
            f"radius = {number(0.01, 0.8)}",
            f'colour = "#{random.randrange(1 << 24):06x}"',
            f"quadratic_drag = {number(0, 0.1)}",
        ]
        if random.random() < 0.6:
            end = f'to = "b{i - 1}"' if i and random.random() < 0.5 else "anchor = [0.0, 1.0]"
            spring = f"stiffness = {number(1, 60)}\ndamping = {number(0, 1)}"
            lines += ["[[spring]]", f'body = "b{i}"', end, spring]
    path.write_text("\n".join(lines) + "\n")
    return [options.programs / "oiler", "play", path]


def random_command(work):
    """A demo, a scene of the assets or a random scene."""
    kind = random.choice(["demo", "scene", "random"])
    if kind == "demo":
        return [options.programs / random.choice(demos), "--rate", random.choice([25, 60, 300])]
    if kind == "scene":
        path = faults.root / f"assets/scenes/{random.choice(scenes)}.toml"
        return [options.programs / "oiler", "play", path]
    return random_scene(work / "random.toml")


def random_frames():
    odd = (random.randint(9, 400), random.randint(9, 300))
    width, height = random.choice([(320, 180), (640, 360), odd])
    words = ["--size", f"{width}x{height}", "--fps", random.choice([1, 7, 24, 30, 60, 144])]
    return words + ["--frames", random.randint(1, 12), "--seed", random.randrange(9)]


def circumstances():
    """Options and variables of the environment that must not change a frame beyond the tolerance."""
    words = ["--surface", random.choice(["osmesa", "egl"]), "--threads", random.randint(1, 4)]
    variables = {"LP_NATIVE_VECTOR_WIDTH": random.choice(["128", "256"])}
    if random.random() < 0.7:
        variables["LP_NUM_THREADS"] = str(random.randrange(5))
    return words, variables


def busy_loop():
    return subprocess.Popen(["python3", "-c", "while True: pass"])


def capture(command, frames, out, words, variables):
    whole = [*command, "--headless", "--quiet", *frames, *words, "--out", out]
    load = busy_loop() if random.random() < 0.3 else None
    code, _, errors = faults.run(whole, **variables)
    if load:
        load.kill()
        load.wait()
    return code, errors


def compare(golden, actual):
    code, text, errors = faults.run(
        [options.programs / "oiler", "compare", golden, actual, "--json", actual / "result.json"]
    )
    result = json.loads((actual / "result.json").read_text()) if code in (0, 1) else {}
    return code, text + errors, result


def pair(work):
    command, frames = random_command(work), random_frames()
    surroundings = [circumstances(), circumstances()]
    folders = [work / "golden", work / "actual"]
    for folder, (words, variables) in zip(folders, surroundings):
        code, errors = capture(command, frames, folder, words, variables)
        if code == 3:
            print("skipped:", errors)
            raise SystemExit(77)
        if code == 5:
            return "diverged"
        failures.expect(code == 0, f"{command} {frames}: {errors}")
    code, text, result = compare(*folders)
    failures.expect(code == 0, f"{command} {frames} {surroundings}: {text}")
    counts["drawn by two renderers"] += result.get("renderer") is not None
    return "within the tolerance" if result.get("counts", {}).get("tolerated") else "exact"


def pairs():
    with faults.new_folder() as name:
        work = Path(name)
        for _ in range(options.count):
            counts[pair(work)] += 1
            shutil.rmtree(work / "golden", ignore_errors=True)
            shutil.rmtree(work / "actual", ignore_errors=True)
    print(f"pairs: {dict(counts)}", flush=True)


def softpipe():
    """Compares frames of llvmpipe with those of softpipe."""
    with faults.new_folder() as name:
        for demo in demos if not options.short else demos[:2]:
            golden, actual = Path(name) / f"{demo}-a", Path(name) / f"{demo}-b"
            frames = ["--size", "320x180", "--fps", 2, "--frames", 3]
            command = [options.programs / demo]
            capture(command, frames, golden, [], {})
            code, errors = capture(command, frames, actual, [], {"GALLIUM_DRIVER": "softpipe"})
            if code:
                print(f"softpipe skipped: {errors}")
                return
            code, text, result = compare(golden, actual)
            renderer = "renderer differs: " in text
            failures.expect(renderer and code in (0, 1), f"softpipe, {demo}: {text}")
            only_pixels = result["counts"]["simulation"] == result["counts"]["picture"] == 0
            failures.expect(only_pixels, f"softpipe, {demo}: {text}")
            difference = max((frame["largest"] for frame in result["frames"]), default=0)
            share = max((frame["share"] for frame in result["frames"]), default=0)
            words = f"differences up to {difference}/255 in up to {share:.2%} of the pixels"
            print(f"softpipe, {demo}: exit code {code}, {words}", flush=True)


pairs()
softpipe()
failures.end()
