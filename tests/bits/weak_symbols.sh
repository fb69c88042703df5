#!/bin/sh
# SPDX-License-Identifier: MIT
# weak_symbols.sh OBJECT...: checks that no function is weak in two of the objects. A linker would
# keep one of them, compiled for instructions that callers of the other may lack. (DW.ref.… is
# data.)
set -eu
shared=$(for object in "$@"; do nm -C "$object" | awk '$2 ~ /[WVu]/ && $3 !~ /^DW.ref/' | cut -c18- | sort -u; done |
    sort | uniq -d)
if [ -n "$shared" ]; then
    echo "weak in more than one of $*:"
    echo "$shared"
    exit 1
fi
