# SPDX-License-Identifier: MIT
"""Helpers of the campaigns in this folder. They need Debian's python3 only."""

import argparse
import json
import os
import random
import subprocess
import sys
import tempfile
from pathlib import Path

root = Path(__file__).resolve().parents[2]


def arguments(description, count, short_count):
    """Parses --count, --short, --seed and --programs, and prints the seed."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--count", type=int, help=f"number of runs, {count} if not given")
    parser.add_argument("--short", action="store_true", help=f"{short_count} runs")
    parser.add_argument("--seed", type=int, default=random.randrange(10**6))
    parser.add_argument("--programs", type=Path, default=root / "build/bin", help="build/bin")
    options = parser.parse_args()
    options.programs = options.programs.resolve()
    options.count = options.count or (short_count if options.short else count)
    random.seed(options.seed)
    print(f"{options.count} runs, --seed {options.seed}", flush=True)
    return options


def environment(**extra):
    plain = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "WAYLAND_DISPLAY", "CI")}
    return plain | extra


def run(command, **extra):
    """Runs a program and returns its exit code, standard output and standard error."""
    words = [str(word) for word in command]
    done = subprocess.run(words, capture_output=True, text=True, env=environment(**extra))
    return done.returncode, done.stdout, done.stderr


def contents(folder):
    """The bytes of all files in a folder by name."""
    if not folder.exists():
        return {}
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


def lies_of(folder):
    """The lies of a folder: damaged frames, and claims of its manifest that do not hold."""
    files = contents(folder)
    lies = []
    frames = sorted(name for name in files if name.startswith("frame_"))
    if frames:
        check = subprocess.run(["pngcheck", "-q", *(folder / name for name in frames)],
                               capture_output=True, text=True)
        lies += [check.stdout] if check.returncode else []
    if "manifest.json" not in files:
        return lies
    try:
        manifest = json.loads(files["manifest.json"])
    except ValueError as error:
        return lies + [f"manifest.json: {error}"]
    listed = [frame["file"] for frame in manifest["frames"] if frame["file"]]
    lies += [f"manifest.json lists {name}" for name in listed if name not in files]
    complete = len(manifest["frames"]) == manifest["planned_frames"]
    if manifest["finished"] != complete:
        lies.append(f"finished is {manifest['finished']}")
    if manifest["finished"] and listed != frames:
        lies.append("finished, but the frames are others")
    return lies


def is_finished(folder):
    path = folder / "manifest.json"
    return path.exists() and json.loads(path.read_bytes())["finished"]


class Failures:
    """Counts and prints failures; exits with 1 at the end if there was one."""

    def __init__(self):
        self.count = 0

    def expect(self, holds, words):
        if not holds:
            self.count += 1
            print(f"FAILED: {words}", flush=True)

    def end(self):
        print("failed" if self.count else "passed")
        sys.exit(1 if self.count else 0)


def new_folder():
    return tempfile.TemporaryDirectory(prefix="oiler-faults-")
