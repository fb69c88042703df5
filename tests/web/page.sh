#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# page.sh ROOT: builds the page with emscripten in ROOT, a Debian 13 that it makes if there is none,
# compares the state hashes of WebAssembly with those of build-bits, and tests the page in
# build-web/page in this machine's Chromium against the programs in build. Needs root and debootstrap.
set -euo pipefail
cd "$(dirname "$0")/../.."
root=$(realpath -m "$1")

# inside COMMANDS: runs them in ROOT, where this repository has the same path.
inside() {
    mkdir -p "$root$PWD"
    unshare --mount bash -euc '
        mount -t proc proc "$0/proc"
        mount --rbind /dev "$0/dev"
        mount --bind "$PWD" "$0$PWD"
        exec chroot "$0" sh -euc "cd \"$PWD\"; $1"' "$root" "$1"
}

if [ ! -e "$root/usr/bin/emcc" ]; then
    debootstrap --variant=minbase trixie "$root"
    sed -i 'p; s|^deb |deb-src |' "$root/etc/apt/sources.list"
    inside 'apt-get update
        apt-get install -y --no-install-recommends emscripten cmake ninja-build ccache dpkg-dev python3-glad libeigen3-dev \
            libstb-dev libcli11-dev nlohmann-json3-dev libfmt-dev libxxhash-dev libtomlplusplus-dev libjs-chart.js \
            fonts-dejavu-core'
fi
mkdir -p build-web/packages
tests/web/hashes.py build/bin >build-web/hashes.json
inside 'cd build-web/packages; apt-get source --download-only --tar-only imgui libdeflate'
inside 'cmake --preset web -DOILER_WEB_HASHES=$PWD/build-web/hashes.json; cmake --build --preset web'

build-bits/bin/bits_o0 >build-web/native.hashes
for kernels in none baseline; do
    inside "cmake --preset web -B build-web/bits -DOILER_ROOMS=world -DOILER_BUILD_DEMOS=OFF \
            -DOILER_BUILD_BITS=ON -DOILER_KERNELS=$kernels
        cmake --build build-web/bits --target bits_built
        node build-web/bits/bin/bits_built.js >build-web/wasm.hashes"
    diff build-web/native.hashes build-web/wasm.hashes
    echo "kernels $kernels: $(wc -l <build-web/wasm.hashes) hashes of WebAssembly agree"
done
tests/web/page.py build-web/page build/bin
