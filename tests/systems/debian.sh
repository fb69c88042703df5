#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# debian.sh SUITE...: makes a root folder of each Debian, such as `trixie`. In it, with the commit of this
# repository, it runs both commands of README.md as they stand, takes the hash of all state hashes,
# compares the golden frames, builds and installs the package, builds a game with it, and repeats the
# tests without OSMesa. It prints a line for each Debian; its logs are in frames/debian. It exits with 1
# if a command fails or warns, or if hashes differ; if tests fail, after its line. It needs root,
# debootstrap and jq. If CCACHE_DIR is set, the compilers use it.
set -euo pipefail
# Mounts end with this process.
[ "${OILER_MOUNTS:-}" ] || OILER_MOUNTS=own exec unshare --mount --propagation private "$0" "$@"
source=$(cd "$(dirname "$0")/../.." && pwd)
logs=$source/frames/debian
mkdir -p "$logs"
roots=$(mktemp -d)
# Removes the root folders.
leave() {
    mount | awk -v roots="$roots/" 'index($3, roots) { print $3 }' | xargs -r umount -l
    rm -rf --one-file-system "${roots:?}"/*
}
trap 'leave; rmdir "$roots"' EXIT
fail() { echo "debian.sh: $suite: $*; see $log"; exit 1; }

make_root() {
    root=$roots/$suite
    log=$logs/$suite-debootstrap.log
    debootstrap --variant=minbase ${CCACHE_DIR:+--include=ccache} "$suite" "$root" >"$log" || fail "no root folder"
    # The lists of a mirror that is a snapshot are too old.
    echo 'Acquire::Check-Valid-Until "false";' >"$root/etc/apt/apt.conf.d/99snapshot"
    mkdir -p "$root"/dev/{shm,pts} "$root/ccache"
    mount -t proc proc "$root/proc"
    mount -t tmpfs tmpfs "$root/dev/shm"
    mount -t devpts -o newinstance,ptmxmode=666 devpts "$root/dev/pts"
    [ -z "${CCACHE_DIR:-}" ] || mount --bind "$CCACHE_DIR" "$root/ccache"
    git clone -q "$source" "$root/oiler"
}
# inside NAME COMMANDS: runs commands in the clone; it sets `log`, and `took` to the time, in s.
inside() {
    local began=$SECONDS variables=(PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root)
    variables+=(DEBIAN_FRONTEND=noninteractive CCACHE_{DIR=/ccache,BASEDIR=/oiler,NOHASHDIR=true})
    [ -z "${CCACHE_DIR:-}" ] || variables+=(CMAKE_{C,CXX}_COMPILER_LAUNCHER=ccache)
    log=$logs/$suite-$1.log
    chroot "$root" env -i "${variables[@]}" CCACHE_SLOPPINESS=pch_defines,time_macros \
        bash -euo pipefail -c "cd /oiler; $2" >"$log" 2>&1 || fail "$1: exit code $?"
    took=$((SECONDS - began))
}
# block N: the text of the N-th sh block of README.md
block() { awk -v n="$1" '/^```sh$/ { on = ++i == n; next } /^```$/ { on = 0 } on' "$source/README.md"; }
passed() { grep -c ' Passed ' "$log"; }
# pixels SURFACE: the number of pixels that differ from the golden frames, and by how much at most.
pixels() {
    inside "$1" "
        SURFACE=$1 OUT=/tmp/$1 tests/golden/check.sh || true
        for golden in tests/golden/*/; do
            build/bin/oiler compare \$golden /tmp/$1/\$(basename \$golden) --json - >>/tmp/$1.json || true
        done"
    jq -rs '[.[].frames[]] | "\(map(.differing) | add // 0) by \(map(.largest) | max // 0)"' "$root/tmp/$1.json"
}

line='%-9s %-7s %-7s | %7s %7s %6s %8s | %-12s | %-9s %-9s | %7s | %s\n'
printf "$line" Debian g++ Mesa build,s tests,s passed warnings hash osmesa,px egl,px package,s passed,egl
for suite in "$@"; do
    make_root
    inside build "$(block 1)"; build=$took
    inside tests "$(block 2) || true"; tests=$took passed=$(passed)
    failed=$(sed -n 's/.* \([0-9]*\) tests failed out of .*/\1/p' "$log")
    [ "$failed" ] || fail "tests: not run"
    # Not those of packages that find no init system.
    warnings=$(cat "$logs/$suite"-{build,tests}.log | grep -v ^invoke-rc.d |
        grep -ciE 'warning( \([a-z]+\))?:|cmake .*warning') || true
    inside hashes "cmake --preset bits && cmake --build --preset bits --target bits_built && build-bits/bin/bits_built >/tmp/hashes"
    hash=$(sha256sum <"$root/tmp/hashes" | cut -c1-12)
    egl=$(pixels egl) osmesa=- without=-
    compiler=$(chroot "$root" g++ -dumpfullversion)
    mesa=$(sed -n 's/.*"gl_version": ".*Mesa \([^ "]*\).*/\1/p' "$root/tmp/egl/hello/manifest.json")
    has_osmesa=$(echo "$root"/usr/lib/*/libOSMesa.so.8)
    [ ! -e "$has_osmesa" ] || osmesa=$(pixels osmesa)
    inside package ".ci/package && apt-get install -y --no-install-recommends ./build-package/*.deb &&
        oiler new /tmp/cannon && cd /tmp/cannon && cmake -B build && cmake --build build && ctest --test-dir build"
    package=$took
    if [ -e "$has_osmesa" ]; then
        inside without "apt-get remove -y libosmesa6 && oiler demos && ctest --preset tests"; without=$(passed)
    fi
    printf "$line" "$suite" "$compiler" "$mesa" "$build" "$tests" "$passed" "$warnings" "$hash" \
        "$osmesa" "$egl" "$package" "$without"
    [ "$failed" = 0 ] || log=$logs/$suite-tests.log fail "tests: $failed failed"
    [ "$warnings" = 0 ] || fail "$warnings warnings"
    [ "${first:=$hash}" = "$hash" ] || fail "other state hashes than in $1"
    leave
done
