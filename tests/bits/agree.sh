#!/bin/sh
# SPDX-License-Identifier: MIT
# agree.sh PROGRAM...: checks that all programs that this machine can run print the same hashes with
# the kernels of each of its instruction sets.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

for program in "$@"; do
    for set in baseline avx2 avx512; do
        echo "$set $program"
    done
done > "$folder/runs"
# A set that this machine does not have leaves no file.
folder=$folder xargs -P "$(nproc)" -L 1 sh -c '
    file=$folder/$(basename "$1")-$0.hashes
    OILER_INSTRUCTIONS=$0 "$1" > "$file" || rm "$file"' < "$folder/runs"

first=
count=0
for file in "$folder"/*.hashes; do
    first=${first:-$file}
    if ! diff "$first" "$file"; then
        echo "$(basename "$file") are other hashes than $(basename "$first")"
        exit 1
    fi
    count=$((count + 1))
done
lines=$(wc -l < "$first")
echo "$count runs agree on $lines hashes"
# At least two methods, two precisions and three numbers of axes, by at least two programs.
[ "$count" -ge 2 ] && [ "$lines" -ge 12 ]
