#!/bin/sh
# SPDX-License-Identifier: MIT
# Chooses in the window of `oiler demos --window` with the keys and with the mouse: each time the game
# runs, and the window comes back. Escape leaves it with exit code 0.
# `oiler` alone opens it, too.
# Usage: menu_test.sh OILER.
set -u
title='^Oiler$'
. "$(dirname "$0")/../support/on_display.sh"
fail() { echo "menu_test: $1"; cat "$folder/err"; exit 1; }
has_started() { grep -qx "$1" "$folder/started"; }

# Without the size of an earlier window.
export XDG_STATE_HOME="$folder/states"

# An installed Oiler with two games.
prefix=$folder/oiler
mkdir -p "$prefix/bin" "$prefix/libexec/oiler" "$prefix/share/oiler/demos"
cp "$1" "$prefix/bin/oiler"
for one in first second; do
    printf '#!/bin/sh\necho %s >>"%s/started"\nexit 5\n' $one "$folder" >"$prefix/libexec/oiler/$one"
    chmod +x "$prefix/libexec/oiler/$one"
    echo "$one: The $one game" >>"$prefix/share/oiler/demos/demos.txt"
done
touch "$folder/started"

open_display 1280x720

"$prefix/bin/oiler" demos --window >"$folder/out" 2>"$folder/err" &
game=$!
until_true window_focused || fail "no window"
sleep 1
xdotool key Right
sleep 0.2
xdotool key Return
until_true has_started second || fail "Right and Enter do not start the second game"
sleep 1
until_true window_focused || fail "the window does not come back"
sleep 1
xdotool mousemove 200 110 click 1  # on the first picture
until_true has_started first || fail "a click does not start the first game"
sleep 1
until_true window_focused || fail "the window does not come back after a click"
sleep 1
kill -0 $game || fail "a game that failed ends the menu"
xdotool key Escape
wait $game
status=$?
[ $status -eq 0 ] || fail "Escape leaves with exit code $status"
[ "$(wc -l <"$folder/started")" = 2 ] || fail "started: $(cat "$folder/started")"

"$prefix/bin/oiler" >"$folder/out" 2>"$folder/err" &
game=$!
until_true window_focused || fail "oiler alone opens no window"
sleep 1
xdotool key Escape
wait $game
status=$?
[ $status -eq 0 ] || fail "Escape leaves oiler alone with exit code $status"
