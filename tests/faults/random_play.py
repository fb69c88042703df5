#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Plays a game at random, records it, and replays the recording in other circumstances.

    tests/faults/random_play.py build/bin/cannon --seeds 100
    tests/faults/random_play.py build-debug/bin/cannon --seeds 1 --steps 216000 --memory

Each seed is a script of random keys, clicks and wheel turns. The recording is replayed with three
threads, as frames at 30 and 144 per second, and by another build of the game (--replay-with). It
exits with 1 if a program fails or a replay differs."""

import argparse
import pathlib
import random
import subprocess
import sys
import tempfile
import time

KEYS = ("A B C D E F G H I J K L M N O P R S T U V W X Y Z 1 2 3 4 5 6 7 8 9 0 Space Enter Tab "
        "Backspace Escape Left Right Up Down").split()
USUAL = "Space Left Right Up Down A D W S R Enter".split()


def script(seed, steps, width, height):
    """One line for about every five steps; the mouse moves within width × height m."""
    dice = random.Random(seed)
    lines, held, step = [], set(), 0
    while True:
        step += dice.randrange(10)
        if step >= steps:
            return "\n".join(lines) + "\n"
        kind = dice.randrange(8)
        key = dice.choice(USUAL if dice.random() < 0.7 else KEYS)
        if kind < 3 and key not in held:
            lines.append(f"{step} press {key}")
        elif kind == 3 and key not in held:
            held.add(key)
            lines.append(f"{step} hold {key}")
        elif kind == 4 and held:
            released = dice.choice(sorted(held))
            held.remove(released)
            lines.append(f"{step} release {released}")
        elif kind == 5:
            lines.append(f"{step} mouse {dice.uniform(-1, width):.3f} {dice.uniform(-1, height):.3f}")
        elif kind == 6:
            lines.append(f"{step} click {dice.choice(['left', 'right'])}")
        elif kind == 7:
            lines.append(f"{step} wheel {dice.choice([-1, 1])}")


def run(command):
    """Returns exit code, the last line of the standard error, and the memory in KiB each second."""
    with tempfile.TemporaryFile("w+") as errors:
        process = subprocess.Popen(command, stderr=errors, stdout=subprocess.DEVNULL)
        memory = []
        while process.poll() is None:
            try:
                status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
                memory += [int(line.split()[1]) for line in status.splitlines() if "VmRSS" in line]
            except OSError:
                pass
            time.sleep(1 if len(memory) > 3 else 0.05)
        errors.seek(0)
        lines = errors.read().strip().splitlines()
        return process.returncode, lines[-1] if lines else "", memory


def replays(options, game, recording, folder):
    """The circumstances under which a recording must play to the same states."""
    frames = ["--headless", "--png", "none", "--size", "64x36", "--out", str(folder / "frames")]
    few = str(max(1, options.steps // 60))
    for program in [game] + options.replay_with:
        base = [program, "--replay", str(recording)]
        yield base + ["--steps", str(options.steps), "--threads", "3"]
        if options.frames:
            yield base + frames + ["--fps", "30", "--frames", few]
            yield base + frames + ["--fps", "144", "--frames", few]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("game")
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--first", type=int, default=1, help="the first seed")
    parser.add_argument("--steps", type=int, default=600)
    parser.add_argument("--size", type=float, nargs=2, default=(40, 20), help="of the world, m")
    parser.add_argument("--replay-with", action="append", default=[], metavar="GAME")
    parser.add_argument("--frames", action="store_true", help="replay as frames, too")
    parser.add_argument("--memory", action="store_true", help="print the memory over the run")
    options = parser.parse_args()
    failures = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for seed in range(options.first, options.first + options.seeds):
            text, recording = folder / "play.txt", folder / "play.rec"
            text.write_text(script(seed, options.steps, *options.size))
            commands = [[options.game, "--steps", str(options.steps), "--script", str(text),
                         "--record", str(recording), "--seed", str(seed)]]
            commands += replays(options, options.game, recording, folder)
            for command in commands:
                code, last, memory = run(command)
                if options.memory and len(memory) > 1:
                    print(f"seed {seed}: MiB each tenth of the run:",
                          *(f"{memory[(len(memory) - 1) * i // 10] / 1024:.1f}" for i in range(11)))
                if code != 0:
                    failures += 1
                    print(f"seed {seed}: exit {code}: {last}\n    {' '.join(command)}")
                    break
    print(f"{options.seeds} seeds of {options.steps} steps: {failures} failed")
    return failures > 0


if __name__ == "__main__":
    sys.exit(main())
