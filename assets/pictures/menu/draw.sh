#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Draws the pictures of `oiler demos --window` beside this script: a frame of each game and scene.
# PROGRAMS is the folder of the programs, build/bin if not set.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../../..
programs=${PROGRAMS:-$root/build/bin}
frames=$(mktemp -d)
trap 'rm -rf "$frames"' EXIT

# draw NAME FRAME COMMAND...: one frame of 60 a second.
draw() {
    local name=$1 frame=$2
    shift 2
    "$@" --headless --quiet --size 240x135 --frame "$frame" --out "$frames/$name"
    mv "$frames/$name"/still_*.png "$here/$name.png"
}
demo() { draw "$1" "$2" "$programs/$1" "${@:3}"; }
scripted() { demo "$1" "$2" --script "$root/demos/scripts/$1.txt"; }
scene() { draw "scene_$1" "$2" "$programs/oiler" play "$root/assets/scenes/$1.toml"; }

demo jump 40
scripted cannon 365
scripted platformer 803
demo cloth 19 --rate 80
demo integrator_race 160
demo stability_map 20
demo jump_rates 70
demo galton 1200
demo bounce 200
demo projectile 130
demo spring_damper 200
demo hello 17
scene article_spring 280
scene article_spring_undamped 290
scene bouncing_ball 170
scene chain 480
scene cloth 200
scene drive 600
scene free_cloth 60
scene hundred_thousand 110
scene jump 40
scene million 110
scene orbit 420
scene pegs 240
scene salvo 150
scene stiff_and_soft 14
scene tiles 150
scene wind 90
