#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Kills captures with SIGKILL at random moments, and starts two captures into one folder.

After a kill, each frame under its final name is complete and the manifest tells no lie. The same
command then completes the capture, names the killed process and leaves no temporary file. Of two
captures, the folder has one alone, and the other exits with 4 and names the owner."""

import collections
import random
import shutil
import subprocess
import time
from pathlib import Path

import faults

options = faults.arguments(__doc__.splitlines()[0], count=100, short_count=10)
failures = faults.Failures()
counts = collections.Counter()


def capture(demo, out, frames, size="320x180"):
    words = ["--headless", "--frames", frames, "--size", size, "--out", out]
    return [str(word) for word in [options.programs / demo, *words]]


def start(command):
    return subprocess.Popen(
        command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, env=faults.environment()
    )


def reference(folder, command):
    """Captures alone; returns the files and the time in seconds."""
    begin = time.monotonic()
    code, _, errors = faults.run(command)
    if code == 3:
        print("skipped:", errors)
        raise SystemExit(77)
    failures.expect(code == 0, errors)
    return faults.contents(folder), time.monotonic() - begin


def wait_for_moment(process, folder, seconds):
    """Waits for a random moment: one of the whole run, or one soon after the lock appears."""
    if random.random() < 0.6:
        time.sleep(random.uniform(0, 1.1 * seconds))
        return
    while process.poll() is None and not (folder / ".oiler-capture").exists():
        time.sleep(0.0002)
    time.sleep(random.expovariate(1 / 0.01))


def state_of(folder):
    """The state that the kill left behind."""
    files = faults.contents(folder)
    frames = sum(name.startswith("frame_") for name in files)
    counts["frames"] += frames
    counts["temporary files"] += sum(name.endswith(".tmp") for name in files)
    if not files:
        return "before the capture began"
    if ".oiler-capture" not in files:
        return "outside of the capture"
    if "manifest.json" not in files:
        return "before the first manifest"
    return "after the last frame" if faults.is_finished(folder) else "among the frames"


def kill_once(folder, frames, expected, earlier, seconds):
    command = capture("hello", folder, frames)
    process = start(command)
    wait_for_moment(process, folder, seconds)
    process.kill()
    process.communicate()
    state = state_of(folder)
    counts[state] += 1
    lies = faults.lies_of(folder)
    failures.expect(not lies, f"after a kill {state}, {len(lies)} lies: {lies[:1]}")
    for name, data in faults.contents(folder).items():
        if name.startswith("frame_"):
            known = data in (expected.get(name), earlier.get(name))
            failures.expect(known, f"{name} has other bytes after a kill {state}")
    was_locked = (folder / ".oiler-capture").exists()
    unfinished = was_locked and not faults.is_finished(folder)
    code, _, errors = faults.run(command)
    failures.expect(code == 0, f"capturing again after a kill {state}: {errors}")
    named = f"unfinished capture of process {process.pid} " in errors
    failures.expect(named == unfinished, f"after a kill {state}: {errors}")
    left = faults.contents(folder)
    strange = sorted(set(left) ^ set(expected))
    failures.expect(left == expected, f"after a kill {state}, the folder differs: {strange}")


def kill_captures(work):
    frames = 150
    expected, seconds = reference(work / "a", capture("hello", work / "a", frames))
    earlier, _ = reference(work / "b", capture("hello", work / "b", 2 * frames, "64x36"))
    for i in range(options.count):
        folder = work / f"killed{i}"
        is_used = random.random() < 0.5
        if is_used:
            shutil.copytree(work / "b", folder)
        counts["with an earlier capture" if is_used else "into a new folder"] += 1
        kill_once(folder, frames, expected, earlier if is_used else {}, seconds)
        shutil.rmtree(folder)
    print(f"kills: {dict(counts)}")


def end_of(process):
    return process.wait(), process.stderr.read().decode()


def race_once(folder, commands, expected, seconds):
    """Starts both captures, the second one some time after the first."""
    order = random.sample(range(2), 2)
    processes = {order[0]: start(commands[order[0]])}
    time.sleep(random.choice([0, random.uniform(0, 0.05), random.uniform(0, 1.5 * seconds)]))
    processes[order[1]] = start(commands[order[1]])
    ends = {index: end_of(process) for index, process in processes.items()}
    codes = sorted(code for code, _ in ends.values())
    counts[f"exit codes {codes}"] += 1
    failures.expect(codes in ([0, 0], [0, 4]), f"exit codes {codes}: {ends}")
    left = faults.contents(folder)
    for index, (code, errors) in ends.items():
        owner = f"process {processes[1 - index].pid} of "
        if code == 4:
            failures.expect(owner in errors, f"the owner is not named: {errors}")
            failures.expect(left == expected[1 - index], "the folder is not the winner's")
    failures.expect(left in expected, f"the folder is mixed: {sorted(left)[:5]}...")


def race_captures(work):
    counts.clear()
    folder = work / "race"
    commands = [capture("hello", folder, 60), capture("hello", folder, 45, "200x112")]
    expected, seconds = [], 0
    for command in commands:
        files, seconds = reference(folder, command)
        expected.append(files)
        shutil.rmtree(folder)
    for _ in range(options.count):
        race_once(folder, commands, expected, seconds)
        shutil.rmtree(folder, ignore_errors=True)
    print(f"pairs: {dict(counts)}")


with faults.new_folder() as name:
    kill_captures(Path(name))
    race_captures(Path(name))
failures.end()
