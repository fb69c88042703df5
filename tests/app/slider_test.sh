#!/bin/sh
# SPDX-License-Identifier: MIT
# Drags the slider of the demo jump in a real window: the game is made anew at the rate that it asks
# for, and its knob stands there.
# Usage: slider_test.sh PROGRAM TITLE.
set -u
program=$1
title=$2
. "$(dirname "$0")/../support/on_display.sh"

# Prints "x y" of the knob: the middle of the longest dark run of 10 to 24 pixels that is as high.
knob() {
    python3 - "$folder/Xvfb_screen0" <<'END'
import struct, sys
data = open(sys.argv[1], "rb").read()
header = struct.unpack(">25I", data[:100])
line, pixels = header[12], header[0] + 12 * header[19]

def is_dark(x, y):
    at = pixels + y * line + 4 * x
    return x < 640 and max(data[at:at + 3]) < 80

best = (0, 0, 0)
for y in range(280, 350):
    run = 0
    for x in range(641):
        if is_dark(x, y):
            run += 1
            continue
        middle = x - run // 2
        if 10 <= run <= 24 and is_dark(middle, y - 4) and is_dark(middle, y + 4):
            best = max(best, (run, middle, y))
        run = 0
print(best[1], best[2])
END
}
knob_is_right_of() { [ "$(knob | cut -d' ' -f1)" -gt "$1" ]; }
knob_is_left_of() { ! knob_is_right_of "$1"; }

open_display 640x360
# The slider has twelve places, 50 pixels apart; the last is 240 Hz.
start_game --size 640x360
until_true knob_is_right_of 570 || fail "the knob is not at 240 Hz: $(knob)"
xdotool key Left
until_true knob_is_left_of 560 || fail "Left does not lower the rate: $(knob)"
knob_is_right_of 510 || fail "Left lowers the rate by more than one place: $(knob)"
read -r x y <<END
$(knob)
END
xdotool mousemove "$x" "$y" mousedown 1 mousemove 330 "$y"
until_true knob_is_left_of 350 || fail "the mouse does not drag the knob: $(knob)"
knob_is_right_of 300 || fail "the knob is not below the mouse: $(knob)"
xdotool mousemove 20 "$y"
until_true knob_is_left_of 60 || fail "a drag goes on at the next rate: $(knob)"
xdotool mouseup 1 key Escape
wait $game
status=$?
[ $status -eq 0 ] || fail "Escape leaves with exit code $status"
