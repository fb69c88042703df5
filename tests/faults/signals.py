#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Interrupts every command of oiler and every demo at random moments. Each must end in time with exit
code 130 and leave whole files. Exits with 1 after a fault, with 77 without pngcheck."""
import gzip
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree

import faults

SCENES = faults.root / "assets" / "scenes"
STEPS = ["--steps", "1000000000", "--json", "{out}/run.json"]
RECORDED = STEPS + ["--trace", "{out}/trace.csv", "--energy", "{out}/energy.csv"]
FRAMES = ["--headless", "--size", "160x90", "--frames", "100000", "--out", "{out}/frames"]
WINDOW = ["--size", "160x90", "--trace", "{out}/trace.csv", "--json", "{out}/run.json"]
SIGNALS = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]
INTERRUPTED = 130


def scene(name):
    return str(SCENES / (name + ".toml"))


# The arguments of each command of oiler. {out} is a new folder, {parts} has the parts of a trade-off.
COMMANDS = {
    "play": [[scene("cloth"), *RECORDED],
             [scene("cloth"), "--method", "implicit_midpoint", *STEPS],
             [scene("orbit"), *FRAMES]],
    "methods": [["--json", "{out}/methods.json"]],
    "certify": [["--json", "{out}/certify.json"]],
    "stability": [["--out", "{out}/stability"]],
    "figures": [["--out", "{out}/figures"]],
    "ledger": [[scene("cloth"), "--json", "{out}/ledger.json"]],
    "tradeoff": [[scene("orbit"), "--out", "{out}/tradeoff", "--json", "{out}/copy.json"]],
    "merge": [["{parts}/part-1-of-2.json", "{parts}/part-2-of-2.json", "--out", "{out}/whole"]],
    "advise": [[scene("orbit"), "--position-error", "1e-3", "--json", "{out}/advice.json"]],
    "rates": [[scene("cloth"), "--json", "{out}/rates.json"]],
    "check": [[scene("orbit"), scene("cloth"), scene("jump"), "--junit", "{out}/check.xml",
               "--json", "{out}/check.json"]],
    "report": [[scene("orbit"), "--out", "{out}/report.html", "--json", "{out}/report.json"]],
    "compare": [["{parts}/golden", "{parts}/actual", "--out", "{out}/differences",
                 "--junit", "{out}/compare.xml", "--json", "{out}/compare.json"]],
    "diverge": [["{parts}/a.csv", "{parts}/b.csv", "--json", "{out}/diverge.json"]],
    "demos": [["orbit.toml", *STEPS]],
    "new": [["{out}/game"]],
}
CAPTURE_OWNER = ".oiler-capture"  # stays after a forced end, to tell the next capture
SHORT = ["play", "certify", "ledger", "report"]
NORMAL_CODES = {"check": {0, 1}, "compare": {0, 1}, "diverge": {0, 1}}


def default_signals():
    for number in [*SIGNALS, signal.SIGPIPE, signal.SIGXFSZ]:
        signal.signal(number, signal.SIG_DFL)


def start(line, before=default_signals, **more):
    return subprocess.Popen(line, preexec_fn=before, text=True, stdout=subprocess.DEVNULL,
                            stderr=subprocess.PIPE, **more)


def wait_for_handlers(process):
    """Waits until the process handles SIGTERM or has ended. Before main it has no handlers."""
    bit = 1 << (signal.SIGTERM - 1)
    while process.poll() is None:
        status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
        caught = [row.split()[1] for row in status.splitlines() if row.startswith("SigCgt")]
        if caught and int(caught[0], 16) & bit:
            return
        time.sleep(0.001)


def fault_of_csv(path):
    rows = path.read_bytes().split(b"\n")
    if rows.pop() or len({row.count(b",") for row in rows}) != 1:
        return "has a partial row"


def fault_of_json(path):
    value = json.loads(path.read_text())
    if path.name == "manifest.json":
        missing = [f["file"] for f in value["frames"] if not (path.parent / f["file"]).exists()]
        return f"names {missing}, which do not exist" if missing else None


def fault_of_html(path):
    return None if path.read_text().rstrip().endswith("</html>") else "is not complete"


def fault_of_xml(path):
    xml.etree.ElementTree.parse(path)


def fault_of_gzip(path):
    gzip.decompress(path.read_bytes())


def fault_of_text(path):
    return None if path.read_text().endswith("\n") else "is not complete"


KINDS = {".csv": fault_of_csv, ".gz": fault_of_gzip, ".html": fault_of_html, ".json": fault_of_json,
         ".xml": fault_of_xml}
KINDS |= dict.fromkeys(["", ".cmake", ".cpp", ".sh", ".txt", ".yml"], fault_of_text)


def faults_of_pictures(pictures):
    if not pictures:
        return
    check = subprocess.run(["pngcheck", "-q", *pictures], text=True, stdout=subprocess.PIPE,
                           stderr=subprocess.STDOUT)
    if check.returncode != 0:
        yield f"has PNGs that are not whole: {check.stdout[-300:]}"


def faults_of_files(folder):
    files = sorted(path for path in folder.rglob("*")
                   if path.is_file() and path.name != CAPTURE_OWNER)
    yield from faults_of_pictures([path for path in files if path.suffix == ".png"])
    for path in (path for path in files if path.suffix != ".png"):
        try:
            fault = KINDS[path.suffix](path) if path.suffix in KINDS else "is an unexpected file"
        except (EOFError, OSError, ValueError, KeyError, IndexError,
                xml.etree.ElementTree.ParseError) as error:
            fault = f"cannot be read: {error}"
        if fault:
            yield f"{path.name} {fault}"


class Campaign:
    def __init__(self, options, work):
        self.options = options
        self.work = work
        self.faults = 0
        self.runs = 0
        self.finished = 0
        self.slowest = 0.0

    def limit(self):
        return 2.0 if os.getloadavg()[0] > os.cpu_count() else 1.0

    def line_of(self, words, out):
        parts = self.work / "parts"
        program = str(self.options.programs / words[0])
        return [program] + [w.replace("{out}", str(out)).replace("{parts}", str(parts))
                            for w in words[1:]]

    def fault(self, words, text):
        self.faults += 1
        print(f"FAULT {' '.join(words)}: {text}", flush=True)

    def duration(self, words):
        """The time that the command takes without a signal, up to the longest moment, s."""
        out = pathlib.Path(tempfile.mkdtemp(dir=self.work))
        process = start(self.line_of(words, out))
        begin = time.monotonic()
        try:
            process.communicate(timeout=self.options.span)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
        shutil.rmtree(out)
        return min(self.options.span, time.monotonic() - begin)

    def interrupt(self, words, moment, numbers):
        """Returns the seconds to the end of the process; None if it had ended before the signals."""
        out = pathlib.Path(tempfile.mkdtemp(dir=self.work))
        process = start(self.line_of(words, out))
        wait_for_handlers(process)
        time.sleep(moment)
        had_ended = process.poll() is not None
        begin = time.monotonic()
        for number in numbers:
            process.send_signal(number)
        try:
            _, remarks = process.communicate(timeout=20)
        except subprocess.TimeoutExpired:
            process.kill()
            _, remarks = process.communicate()
        spent = time.monotonic() - begin
        case = f"{'+'.join(n.name for n in numbers)} after {moment:.3f} s"
        self.judge(words, case, had_ended, process.returncode, spent, remarks)
        for fault in faults_of_files(out):
            self.fault(words, f"{case}: {fault}")
        shutil.rmtree(out)

    def judge(self, words, case, had_ended, code, spent, remarks):
        self.runs += 1
        normal = NORMAL_CODES.get(words[1], {0})
        if had_ended or code in normal:
            self.finished += 1
        if not had_ended:
            self.slowest = max(self.slowest, spent)
        if code not in normal and (code != INTERRUPTED or had_ended):
            self.fault(words, f"{case}: exit code {code}: {remarks[-300:]}")
        if code == INTERRUPTED and ": interrupted" not in remarks:
            self.fault(words, f"{case}: does not say that it was interrupted")
        if spent > self.limit():
            self.fault(words, f"{case}: ends after {spent:.2f} s")

    def campaign(self, words):
        span = self.duration(words)
        before = (self.runs, self.finished, self.slowest)
        self.slowest = 0.0
        for _ in range(self.options.count):
            count = random.choice([1, 1, 1, 3])
            self.interrupt(words, random.uniform(0, span), random.sample(SIGNALS, count))
        print(f"{self.slowest:5.2f} s at most, {self.finished - before[1]} of "
              f"{self.runs - before[0]} had finished: {' '.join(words[:2])} "
              f"{' '.join(w for w in words[2:] if w[:2] == '--')}", flush=True)
        self.slowest = max(self.slowest, before[2])

    def blocked(self):
        """Nobody reads the pipe, so that opening it blocks."""
        pipe = self.work / "pipe"
        os.mkfifo(pipe)
        for numbers in SIGNALS:
            self.interrupt(["hello", "--steps", "5", "--json", str(pipe)], 0.2, [numbers])

    def ignored(self):
        """As under nohup: SIGHUP is ignored, SIGTERM is not."""
        def ignore():
            default_signals()
            signal.signal(signal.SIGHUP, signal.SIG_IGN)
        words = ["hello", "--steps", "1000000000000"]
        process = start(self.line_of(words, self.work), ignore)
        wait_for_handlers(process)
        process.send_signal(signal.SIGHUP)
        time.sleep(1.2)
        if process.poll() is not None:
            self.fault(words, "ends of a SIGHUP that its parent ignores")
        process.terminate()
        process.communicate()
        if process.returncode != INTERRUPTED:
            self.fault(words, f"exit code {process.returncode} after SIGHUP and SIGTERM")


def commands_of(oiler):
    text = subprocess.run([oiler, "--help"], capture_output=True, text=True, check=True).stdout
    return {row.split()[0] for row in text.split("Subcommands:")[1].splitlines() if row.strip()}


def start_server():
    """Starts Xvfb and sets DISPLAY; returns None without Xvfb."""
    if not shutil.which("Xvfb"):
        return None
    reading, writing = os.pipe()
    server = subprocess.Popen(["Xvfb", "-displayfd", str(writing)], pass_fds=[writing],
                              stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    os.close(writing)
    os.environ["DISPLAY"] = ":" + os.fdopen(reading).readline().strip()
    return server


def all_lines(options, has_display):
    chosen = SHORT if options.short else COMMANDS
    lines = [["oiler", name, *words] for name in chosen for words in COMMANDS[name]]
    demos = sorted(path.stem for path in (faults.root / "demos").glob("*.cpp"))
    modes = [RECORDED, FRAMES] + ([WINDOW] if has_display else [])
    if options.short:
        return lines + [["hello", *mode] for mode in modes]
    return lines + [[demo, *mode] for demo in demos for mode in modes + [STEPS]]


def prepare_parts(options, work):
    for part in ["1/2", "2/2"]:
        subprocess.run([options.programs / "oiler", "tradeoff", scene("jump"), "--quiet", "--methods",
                        "velocity_verlet", "--max-rate", "240", "--shard", part, "--out",
                        work / "parts"], check=True, stdout=subprocess.DEVNULL)
    for rate, capture, trace in [("60", "golden", "a.csv"), ("120", "actual", "b.csv")]:
        for words in [["--headless", "--frames", "30", "--out", work / "parts" / capture],
                      ["--steps", "100000", "--trace", work / "parts" / trace]]:
            subprocess.run([options.programs / "hello", "--quiet", "--rate", rate, *words], check=True)


def main():
    options = faults.arguments(__doc__.splitlines()[0], count=10, short_count=5)
    options.span = 0.4 if options.short else 3.0  # s, the latest moment
    if not shutil.which("pngcheck"):
        print("signals: install the Debian package pngcheck")
        return 77
    with tempfile.TemporaryDirectory(prefix="oiler-signals-") as folder:
        work = pathlib.Path(folder)
        campaign = Campaign(options, work)
        if commands_of(options.programs / "oiler") != set(COMMANDS):
            campaign.fault(["oiler", "--help"], f"its commands are not {', '.join(COMMANDS)}")
        if not options.short:
            prepare_parts(options, work)
        server = start_server()
        try:
            for words in all_lines(options, server is not None):
                campaign.campaign(words)
            campaign.blocked()
            campaign.ignored()
        finally:
            if server:
                server.kill()
    print(f"{campaign.runs} runs, {campaign.finished} had finished, the slowest ended after "
          f"{campaign.slowest:.2f} s, {campaign.faults} faults")
    return 1 if campaign.faults else 0


if __name__ == "__main__":
    sys.exit(main())
