#!/bin/sh
# SPDX-License-Identifier: MIT
# Chooses in the window of `oiler demos --window` with the keys and with the mouse: each time the game
# runs, and the window comes back. Escape leaves it with exit code 0.
# `oiler` alone opens it, too.
# Usage: menu_test.sh OILER. Exit 77: Xvfb or xdotool is not installed.
set -u
. "$(dirname "$0")/../support/until_true.sh"
command -v Xvfb >/dev/null && command -v xdotool >/dev/null || exit 77

folder=$(mktemp -d)
server=
menu=
trap 'kill $menu $server 2>/dev/null; rm -rf "$folder"' EXIT
fail() { echo "menu_test: $1"; cat "$folder/err"; exit 1; }

window_focused() { xdotool search --name '^Oiler$' windowfocus >/dev/null 2>&1; }
has_started() { grep -qx "$1" "$folder/started"; }

# Without the size of an earlier window.
export XDG_STATE_HOME="$folder/states"

# An installed Oiler with two games.
prefix=$folder/oiler
mkdir -p "$prefix/bin" "$prefix/libexec/oiler" "$prefix/share/oiler/demos"
cp "$1" "$prefix/bin/oiler"
for game in first second; do
    printf '#!/bin/sh\necho %s >>"%s/started"\nexit 5\n' $game "$folder" >"$prefix/libexec/oiler/$game"
    chmod +x "$prefix/libexec/oiler/$game"
    echo "$game: The $game game" >>"$prefix/share/oiler/demos/demos.txt"
done
touch "$folder/started"

Xvfb -noreset -displayfd 3 -screen 0 1280x720x24 3>"$folder/display" >/dev/null 2>&1 &
server=$!
until_true test -s "$folder/display" || fail "Xvfb does not start"
DISPLAY=:$(cat "$folder/display")
export DISPLAY

"$prefix/bin/oiler" demos --window >"$folder/out" 2>"$folder/err" &
menu=$!
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
kill -0 $menu || fail "a game that failed ends the menu"
xdotool key Escape
wait $menu
status=$?
[ $status -eq 0 ] || fail "Escape leaves with exit code $status"
[ "$(wc -l <"$folder/started")" = 2 ] || fail "started: $(cat "$folder/started")"

"$prefix/bin/oiler" >"$folder/out" 2>"$folder/err" &
menu=$!
until_true window_focused || fail "oiler alone opens no window"
sleep 1
xdotool key Escape
wait $menu
status=$?
[ $status -eq 0 ] || fail "Escape leaves oiler alone with exit code $status"
