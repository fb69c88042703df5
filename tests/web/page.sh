#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# page.sh ROOT: builds the page with emscripten in ROOT, a Debian 13 that it makes if there is none,
# compares the state hashes of WebAssembly with those of build-bits, and tests the page in
# build-web/page and that of a new game in this machine's Chromium against the programs in build. Needs
# root, debootstrap and python3-yaml.
set -euo pipefail
cd "$(dirname "$0")/../.."
root=$(realpath -m "$1")

. tests/support/chroot.sh

[ -e "$root/usr/bin/apt-get" ] || debootstrap --variant=minbase trixie "$root"
mkdir -p build-web
tests/web/hashes.py build/bin >build-web/hashes.json
inside '.ci/page . -DCMAKE_COMPILE_WARNING_AS_ERROR=ON -DOILER_WEB_HASHES=$PWD/build-web/hashes.json'

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

# A new game, by its CI jobs.
rm -rf build-web/oiler.git
git clone -q --bare . build-web/oiler.git
for job in '.github/workflows/frames.yml page' '.gitlab-ci.yml pages'; do
    read -r file name <<<"$job"
    rm -rf build-web/mygame
    build/bin/oiler new build-web/mygame
    rm -f build-web/mygame/local.cmake
    part() { tests/ci_jobs/job.py "build-web/mygame/$file" "$name" "$1"; }
    [ "$(part image)" = debian:13 ]
    sed -i "s|OILER_REPOSITORY: \"\"|OILER_REPOSITORY: file://$PWD/build-web/oiler.git|" "build-web/mygame/$file"
    git -C build-web/oiler.git tag -f "$(part variables | sed -n 's/^OILER_TAG=//p')"
    inside "cd build-web/mygame; export $(part variables | xargs); $(part commands)"
    tests/web/page.py "build-web/mygame/$(part artifacts)" build/bin --game
done
