#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# run.sh DEB [ROOT]: runs the commands of both files of assets/ci as they stand: on a game with golden
# frames, on a changed game, and on the first game again. DEB is the package of Oiler. The commands
# install packages: on this machine, or in ROOT, the root folder of another Debian 12:
#   debootstrap --variant=minbase bookworm ROOT
# Exit 77: not root, or no python3-yaml.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
deb=$(realpath "$1")
root=${2:-}
skip() { echo "skipped: $*"; exit 77; }
fail() { echo "ci_jobs: $*"; exit 1; }
[ "$(id -u)" = 0 ] || skip "the commands install packages and need root"
python3 -c "import yaml" 2>/dev/null || skip "python3-yaml is not installed"

folder=$(mktemp -d -p "$root/tmp")
trap 'rm -rf "$folder"' EXIT
# inside COMMAND: runs a command in the game's folder, as a CI job does.
inside() {
    local start=(env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root CI=true)
    start+=("OILER_DEB=file://${folder#"$root"}/package.deb")
    echo "+ $1"
    chroot "${root:-/}" "${start[@]}" sh -ec "cd '${game#"$root"}'; $1" >"$folder/log" 2>&1
}
must() { inside "$1" || fail "exit code $?, $(tail -n 20 "$folder/log")"; }
# The command exits with 1: a frame changed.
must_find_changes() {
    local status=0
    inside "$1" || status=$?
    [ $status = 1 ] || fail "a changed game gives exit code $status, $(tail -n 20 "$folder/log")"
}

make_game() {
    mkdir "$game"
    cp "$source/demos/hello.cpp" "$game/game.cpp"
    awk '/^```cmake$/ { on = 1; next } /^```$/ { on = 0 } on' "$source/README.md" >"$game/CMakeLists.txt"
}
# change_game FROM TO: builds the game with another stiffness.
change_game() {
    sed -i "s/stiffness = $1,/stiffness = $2,/" "$game/game.cpp"
    grep -q "stiffness = $2," "$game/game.cpp" || fail "hello.cpp has no stiffness = $1"
    must "cmake --build build"
}
check_artifacts() {
    local artifact
    python3 "$here/job.py" "$1" artifacts >"$folder/artifacts"
    while read -r artifact; do
        [ -s "$game/$artifact" ] || fail "$1: $artifact is not written"
    done <"$folder/artifacts"
    grep -q "<failure" "$game/frames/game.xml" || fail "game.xml has no failure"
    [ -s "$game/frames/game-differences/index.html" ] || fail "there is no page of differences"
}

run_job() {
    local commands compare command
    game=$folder/$(basename "$1" .yml)
    make_game
    [ "$(python3 "$here/job.py" "$1" image)" = debian:12 ] || fail "$1: the image is not Debian 12"
    mapfile -t commands < <(python3 "$here/job.py" "$1" commands)
    compare=${commands[-1]}
    for command in "${commands[@]::${#commands[@]}-1}"; do must "$command"; done
    # Golden frames come from a developer: a CI job may not replace them.
    must "unset CI; build/game --headless --frames 90 --size 640x360 --golden tests/golden/game --update-golden"
    must "$compare"
    change_game 40 41
    must_find_changes "$compare"
    check_artifacts "$1"
    change_game 41 40
    must "$compare"
}

cp "$deb" "$folder/package.deb"
for file in "$source"/assets/ci/*.yml; do
    basename "$file"
    run_job "$file"
done
echo "ci_jobs: passed"
