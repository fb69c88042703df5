#!/bin/bash
# SPDX-License-Identifier: MIT
# Runs the full matrix of compilers, optimisations and instruction sets with plain compiler calls.
# Prints a line for each with the hash of the output of tests/bits/state_hash.cpp, and exits with 1
# if two differ. As a control, a build with fused multiply-adds must differ. Takes half an
# hour on two cores.
#   tests/bits/matrix.sh [FOLDER]    # folder for the programs; a temporary one if absent
set -euo pipefail
shopt -s globstar
root=$(cd "$(dirname "$0")/../.." && pwd)
folder=${1:-$(mktemp -d)}
mkdir -p "$folder"
alone=step_linked_rows.cpp
sources=("$root"/tests/bits/state_hash.cpp "$root"/engine/oiler/sim/steps/$alone)
for room in core physics sim stability world; do
    find "$root/engine/oiler/$room" -name '*.cpp' ! -name kernels_of_set.cpp ! -name $alone \
        -printf '#include "%p"\n' | sort > "$folder/$room.cpp"
    sources+=("$folder/$room.cpp")
done

# build NAME COMPILER OPTION...
build() {
    local name=$1 compiler=$2 precision
    shift 2
    local options=(-std=c++20 -DNDEBUG -DOILER_INSTRUCTIONS=baseline -DOILER_KERNELS_BASELINE
                   -DOILER_VERSION='"bits"' -Wno-psabi "$@" -I"$root/engine" -I/usr/include/eigen3)
    for precision in float double; do
        "$compiler" "${options[@]}" -DOILER_PRECISION=$precision \
            -c "$root"/engine/oiler/sim/**/kernels_of_set.cpp -o "$folder/$name-$precision.o"
    done
    "$compiler" "${options[@]}" "${sources[@]}" "$folder/$name"-{float,double}.o \
        -o "$folder/$name" -lfmt -lxxhash -pthread
}

has() { grep -qw "$1" /proc/cpuinfo; }

runs_here() {
    case $1 in
    x86-64-v3) has avx2 && has fma ;;
    x86-64-v4) has avx512vl && has avx512dq ;;
    *) true ;;
    esac
}

fingerprint() { "$folder/$1" | sha256sum | cut -c1-16; }

reference=
failed=0
jobs=()
variants=()
for compiler in g++ clang++; do
    command -v "$compiler" > /dev/null || { echo "skipped: no $compiler"; continue; }
    for level in -O0 -O3; do
        for march in x86-64 x86-64-v3 x86-64-v4; do
            variants+=("$compiler $level $march")
            build "$compiler$level-$march" "$compiler" "$level" "-march=$march" -ffp-contract=off &
            jobs+=($!)
            if [ ${#jobs[@]} -ge 2 ]; then wait "${jobs[0]}"; jobs=("${jobs[@]:1}"); fi
        done
    done
done
for job in "${jobs[@]}"; do wait "$job"; done

for variant in "${variants[@]}"; do
    read -r compiler level march <<< "$variant"
    if ! runs_here "$march"; then echo "skipped: $variant (not this machine)"; continue; fi
    print=$(fingerprint "$compiler$level-$march")
    reference=${reference:-$print}
    verdict=same
    if [ "$print" != "$reference" ]; then verdict=DIFFERS; failed=1; fi
    printf '%-8s %-4s %-10s %s %s\n' "$compiler" "$level" "$march" "$print" "$verdict"
done

if runs_here x86-64-v3; then
    build fused g++ -O3 -march=x86-64-v3 -ffp-contract=fast
    print=$(fingerprint fused)
    verdict='differs, as it must'
    if [ "$print" = "$reference" ]; then verdict='DOES NOT DIFFER'; failed=1; fi
    printf '%-8s %-4s %-10s %s %s\n' g++ fused x86-64-v3 "$print" "$verdict"
fi
exit $failed
