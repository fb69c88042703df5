#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints a part of a job in a file of GitHub Actions or GitLab CI, one item per line.

    job.py FILE JOB commands|artifacts|image|variables|cached
"""
import sys

import yaml


def read_parts(file, name):
    with open(file, encoding="utf-8") as text:
        content = yaml.safe_load(text)
    job = content.get("jobs", content)[name]
    parts = read_github(job) if "steps" in job else read_gitlab(job)
    variables = content.get("env") or content["variables"]
    return parts | {"variables": [f"{name}={value}" for name, value in variables.items()]}


def read_github(job):
    parts = {
        "commands": [step["run"] for step in job["steps"] if "run" in step],
        "image": [job["container"]],
    }
    for step in job["steps"]:
        action = step.get("uses", "")
        if "actions/cache" in action:
            parts["cached"] = [step["with"]["path"]]
        if "actions/upload" in action:
            parts["artifacts"] = step["with"]["path"].split()
        if "upload-artifact" in action and step["if"] != "always()":
            sys.exit("a failed job uploads nothing: expected if: always()")
    return parts


def read_gitlab(job):
    artifacts = job["artifacts"]
    reports = artifacts.get("reports", {})
    if reports and artifacts["when"] != "always":
        sys.exit("a failed job uploads nothing: expected when: always")
    return {
        "commands": job["script"],
        "artifacts": artifacts["paths"] + list(reports.values()),
        "image": [job["image"]],
        "cached": job.get("cache", {}).get("paths", []),
    }


items = read_parts(sys.argv[1], sys.argv[2])[sys.argv[3]]
if any("\n" in item for item in items):
    sys.exit(f"{sys.argv[1]}: expected one line per command")
print("\n".join(items))
