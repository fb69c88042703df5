#!/bin/sh
# SPDX-License-Identifier: MIT
# agree.sh PROGRAM...: checks that all programs that this machine can run print the same hashes with
# the kernels of each of its instruction sets.
set -eu
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

first=
count=0
for program in "$@"; do
    for set in baseline avx2 avx512; do
        if ! OILER_INSTRUCTIONS=$set "$program" > "$folder/$count"; then continue; fi
        first=${first:-$program with $set}
        if ! diff "$folder/0" "$folder/$count"; then
            echo "$program with $set prints other hashes than $first"
            exit 1
        fi
        count=$((count + 1))
    done
done
lines=$(wc -l < "$folder/0")
echo "$count runs agree on $lines hashes"
# At least two methods, two precisions and three numbers of axes, by at least two programs.
[ "$count" -ge 2 ] && [ "$lines" -ge 12 ]
