#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Gives the programs damaged scenes, random command lines, and damaged parts, manifests and records.

Each run must end with an exit code of the contract. Bad input (exit code 2) is one line on standard
error, and no file is written, besides the verdicts of `oiler check`. With the programs of the preset `debug`, sanitizers check each run. Runs
that take longer than five seconds are stopped with SIGTERM and must then end as interrupted."""

import json
import random
import re
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import faults

options = faults.arguments(__doc__.splitlines()[0], count=500, short_count=20)
failures = faults.Failures()
oiler = options.programs / "oiler"
scenes = [path for path in (faults.root / "assets/scenes").glob("*.toml")
          if path.stem not in ("million", "hundred_thousand")]
numbers = ["0", "-1", "1", "2", "1e308", "-1e308", "1e-320", "nan", "inf", "-inf", "9007199254740993", "1e400",
           "9223372036854775807", "18446744073709551616", "0.1", "true", "\"x\"", "[]", "[1.0]", "1_0", "0x7f"]
bytes_of_noise = [b"\0", b"\xff", b"\"", b"[", b"]", b"=", b"#", b"\n", b"\xe2\x88\x9e", b"'", b"."]
tally = {}


def change_number(text):
    places = list(re.finditer(rb"(?<![\w.])-?\d[\d.eE+-]*", text))
    if not places:
        return text
    place = random.choice(places)
    return text[: place.start()] + random.choice(numbers).encode() + text[place.end() :]


def change_line(text):
    lines = text.split(b"\n")
    at = random.randrange(len(lines))
    kind = random.randrange(4)
    if kind == 0:
        del lines[at]
    elif kind == 1:
        lines.insert(random.randrange(len(lines)), lines[at])
    elif kind == 2:
        other = random.randrange(len(lines))
        lines[at], lines[other] = lines[other], lines[at]
    else:
        lines = lines[:at]
    return b"\n".join(lines)


def change_byte(text):
    at = random.randrange(len(text) + 1)
    noise = random.choice(bytes_of_noise)
    return text[:at] + noise + text[at + random.randrange(3) :]


def damaged(text):
    for _ in range(random.choice([1, 1, 1, 2, 3])):
        text = random.choice([change_number, change_number, change_line, change_byte])(text)
    return text


def changed_value(value):
    """A JSON value with one of its parts changed, removed or given another type."""
    path = []
    at = value
    while isinstance(at, (dict, list)) and at and (not path or random.random() < 0.9):
        key = random.choice(list(at) if isinstance(at, dict) else range(len(at)))
        path.append((at, key))
        at = at[key]
    holder, key = path[-1]
    if random.random() < 0.2:
        del holder[key]
    else:
        holder[key] = random.choice([None, 0, -1, 1e300, 1e-320, "", "x", [], {}, True, 2**63, 2**64, "../../x",
                                     [0], {"a": 1}, 0.5])
    return value


def run(folder, words):
    """Runs a command in a folder and checks its end."""
    process = subprocess.Popen([str(word) for word in words], cwd=folder, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, env=faults.environment(ASAN_OPTIONS="detect_leaks=0"))
    stopped = False
    try:
        _, errors = process.communicate(timeout=5)
    except subprocess.TimeoutExpired:
        stopped = True
        process.send_signal(signal.SIGTERM)
        try:
            _, errors = process.communicate(timeout=30)
        except subprocess.TimeoutExpired:
            process.kill()
            _, errors = process.communicate()
    errors = errors.decode(errors="replace")
    code = process.returncode
    tally[code] = tally.get(code, 0) + 1
    line = " ".join(str(word) for word in words[1:])
    allowed = {0, 1, 2, 4, 5} | ({130} if stopped else set())
    failures.expect(code in allowed, f"{line}: exit code {code}: {errors[-600:]}")
    failures.expect(not re.search("Sanitizer|runtime error|terminate called|Assertion", errors),
                    f"{line}: {errors[:1500]}")
    if code == 2:
        failures.expect(errors.count("\n") == 1 and len(errors) < 600, f"{line}: {errors[:600]}")
        written = sorted(path.name for path in folder.rglob("*") if path.name.startswith("out"))
        failures.expect(not written or words[1] == "check", f"{line}: wrote {written}")
    return code


def commands_of_scene(scene):
    return random.choice([
        [oiler, "play", scene, "--steps", "60", "--json", "out.json", "--trace", "out.csv", "--energy", "out_energy.csv"],
        [oiler, "play", scene, "--headless", "--frames", "3", "--size", "48x27", "--out", "out", "--sheet", "out.png"],
        [oiler, "play", scene, "--steps", "20", "--method", random.choice(methods), "--json", "out.json"],
        [oiler, "rates", scene, "--rates", "60", "--json", "out.json"],
        [oiler, "check", scene, "--junit", "out.xml"],
        [oiler, "ledger", scene, "--json", "out.json"],
        [oiler, "advise", scene, "--position-error", "0.1", "--methods", "rk4", "--json", "out.json"],
    ])


def options_of_help(command):
    _, text, _ = faults.run([oiler, command, "--help"])
    return re.findall(r"^  (?:-\w,)?(--[\w-]+)( \S+)?", text, re.M)


def random_line(command):
    words = [oiler, command]
    arguments = {"compare": ["golden", "actual"], "diverge": ["a.csv", "b.csv"], "merge": ["parts/part-1-of-2.json"],
                 "new": ["out_game"]}
    words += arguments.get(command, ["scene.toml"]) if random.random() < 0.9 else []
    table = options_of_help(command)
    for name, takes in random.sample(table, min(len(table), random.randrange(1, 6))):
        words.append(name)
        if takes and random.random() < 0.95:
            words.append(random.choice([
                *numbers, "", "-", "out", "out.json", "out/x.csv", "scene.toml", "64x36", "0x0", "99999x99999", "60",
                "rk4", "exact", "rk4,exact", "1/2", "float", "double", "kick", "all", "none", "osmesa", "x" * 300, "ü",
                "golden", "golden/manifest.json", "/proc/none", "/dev/null", "out.gif", "%s", "--json", "out\n.json"]))
    if command == "play":
        words += ["--steps", "50"] if random.random() < 0.5 else ["--headless", "--frames", "2", "--out", "out_frames"]
    return words


def fresh(work, samples):
    folder = work / "run"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(samples, folder)
    return folder


def make_samples(folder):
    """A scene, two captures, two traces and the parts of a sweep."""
    folder.mkdir()
    shutil.copy(faults.root / "assets/scenes/jump.toml", folder / "scene.toml")
    frames = [oiler, "play", "scene.toml", "--headless", "--frames", "4", "--size", "48x27"]
    part = [oiler, "tradeoff", "scene.toml", "--methods", "rk4,exact", "--max-rate", "90", "--quiet", "--out", "parts"]
    for line in ([*frames, "--out", "golden"], [*frames, "--out", "actual", "--rate", "90"],
                 [oiler, "play", "scene.toml", "--steps", "30", "--trace", "a.csv"],
                 [oiler, "play", "scene.toml", "--steps", "30", "--rate", "90", "--trace", "b.csv"],
                 [*part, "--shard", "1/2"], [*part, "--shard", "2/2"]):
        subprocess.run([str(word) for word in line], cwd=folder, check=True, capture_output=True,
                       env=faults.environment(ASAN_OPTIONS="detect_leaks=0"))


def try_scene(folder):
    text = damaged(random.choice(scenes).read_bytes())
    (folder / "scene.toml").write_bytes(text)
    return run(folder, commands_of_scene("scene.toml"))


def try_line(folder):
    return run(folder, random_line(random.choice(commands)))


def try_data(folder):
    """Damages a part of a sweep, a manifest, a record or a trace."""
    name = random.choice(["parts/part-1-of-2.json", "parts/part-1-of-2.json", "golden/manifest.json",
                          "golden/frames.jsonl.gz", "golden/frame_000001.png", "a.csv"])
    path = folder / name
    if path.suffix == ".json" and random.random() < 0.7:
        path.write_text(json.dumps(changed_value(json.loads(path.read_text()))))
    else:
        path.write_bytes(damaged(path.read_bytes()))
    lines = {"parts": [oiler, "merge", "parts/part-1-of-2.json", "parts/part-2-of-2.json", "--out", "out"],
             "a.csv": [oiler, "diverge", "a.csv", "b.csv", "--json", "out.json"]}
    of_capture = [[oiler, "compare", "golden", "actual", "--out", "out", "--json", "out.json"],
                  [oiler, "diverge", "golden", "actual", "--json", "out.json"],
                  [oiler, "play", "--from", "golden/manifest.json", "--frame", "1", "--out", "out_frame"]]
    return run(folder, lines.get(name.split("/")[0], random.choice(of_capture)))


_, listing, _ = faults.run([oiler, "methods", "--json", "-"])
methods = [method["name"] for method in json.loads(listing)]
_, overview, _ = faults.run([oiler, "--help"])
commands = [name for name in re.findall(r"^  ([a-z]+) ", overview, re.M) if name not in ("figures", "certify", "demos")]

with faults.new_folder() as name:
    work = Path(name)
    make_samples(work / "samples")
    for attempt, count in ((try_scene, options.count), (try_line, options.count), (try_data, options.count // 2)):
        tally.clear()
        state = random.getrandbits(64)
        for i in range(count):
            random.seed(state + i)
            before = failures.count
            attempt(fresh(work, work / "samples"))
            if failures.count > before:
                kept = Path(f"/tmp/oiler-bad-input-{attempt.__name__}-{i}")
                shutil.rmtree(kept, ignore_errors=True)
                shutil.copytree(work / "run", kept)
                print(f"  kept in {kept}", flush=True)
        ends = ", ".join(f"{code}: {number}" for code, number in sorted(tally.items()))
        print(f"{attempt.__name__}: exit codes {ends}", flush=True)
failures.end()
