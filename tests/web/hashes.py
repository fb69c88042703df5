#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""hashes.py FOLDER: prints the state hashes after 600 steps of all demos and scenes as JSON, by the
programs in FOLDER. A page that is configured with -DOILER_WEB_HASHES=FILE compares its own."""
import json
import pathlib
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parents[2]


def state_hash(*command):
    run = subprocess.run([*command, "--steps", "600", "--json", "-", "--quiet"], check=True,
                         capture_output=True)
    return json.loads(run.stdout)["state_hash"]


programs = pathlib.Path(sys.argv[1])
names = [line.split(":")[0] for line in (root / "demos/demos.txt").read_text().splitlines()]
hashes = {name: state_hash(programs / name) for name in names}
for scene in sorted((root / "assets/scenes").glob("*.toml")):
    hashes[scene.name] = state_hash(programs / "oiler", "play", scene)
json.dump(hashes, sys.stdout, indent=2)
print()
