#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# arm64.sh ROOT: compiles all for ARM64 and packs it, in ROOT, a Debian 12 that it makes if there is
# none. Then runs the tests of the simulation in an emulator, and compares state hashes and replays
# with those of this machine's programs in build and build-bits. Needs root and debootstrap.
set -euo pipefail
cd "$(dirname "$0")/../.."
root=$(realpath -m "$1")

. tests/support/chroot.sh

if [ ! -e "$root/usr/bin/qemu-aarch64-static" ]; then
    debootstrap --variant=minbase bookworm "$root"
    inside 'dpkg --add-architecture arm64
        apt-get update
        apt-get install -y --no-install-recommends g++-aarch64-linux-gnu qemu-user-static cmake ninja-build pkg-config \
            ccache dpkg-dev file python3-glad libeigen3-dev libcli11-dev nlohmann-json3-dev libjs-chart.js fonts-dejavu-core
        apt-get install -y --no-install-recommends libsdl2-dev:arm64 libosmesa6-dev:arm64 libegl-dev:arm64 libegl1:arm64 \
            libgl1-mesa-dri:arm64 libstb-dev:arm64 libimgui-dev:arm64 libfmt-dev:arm64 libdeflate-dev:arm64 \
            libxxhash-dev:arm64 libtomlplusplus-dev:arm64 libgtest-dev:arm64 libpng-dev:arm64'
fi
inside 'cmake --preset arm64; cmake --build --preset arm64; cpack --preset arm64'

# Starts each program in the emulator.
programs=$(mktemp -d)
trap 'rm -rf "$programs"' EXIT
for program in build-arm64/bin/*; do
    printf '#!/bin/sh\nexec "%s" -L "%s" "%s" "$@"\n' "$root/usr/bin/qemu-aarch64-static" "$root" "$PWD/$program" \
        > "$programs/${program##*/}"
done
chmod +x "$programs"/*

printf '%s\n' "$programs"/{core,math,physics,sim,stability,world,obstacle}_tests |
    xargs -P "$(nproc)" -n 1 sh -c '"$0" --gtest_brief=1'
tests/bits/agree.sh build-bits/bin/bits_o0 "$programs/bits_built"

# states FOLDER: each scene and demo with its state after 200 steps, by the programs in FOLDER.
states() {
    {
        for scene in assets/scenes/*.toml; do "$1/oiler" play "$scene" --steps 200 --json - --quiet; done
        sed 's/:.*//' demos/demos.txt | while read -r demo; do "$1/$demo" --steps 200 --json - --quiet; done
    } | grep -E '"(scene|state_hash)"'
}
states build/bin > "$programs/here"
states "$programs" | diff "$programs/here" -
echo "$(grep -c state_hash "$programs/here") states agree"
for game in hello cannon platformer; do
    tests/faults/random_play.py "build/bin/$game" --seeds 5 --replay-with "$programs/$game"
done
