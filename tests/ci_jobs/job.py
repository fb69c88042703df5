#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints a part of the only job in a file of GitHub Actions or GitLab CI, one item per line.

    job.py FILE commands|artifacts|image|variables|cached
"""
import sys

import yaml


def read_parts(file):
    with open(file, encoding="utf-8") as text:
        content = yaml.safe_load(text)
    (job,) = content.get("jobs", content).values()
    parts = read_github(job) if "steps" in job else read_gitlab(job)
    variables = content.get("env") or job["variables"]
    return parts | {"variables": [f"{name}={value}" for name, value in variables.items()]}


def read_github(job):
    (cache,) = [step for step in job["steps"] if "actions/cache" in step.get("uses", "")]
    (upload,) = [step for step in job["steps"] if "upload-artifact" in step.get("uses", "")]
    if upload["if"] != "always()":
        sys.exit("a failed job uploads nothing: expected if: always()")
    return {
        "commands": [step["run"] for step in job["steps"] if "run" in step],
        "artifacts": upload["with"]["path"].split(),
        "image": [job["container"]],
        "cached": [cache["with"]["path"]],
    }


def read_gitlab(job):
    artifacts = job["artifacts"]
    if artifacts["when"] != "always":
        sys.exit("a failed job uploads nothing: expected when: always")
    return {
        "commands": job["script"],
        "artifacts": artifacts["paths"] + [artifacts["reports"]["junit"]],
        "image": [job["image"]],
        "cached": job["cache"]["paths"],
    }


items = read_parts(sys.argv[1])[sys.argv[2]]
if any("\n" in item for item in items):
    sys.exit(f"{sys.argv[1]}: expected one line per command")
print("\n".join(items))
