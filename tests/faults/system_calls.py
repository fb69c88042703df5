#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Lets each system call that opens, writes, names, removes or starts something fail once, in every
command that writes. Each run ends with exit code 4 and one line, or as if nothing had failed. Inputs
and older outputs stay whole, new ones are whole, and no temporary file is left. Exits with 77 without
strace."""

import os
import os
import random
import re
import shutil
import subprocess
import sys
from collections import Counter
from pathlib import Path

import faults
import signals

options = faults.arguments(__doc__.splitlines()[0], count=12, short_count=1)
failures = faults.Failures()
ERRORS = {
    "openat": ["ENOSPC", "EIO", "EACCES", "EMFILE", "EINTR"],
    "write": ["ENOSPC", "EIO", "EINTR", "EDQUOT"],
    "pwrite64": ["ENOSPC", "EIO"],
    "fsync": ["EIO", "ENOSPC", "EINTR"],
    "syncfs": ["EIO", "ENOSPC"],
    "rename": ["EIO", "EXDEV", "ENOSPC", "EACCES"],
    "linkat": ["EIO", "EXDEV", "ENOSPC", "EACCES"],
    "close": ["EIO", "EINTR", "ENOSPC"],
    "mkdir": ["ENOSPC", "EIO", "EACCES"],
    "unlink": ["EIO", "EACCES"],
    "unlinkat": ["EIO", "EACCES"],
    "ftruncate": ["EIO"],
    "fchmod": ["EPERM"],
    "flock": ["ENOLCK"],
    "read": ["EIO", "EINTR"],
    "getdents64": ["EIO"],
    "pipe2": ["EMFILE"],
    "memfd_create": ["ENOMEM"],
    "clone": ["EAGAIN", "ENOMEM"],
    "execve": ["ENOENT", "EACCES"],
}
OF_NO_FILE = {"pipe2", "memfd_create", "clone"}
OF_PATHS = {"openat", "rename", "linkat", "mkdir", "unlink", "unlinkat"}
REMOVALS = {"unlink", "unlinkat", "rename", "close", "openat", "getdents64"}
SCENE = """[scene]
axes = 1
duration = 0.2
rate = 60
[[body]]
name = "mass"
position = [1.0]
[[spring]]
body = "mass"
anchor = [0.0]
stiffness = 15.0
damping = 0.1
[budget]
position_error = 1.0
"""
FRAMES = ["--headless", "--quiet", "--size", "64x36", "--frames", "3"]
SWEEP = ["oiler", "tradeoff", "in/scene.toml", "--methods", "rk4,exact", "--max-rate", "60", "--quiet"]

# The commands by name. "out" has the outputs of an earlier run with other settings.
COMMANDS = {
    "capture": ["hello", *FRAMES, "--out", "out/frames", "--json", "out/run.json", "--trace", "out/trace.csv",
                "--energy", "out/energy.csv", "--profile", "out/profile.json", "--sheet", "out/sheet.png"],
    "golden": ["hello", *FRAMES, "--golden", "out/golden", "--update-golden", "--force"],
    "video": ["hello", *FRAMES, "--out", "out/frames", "--video", "out/film.gif"],
    "record": ["hello", "--steps", "200", "--quiet", "--record", "out/play.rec"],
    "what-if": ["hello", "--replay", "in/play.rec", "--what-if", "30", "--quiet", "--json", "out/what_if.json"],
    "still": ["oiler", "play", "in/scene.toml", "--headless", "--quiet", "--size", "64x36", "--frame", "2",
              "--out", "out/still"],
    "compared": ["hello", *FRAMES, "--golden", "in/golden", "--out", "out/frames", "--junit", "out/now.xml"],
    "tradeoff": [*SWEEP, "--out", "out/sweep", "--json", "out/copy.json", "--size", "64x36"],
    "shard": [*SWEEP, "--out", "out/parts", "--shard", "1/2"],
    "merge": ["oiler", "merge", "in/parts/part-1-of-2.json", "in/parts/part-2-of-2.json", "--out", "out/whole",
              "--size", "64x36", "--quiet", "--json", "out/copy.json"],
    "apply": ["oiler", "advise", "out/scene.toml", "--position-error", "0.1", "--methods", "rk4,exact", "--apply",
              "--quiet", "--json", "out/advice.json"],
    "report": ["oiler", "report", "in/scene.toml", "--out", "out/report.html", "--json", "out/report.json", "--quiet"],
    "rates": ["oiler", "rates", "in/scene.toml", "--json", "out/rates.json", "--quiet"],
    "ledger": ["oiler", "ledger", "in/scene.toml", "--json", "out/ledger.json"],
    "check": ["oiler", "check", "in/scene.toml", "--junit", "out/check.xml", "--json", "out/check.json"],
    "compare": ["oiler", "compare", "in/golden", "in/actual", "--out", "out/differences", "--junit", "out/compare.xml",
                "--json", "out/compare.json"],
    "diverge": ["oiler", "diverge", "in/a.csv", "in/b.csv", "--json", "out/diverge.json"],
    "certify": ["oiler", "certify", "explicit_euler", "--json", "out/certify.json", "--quiet"],
    "methods": ["oiler", "methods", "--json", "out/methods.json"],
    "stability": ["oiler", "stability", "explicit_euler", "--out", "out/stability", "--size", "64x36", "--quiet"],
    "figures": ["oiler", "figures", "--out", "out/figures", "--size", "64x36", "--quiet"],
    "new": ["oiler", "new", "out/cannon"],
}
SHORT = ["capture", "golden", "record", "tradeoff", "merge", "apply", "compare", "new"]
SLOW = ["report"]  # some seconds: a run for each system call
# The earlier run had another rate, so that these differ.
OF_ANOTHER_RATE = {"capture": ["out/run.json", "out/trace.csv", "out/frames/manifest.json"],
                   "golden": ["out/golden/manifest.json"], "record": ["out/play.rec"],
                   "video": ["out/frames/manifest.json"], "compared": ["out/frames/manifest.json"]}
NORMAL = {"compare": 1, "diverge": 1}


def run(folder, words, before=()):
    line = [*before, str(options.programs / words[0]), *words[1:]]
    try:
        done = subprocess.run(line, cwd=folder, capture_output=True, text=True, errors="replace", timeout=120,
                              env=faults.environment())
    except subprocess.TimeoutExpired:
        return None, ""
    return done.returncode, done.stderr


def with_other_settings(name, words):
    """The command of the earlier run."""
    if name in OF_ANOTHER_RATE:
        return [*words, "--rate", "30"]
    return words


def make_samples(folder):
    """A folder with the inputs and, for each command, the outputs of an earlier run."""
    (folder / "in").mkdir(parents=True)
    (folder / "out").mkdir()
    (folder / "in/scene.toml").write_text(SCENE)
    for line in ([*SWEEP, "--shard", "1/2", "--out", "in/parts"], [*SWEEP, "--shard", "2/2", "--out", "in/parts"],
                 ["hello", *FRAMES, "--out", "in/golden"],
                 ["hello", *FRAMES, "--rate", "30", "--out", "in/actual"],
                 ["hello", "--steps", "30", "--trace", "in/a.csv"],
                 ["hello", "--steps", "30", "--rate", "30", "--trace", "in/b.csv"],
                 ["hello", "--steps", "60", "--record", "in/play.rec"]):
        code, errors = run(folder, line)
        if code == 3:
            print("skipped:", errors)
            sys.exit(77)
        if code:
            sys.exit(f"{line}: {errors}")


def sample_of(name, words, samples, work):
    """The folder with the outputs of an earlier run of the command."""
    folder = work / "older" / name
    shutil.copytree(samples, folder)
    if name == "apply":
        shutil.copy(folder / "in/scene.toml", folder / "out/scene.toml")
    elif name != "new":
        code, errors = run(folder, with_other_settings(name, words))
        if code not in (0, 1):
            sys.exit(f"{name}: {errors}")
    return folder


def bytes_in(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def calls_of(folder, words):
    """The ordinals of the calls of each kind that concern the folder. strace counts them per thread."""
    log = folder.parent / "calls"
    before = ["strace", "-f", "-y", "-qq", "-o", str(log), "-e", "trace=" + ",".join(ERRORS)]
    code, errors = run(folder, words, before)
    counts, ordinals = Counter(), {}
    for line in log.read_text(errors="replace").splitlines():
        match = re.match(r"(\d+) +(\w+)\(", line)
        if not match:
            continue
        counts[match.groups()] += 1
        call = match[2]
        is_own = call == "execve" and '"ffmpeg"' in line
        names = re.sub(r'"([^/"][^"]*)"', str(folder) + r"/\1", line) if call in OF_PATHS else line.split(",")[0]
        if call in OF_NO_FILE or is_own or (call != "execve" and str(folder) in names):
            ordinals.setdefault(call, set()).add(counts[match.groups()])
    return code, {call: sorted(found) for call, found in ordinals.items()}


def faults_of_outputs(folder):
    """Outputs that are not whole, by the checks of the campaign of signals."""
    signals.KINDS.setdefault(".rec", lambda path: None)
    signals.KINDS.setdefault(".toml", signals.fault_of_text)
    signals.KINDS.setdefault(".gif", lambda path: None if path.read_bytes().endswith(b";") else "is not complete")
    yield from signals.faults_of_files(folder)
    for manifest in folder.rglob("manifest.json"):
        yield from (f"lies: {lie}" for lie in faults.lies_of(manifest.parent))


def judge(case, name, call, code, errors, folder, older, normal):
    """Checks the end of a run and the files that it left."""
    if code == 127:  # the call was one of the loader, before the program began
        return
    allowed = {normal, 4} | ({130} if "EINTR" in case else set())
    if call in OF_NO_FILE | {"openat", "read"}:
        allowed.add(3)  # of a driver
    if call in ("openat", "read", "getdents64", "execve"):
        allowed.add(2)  # an input seems to be missing
    failures.expect(code in allowed, f"{case}: exit code {code}: {errors[-300:]}")
    failures.expect(code == normal or errors.count("\n") == 1, f"{case}: {errors[-300:]}")
    now = bytes_in(folder)
    changed = [path for path, data in older.items() if path.startswith("in/") and now.get(path) != data]
    failures.expect(not changed, f"{case}: changed inputs {changed}")
    # A golden that cannot be replaced is beside the old one, as the message says.
    is_told = name == "golden" and re.search(r"oiler-new|next capture|the next one removes", errors)
    left = [path for path in now if "/.oiler-" in path and not is_told]
    failures.expect(not left or call in REMOVALS, f"{case}: left {left}")
    for hidden in list((folder / "out").rglob(".oiler-*")):  # removed or put back by the next run
        shutil.rmtree(hidden) if hidden.is_dir() else hidden.unlink(missing_ok=True)
    for fault in faults_of_outputs(folder / "out"):
        failures.expect(False, f"{case}: exit code {code}, {fault}")
    lost = [path for path in older if path.startswith("out/") and path not in now
            and not (name in ("capture", "video", "compared", "compare", "golden"))]
    failures.expect(not lost, f"{case}: exit code {code}, lost {lost}")
    if name == "golden":
        golden = {path: data for path, data in now.items() if re.fullmatch(r"out/golden/[^/.].*", path)}
        old = {path: data for path, data in older.items() if path.startswith("out/golden/")}
        is_old = golden == old
        failures.expect(is_old or code == 0 or call in REMOVALS,
                        f"{case}: exit code {code}, the golden is neither old nor new")
    stale = [path for path in OF_ANOTHER_RATE.get(name, []) if now.get(path) == older[path]]
    failures.expect(code != 0 or not stale, f"{case}: exit code 0, but {stale} are the older ones")


def limited(letter, limit):
    """The start of a command under a limit. That of threads is not for root: nobody gets its rights on files."""
    nobody = ["setpriv", "--reuid=65534", "--ambient-caps=-all,+dac_override", "--inh-caps=-all,+dac_override"]
    return [*(nobody if letter == "u" and os.getuid() == 0 else []),
            "bash", "-c", f"ulimit -{letter} {limit}; exec \"$@\"", "bash"]


def campaign(name, words, sample, work):
    folder = work / "run"

    def fresh():
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(sample, folder)

    fresh()
    older = bytes_in(folder)
    code, ordinals = calls_of(folder, words)
    normal = NORMAL.get(name, 0)
    failures.expect(code == normal, f"{name}: exit code {code} without a fault")
    ends = Counter()
    for call, found in sorted(ordinals.items()):
        is_slow = name in SLOW
        for error in random.sample(ERRORS[call], 1 if is_slow else len(ERRORS[call])):
            for at in sorted(random.sample(found, min(1 if is_slow else options.count, len(found)))):
                fresh()
                inject = f"inject={call}:error={error}:when={at}"
                before = ["strace", "-f", "-qq", "-o", "/dev/null", "-e", "trace=" + call, "-e", inject]
                code, errors = run(folder, words, before)
                ends[code] += 1
                judge(f"{name}: {call} {at} {error}", name, call, code, errors, folder, older, normal)
    for letter, least, call in (("f", 1, "write"), ("u", 1, "clone")):
        for limit in random.sample(range(least, least + 12), min(12, options.count)):
            fresh()
            code, errors = run(folder, words, limited(letter, limit))
            ends[code] += 1
            judge(f"{name}: ulimit -{letter} {limit}", name, call, code, errors, folder, older, normal)
    tally = ", ".join(f"{end}: {count}" for end, count in sorted(ends.items(), key=str))
    print(f"{name}: exit codes {tally}", flush=True)


if not shutil.which("strace") or not shutil.which("pngcheck"):
    print("system_calls: install the Debian packages strace and pngcheck")
    sys.exit(77)
with faults.new_folder() as root:
    work = Path(root).resolve()
    make_samples(work / "samples")
    for name in SHORT if options.short else COMMANDS:
        if name == "video" and not shutil.which("ffmpeg"):
            continue
        campaign(name, COMMANDS[name], sample_of(name, COMMANDS[name], work / "samples", work), work)
failures.end()
