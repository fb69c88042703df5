#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Captures onto full disks, into folders that cannot be written, and with a broken ffmpeg.

Each case ends with exit code 4 and one line that names the reason, without partial files under a
final name and without a manifest that lies. Disks of all sizes are tried, so that each file of a
capture is once the one that does not fit. Small disks are mounted in a namespace of their own."""

import gzip
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import faults

disk_marker = "OILER_SMALL_DISKS"
if disk_marker not in os.environ:
    unshare = ["unshare", "--map-root-user", "--mount"]
    mount = [*unshare, "mount", "-t", "tmpfs", "none", "/mnt"]
    refusal = subprocess.run(mount, capture_output=True, text=True)
    os.environ[disk_marker] = refusal.stderr.strip() if refusal.returncode else "yes"
    if refusal.returncode == 0:
        os.execvp(unshare[0], [*unshare, sys.executable, *sys.argv])

options = faults.arguments(__doc__.splitlines()[0], count=60, short_count=12)
failures = faults.Failures()
hello = options.programs / "hello"


def row(name, code, errors, left):
    """Prints a line of the table."""
    last = errors.strip().splitlines()[-1] if errors.strip() else "-"
    print(f"| {name} | {code} | {last} | {left} |", flush=True)


def damage_of_records(folder):
    path = folder / "frames.jsonl.gz"
    try:
        gzip.decompress(path.read_bytes() if path.exists() else b"")
    except (EOFError, OSError) as error:
        return f"frames.jsonl.gz: {error}"


def check(name, folder, code, errors, expected_code, reason, shows=True):
    """Checks the end of a run and the files that it left in `folder`."""
    files = sorted(faults.contents(folder))
    frames = sum(file.startswith("frame_") for file in files)
    others = [file for file in files if not file.startswith("frame_")]
    if shows:
        row(name, code, errors, f"{frames} frames, {', '.join(others) or 'no other file'}")
    failures.expect(code == expected_code, f"{name}: exit code {code}: {errors}")
    failures.expect(errors.count("\n") <= 1 and reason in errors, f"{name}: {errors}")
    hidden = [file for file in others if file.startswith(".")]
    failures.expect(not hidden, f"{name}: left {hidden}")
    lies = faults.lies_of(folder)
    failures.expect(not lies, f"{name}, {len(lies)} lies: {lies[:1]}")
    failures.expect(not damage_of_records(folder), f"{name}: {damage_of_records(folder)}")


def run(out, *words, **variables):
    command = [hello, "--headless", "--quiet", "--size", "64x36", "--out", out, *words]
    code, _, errors = faults.run(command, **variables)
    if code == 3:
        print("skipped:", errors)
        sys.exit(77)
    return code, errors


class Disk:
    """A mounted disk of some KiB."""

    def __init__(self, work, kibibytes):
        self.path = work / "disk"
        self.path.mkdir(exist_ok=True)
        size = f"size={kibibytes}k"
        subprocess.run(["mount", "-t", "tmpfs", "-o", size, "none", self.path], check=True)

    def __enter__(self):
        return self.path

    def __exit__(self, *_):
        subprocess.run(["umount", self.path], check=True)


def sizes(largest):
    """Disk sizes in KiB, in pages."""
    step = max(4, largest // options.count // 4 * 4)
    return range(4, largest + 1, step)


def fill(path):
    with open(path / "filler", "wb", buffering=0) as file:
        try:
            while True:
                file.write(bytes(4096))
        except OSError:
            pass


def ends_of_disks(name, work, largest, run_on):
    """Runs on disks of all sizes; each run succeeds or says that the disk is full."""
    codes, refusal = [], ""
    for size in sizes(largest):
        with Disk(work, size) as disk:
            code, errors, folder = run_on(disk)
            codes.append(code)
            refusal = errors or refusal
            reason = "No space left on device" if code else ""
            expected = 4 if code else 0
            check(f"{name}, {size} KiB", folder, code, errors, expected, reason, shows=False)
            if code == 0:
                failures.expect(faults.is_finished(folder), f"{name}, {size} KiB: not finished")
    both = {0, 4} <= set(codes)
    failures.expect(both, f"{name}: the sizes do not span the limit: {codes}")
    sizes_tried = f"{name}, {len(codes)} disks up to {largest} KiB"
    row(sizes_tried, sorted(set(codes)), refusal, "no partial file")


def full_disks(work):
    reason = os.environ[disk_marker]
    if reason != "yes":
        print(f"| small disks | skipped | {reason} | |")
        return

    def frames(disk):
        return *run(disk / "out", "--frames", 20), disk / "out"

    def one_frame(disk):
        return *run(disk / "out", "--frames", 1), disk / "out"

    def video(disk):  # the frames are on another disk
        out = work / "elsewhere"
        shutil.rmtree(out, ignore_errors=True)
        code, errors = run(out, "--frames", 90, "--video", disk / "film.mp4")
        left = sorted(faults.contents(disk))
        failures.expect(left == (["film.mp4"] if code == 0 else []), f"the video left {left}")
        return code, errors, out

    earlier = work / "earlier"
    run(earlier, "--frames", 3)
    ends_of_disks("20 frames", work, 240, frames)
    ends_of_disks("1 frame", work, 60, one_frame)
    if shutil.which("ffmpeg"):
        ends_of_disks("a video of 90 frames", work, 24, video)
    with Disk(work, 200) as disk:
        shutil.copytree(earlier, disk / "out")
        before = faults.contents(disk / "out")
        fill(disk)
        code, errors = run(disk / "out", "--frames", 3)
        check("an earlier capture on a full disk", disk / "out", code, errors, 4, "No space left")
        kept = faults.contents(disk / "out") == before
        failures.expect(kept, "the earlier capture was not kept")
    with Disk(work, 400) as disk:
        (disk / "out").mkdir()
        subprocess.run(["mount", "-o", "remount,ro", disk], check=True)
        code, errors = run(disk / "out", "--frames", 2)
        check("a read-only disk", disk / "out", code, errors, 4, "Read-only file system")


def outputs_that_are_full(work):
    for option in ("--json", "--trace", "--energy", "--profile", "--sheet", "--junit"):
        out = work / f"full{option}"
        golden = ["--golden", work / "earlier"] if option == "--junit" else []
        code, errors = run(out, "--frames", 3, option, "/dev/full", *golden)
        check(f"{option} /dev/full", out, code, errors, 4, "cannot write /dev/full: No space left")


def unwritable_folders(work):
    (work / "file").write_text("mine")
    code, errors = run(work / "file" / "out", "--frames", 2)
    check("a folder below a file", work / "none", code, errors, 4, "Not a directory")
    code, errors = run("/proc/out", "--frames", 2)
    check("a folder in /proc", work / "none", code, errors, 4, "cannot make the folder /proc/out")
    foreign = work / "foreign"
    foreign.mkdir()
    (foreign / "frame_000001.png").write_text("mine")
    code, errors = run(foreign, "--frames", 2)
    mine = (foreign / "frame_000001.png").read_text()
    row("frames of another program", code, errors, "1 frame, untouched")
    failures.expect(code == 4 and mine == "mine", f"frames of another program: {errors}")


def kill_ffmpeg(work):
    """Kills the ffmpeg of a capture that goes on."""
    out, film = work / "killed", work / "killed.mp4"
    words = ["--headless", "--quiet", "--size", "320x180", "--frames", 3000, "--out", out]
    process = subprocess.Popen(
        [str(word) for word in [hello, *words, "--video", film]],
        stderr=subprocess.PIPE,
        text=True,
        env=faults.environment(),
    )
    children = Path(f"/proc/{process.pid}/task/{process.pid}/children")
    while process.poll() is None and not (out / "frame_000009.png").exists():
        time.sleep(0.002)
    if process.poll() is None:
        os.kill(int(children.read_text().split()[0]), signal.SIGKILL)
    _, errors = process.communicate()
    check("ffmpeg killed", out, process.returncode, errors, 4, "ffmpeg ended with signal 9")
    left = [path.name for path in work.iterdir() if path.name.startswith((".oiler", "killed.mp4"))]
    failures.expect(not left, f"ffmpeg killed: left {left}")


def videos(work):
    out = work / "video"
    run(out, "--frames", 2)
    before = faults.contents(out)
    for name, film, code_then, reason, path in [
        ("ffmpeg missing", "film.mp4", 4, "install the Debian package ffmpeg", "/nowhere"),
        ("another ending", "film.avi", 2, "ends with .mp4, .gif or .apng", os.environ["PATH"]),
    ]:
        code, errors = run(out, "--frames", 3, "--video", work / "new" / film, PATH=path)
        check(name, out, code, errors, code_then, reason)
        failures.expect(faults.contents(out) == before, f"{name}: the earlier capture is gone")
        failures.expect(not faults.contents(work / "new"), f"{name}: left a file")
    if shutil.which("ffmpeg"):
        kill_ffmpeg(work)


with faults.new_folder() as folder:
    print("| case | exit code | message | left in the folder |\n|---|---|---|---|")
    full_disks(Path(folder))
    run(Path(folder) / "earlier", "--frames", 3)
    outputs_that_are_full(Path(folder))
    unwritable_folders(Path(folder))
    videos(Path(folder))
failures.end()
