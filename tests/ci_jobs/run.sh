#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# run.sh OILER [ROOT]: runs the commands of both CI jobs of a project of `OILER new` as they stand:
# with golden frames, after a change of the game, and without the change. The first job builds the
# package from the commit of this repository, and the second one takes it from the cache. The commands
# install packages: on this machine, or in ROOT, the root folder of another Debian 12:
#   debootstrap --variant=minbase bookworm ROOT
# Exit 77: not root, or no python3-yaml.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
oiler=$(realpath "$1")
root=${2:-}
skip() { echo "skipped: $*"; exit 77; }
fail() { echo "ci_jobs: $*"; exit 1; }
[ "$(id -u)" = 0 ] || skip "the commands install packages and need root"
python3 -c "import yaml" 2>/dev/null || skip "python3-yaml is not installed"

folder=$(mktemp -d -p "$root/tmp")
trap 'rm -rf "$folder"' EXIT
# inside COMMAND: runs a command in the game's folder, as a CI job does.
inside() {
    local start=(env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root CI=true "${variables[@]}")
    echo "+ $1"
    chroot "${root:-/}" "${start[@]}" sh -ec "cd '${game#"$root"}'; $1" >"$folder/log" 2>&1
}
must() { inside "$1" || fail "exit code $?, $(tail -n 20 "$folder/log")"; }
# The command fails because a frame changed.
must_find_changes() {
    if inside "$1"; then fail "a changed game passes"; fi
    grep -q "simulation changed at tick" "$folder/log" || fail "$(tail -n 20 "$folder/log")"
}

# A clone of the repository of a new project.
make_game() {
    "$oiler" new "$game" >"$folder/log"
    rm "$game/local.cmake"
}
# change_game FROM TO: builds the game with another stiffness.
change_game() {
    sed -i "s/stiffness = $1,/stiffness = $2,/" "$game/game.cpp"
    grep -q "stiffness = $2," "$game/game.cpp" || fail "game.cpp has no stiffness = $1"
    must "cmake --build build"
}
check_artifacts() {
    local artifact
    python3 "$here/job.py" "$1" frames artifacts >"$folder/artifacts"
    while read -r artifact; do
        [ -s "$game/$artifact" ] || fail "$1: $artifact is not written"
    done <"$folder/artifacts"
    grep -q "<failure" "$game/frames/cannon.xml" || fail "cannon.xml has no failure"
    [ -s "$game/frames/cannon-differences/index.html" ] || fail "there is no page of differences"
}

read_variables() { mapfile -t variables < <(python3 "$here/job.py" "$job" frames variables); }
# The job fails and says what to set; then it is set to a repository in which the commit has the tag.
set_repository() {
    local command
    read_variables
    for command in "${commands[@]}"; do inside "$command" || break; done
    grep -q "OILER_REPOSITORY: is empty, set it in $1 to" "$folder/log" || fail "$(tail -n 20 "$folder/log")"
    sed -i "s|OILER_REPOSITORY: \"\"|OILER_REPOSITORY: file://${folder#"$root"}/oiler.git|" "$job"
    git -C "$folder/oiler.git" tag -f "$(sed -n 's/^ *OILER_TAG: //p' "$job")" >"$folder/log"
    read_variables
}

# run_job FILE: FILE is the job, relative to the folder of the game.
run_job() {
    local job commands cached compare command
    game=$(mktemp -d -p "$folder")/cannon
    make_game
    job=$game/$1
    [ "$(python3 "$here/job.py" "$job" frames image)" = debian:12 ] || fail "$1: the image is not Debian 12"
    mapfile -t commands < <(python3 "$here/job.py" "$job" frames commands)
    cached=$(python3 "$here/job.py" "$job" frames cached)
    compare=${commands[-1]}
    set_repository "$1"
    [ ! -e "$folder/$cached" ] || mv "$folder/$cached" "$game"
    for command in "${commands[@]::${#commands[@]}-1}"; do must "$command"; done
    # Golden frames come from a developer: a CI job may not write them.
    must "unset CI; $compare"
    must "$compare"
    change_game 12 13
    must_find_changes "$compare"
    check_artifacts "$job"
    change_game 13 12
    must "$compare"
    mv "$game/$cached" "$folder"
}

git clone -q --bare "$here/../.." "$folder/oiler.git"
for file in .github/workflows/frames.yml .gitlab-ci.yml; do
    echo "$file"
    run_job "$file"
done
echo "ci_jobs: passed"
