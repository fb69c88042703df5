#!/usr/bin/env bash
# scene.sh [SECONDS]: runs the fuzzer of the scene reader on mutations of all valid and invalid
# scenes, for 60 s if not given. Failing inputs are written to build-fuzz/.
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-60}
cmake --preset fuzz
cmake --build --preset fuzz --target scene_fuzz
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
awk -F'`' '/^\| `\[/ { print "\"" $4 " = \""; print "\"\\x0a" $2 "\\x0a\"" }' assets/scenes/README.md | sort -u >"$work/dictionary"
mkdir "$work/found"
build-fuzz/bin/scene_fuzz -max_total_time="$seconds" -max_len=4096 -timeout=10 -rss_limit_mb=1024 \
    -print_final_stats=1 -verbosity=0 -dict="$work/dictionary" -artifact_prefix=build-fuzz/ \
    "$work/found" assets/scenes tests/scene/bad
