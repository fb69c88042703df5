#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# page.sh ROOT: builds the page with emscripten in ROOT, a Debian 13 that it makes if there is none,
# compares the state hashes of WebAssembly with those of build-bits, and tests the page in
# build-web/page in this machine's Chromium against the programs in build. Needs root and debootstrap.
set -euo pipefail
cd "$(dirname "$0")/../.."
root=$(realpath -m "$1")

. tests/support/chroot.sh

[ -e "$root/usr/bin/apt-get" ] || debootstrap --variant=minbase trixie "$root"
mkdir -p build-web
tests/web/hashes.py build/bin >build-web/hashes.json
inside '.ci/page . -DOILER_WEB_HASHES=$PWD/build-web/hashes.json'

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

rm -rf build-web/mygame
build/bin/oiler new build-web/mygame
rm build-web/mygame/local.cmake
inside '.ci/page build-web/mygame'
tests/web/page.py build-web/mygame/build-web/page build/bin --game
