#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints a part of the only job in a file of GitHub Actions or GitLab CI, one item per line.

    job.py FILE commands|artifacts|image
"""
import sys

import yaml


def read_job(file):
    with open(file, encoding="utf-8") as text:
        content = yaml.safe_load(text)
    (job,) = content.get("jobs", content).values()
    return job


def read_github(job):
    (upload,) = [step for step in job["steps"] if "upload-artifact" in step.get("uses", "")]
    if upload["if"] != "always()":
        sys.exit("a failed job uploads nothing: expected if: always()")
    return {
        "commands": [step["run"] for step in job["steps"] if "run" in step],
        "artifacts": upload["with"]["path"].split(),
        "image": [job["container"]],
    }


def read_gitlab(job):
    artifacts = job["artifacts"]
    if artifacts["when"] != "always":
        sys.exit("a failed job uploads nothing: expected when: always")
    return {
        "commands": job["script"],
        "artifacts": artifacts["paths"] + [artifacts["reports"]["junit"]],
        "image": [job["image"]],
    }


found = read_job(sys.argv[1])
parts = read_github(found) if "steps" in found else read_gitlab(found)
items = parts[sys.argv[2]]
if any("\n" in item for item in items):
    sys.exit(f"{sys.argv[1]}: expected one line per command")
print("\n".join(items))
