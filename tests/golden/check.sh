#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Captures demos and scenes and compares them with the golden frames beside this script:
#   tests/golden/check.sh            exits with 1 if a frame changed
#   tests/golden/check.sh --update   writes the golden frames
# PROGRAMS is the folder of the programs, build/bin if not set; frames go to OUT, frames/golden. SURFACE
# is the provider of OpenGL, auto if not set.
set -u
here=$(cd "$(dirname "$0")" && pwd)
programs=${PROGRAMS:-$here/../../build/bin}
out=${OUT:-frames/golden}
update=${1:-}
failed=0

# capture NAME COMMAND...: three frames of the first second, as thumbnails.
capture() {
    local name=$1 mode=(--out "$out/$1" --junit "$out/$1.xml")
    shift
    [ "$update" = --update ] && mode=(--update-golden)
    "$@" --headless --quiet --size 320x180 --fps 2 --frames 3 --surface "${SURFACE:-auto}" --golden "$here/$name" "${mode[@]}" ||
        failed=1
}

for demo in hello jump spring_damper projectile bounce galton integrator_race jump_rates; do
    capture "$demo" "$programs/$demo"
done
for demo in cannon cloth platformer stability_map; do
    capture "$demo" "$programs/$demo" --script "$here/../../demos/scripts/$demo.txt"
done
for scene in article_spring article_spring_undamped chain cloth jump orbit salvo stiff_and_soft; do
    capture "scene_$scene" "$programs/oiler" play "$here/../../assets/scenes/$scene.toml"
done
exit $failed
