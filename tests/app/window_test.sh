#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs a demo in a real window: pause freezes the picture, a single step changes it, F4 takes it
# back, F1 opens the inspector, F2 shows a help, Escape closes it and then quits with exit code 0,
# and --frames N quits after N frames. A closed window leaves with 0, a killed server with 3 and
# complete files. Usage: window_test.sh PROGRAM TITLE.
set -u
program=$1
title=$2
. "$(dirname "$0")/../support/on_display.sh"

screenshot() { cp "$folder/Xvfb_screen0" "$folder/$1"; }
stands_still() {
    screenshot paused
    for _ in 1 2 3 4; do
        sleep 0.2
        screenshot later
        cmp -s "$folder/paused" "$folder/later" || return 1
    done
}
moves() { ! stands_still; }
has_changed() { screenshot stepped && ! cmp -s "$folder/paused" "$folder/stepped"; }
shows_before() { screenshot now && cmp -s "$folder/before" "$folder/now"; }
open_display 800x600
# The line's figures depend on how far the measuring has come.
start_game --size 640x360 --no-line
until_true grep -q "drawing with sdl2" "$folder/err" || fail "auto does not select the window"
until_true moves || fail "nothing moves before the pause"
xdotool key F3
until_true stands_still || fail "F3 does not pause"
xdotool key F5
until_true has_changed || fail "a single step shows nothing"
until_true stands_still || fail "the picture moves after a single step"
xdotool key F4
until_true has_changed || fail "F4 does not step back"
until_true stands_still || fail "the picture moves after a step back"
cp "$folder/paused" "$folder/before"
xdotool key F5
until_true has_changed || fail "a step after a step back shows nothing"
xdotool key F4
until_true shows_before || fail "F4 does not take a step back"
xdotool key F2
until_true has_changed || fail "F2 shows no help"
xdotool key F2
until_true shows_before || fail "F2 does not close the help"
xdotool key F1
until_true has_changed || fail "F1 does not open the inspector"
xdotool key F1
until_true shows_before || fail "F1 does not close the inspector"
xdotool key F3
until_true moves || fail "F3 does not resume"
xdotool key F2
until_true stands_still || fail "the game plays on below the help"
xdotool key F2
until_true moves || fail "the game does not go on when the help is closed"
xdotool key F2
until_true stands_still || fail "the game plays on below the second help"
xdotool key Escape
until_true moves || fail "Escape does not close the help"
xdotool keydown F4
until_true stands_still || fail "holding F4 does not end at the start of the game"
xdotool keyup F4
until_true moves || fail "the game does not go on from where it came back to"
xdotool key Escape
wait $game
status=$?
[ $status -eq 0 ] || fail "Escape leaves with exit code $status"

# A window that the user has resized opens with that size next time, unless --size is given. The first
# one, 1280x720, is cut to the display.
export XDG_STATE_HOME="$folder/states"
is_of_size() { xdotool search --name "$title" getwindowgeometry 2>/dev/null | grep -q "Geometry: $1"; }
for size in 800x600 500x300; do
    "$program" --quiet 2>"$folder/err" &
    game=$!
    until_true is_of_size $size || fail "the window is not of $size: $(cat "$folder/err")"
    window_focused
    [ -e "$folder/states" ] || [ $size = 800x600 ] || fail "the size is not kept"
    xdotool search --name "$title" windowsize 500 300
    until_true is_of_size 500x300 || fail "the window cannot be resized"
    xdotool key Escape
    wait $game || fail "a resized window leaves with exit code $?"
done
"$program" --size 640x360 --quiet 2>"$folder/err" &
game=$!
until_true is_of_size 640x360 || fail "--size does not win over the size of last time"
until_true window_focused
xdotool key Escape
wait $game

# A size from a larger display is cut to this one, and kept for the larger one.
echo 3000x2000 | tee "$folder"/states/oiler/*.size >/dev/null
"$program" --quiet 2>"$folder/err" &
game=$!
until_true is_of_size 800x600 || fail "a kept size is larger than the display"
window_focused
xdotool key Escape
wait $game
[ "$(cat "$folder"/states/oiler/*.size)" = 3000x2000 ] || fail "a display that is smaller changes the kept size"

# steps_in_frames N: number of steps of a run of N frames, 0.1 s apart, at 1000 Hz. The first frame
# starts the clock and takes no step; a late frame takes at most 250.
steps_in_frames() {
    "$program" --size 640x360 --quiet --frames "$1" --fps 10 --rate 1000 --json "$folder/report" ||
        fail "--frames $1 leaves with exit code $?"
    sed -n 's/^ *"steps": \([0-9]*\),$/\1/p' "$folder/report"
}
steps=$(steps_in_frames 1)
[ "$steps" = 0 ] || fail "--frames 1 takes '$steps' steps"
steps=$(steps_in_frames 2)
[ "$steps" -gt 0 ] && [ "$steps" -le 250 ] || fail "--frames 2 takes '$steps' steps"

# The states of a window with everything that measures are those of a run without any.
"$program" --quiet --steps 60 --rate 60 --record "$folder/run.rec" || fail "no recording"
"$program" --replay "$folder/run.rec" --size 640x360 --inspector --profile "$folder/profile.json" 2>"$folder/err" ||
    fail "a replay with the inspector leaves with exit code $?: $(cat "$folder/err")"
grep -q "60 of 60 steps" "$folder/err" || fail "the replay compares other steps: $(cat "$folder/err")"
for stage in frame step picture "play along" inspector overlay draw present wait "shown step"; do
    grep -q "\"name\":\"$stage\"" "$folder/profile.json" || fail "the profile has no '$stage'"
done

# A signal ends the window as Escape does, with its own exit code.
"$program" --size 640x360 --quiet --json "$folder/stopped.json" &
game=$!
until_true window_focused || fail "no window for a signal"
kill -TERM $game
wait $game
status=$?
[ $status -eq 130 ] || fail "SIGTERM leaves with exit code $status"
[ -s "$folder/stopped.json" ] || fail "SIGTERM leaves no report"

# A divergence keeps the window, F9 restarts, and Escape leaves with 5 where it was the end.
"$program" --size 640x360 --rate 1 --method explicit_euler --precision float 2>"$folder/err" &
game=$!
until_true window_focused || fail "no window for a divergence"
xdotool key F8 F8 F8 F8
until_true moves || fail "nothing moves before the divergence"
until_true stands_still || fail "a divergence does not stop the picture"
kill -0 $game || fail "a divergence closes the window"
xdotool key F9
until_true moves || fail "F9 does not restart after a divergence"
until_true stands_still || fail "the second divergence does not stop the picture"
xdotool key Escape
wait $game
status=$?
[ $status -eq 5 ] || fail "a divergence leaves with exit code $status"
grep -q "diverged at step" "$folder/err" || fail "no word of the divergence"

# A display whose OpenGL fails is none: one line, not that of a library.
for broken in LIBGL_ALWAYS_INDIRECT=1 MESA_GL_VERSION_OVERRIDE=2.1; do
    env $broken "$program" --frames 2 --quiet 2>"$folder/err"
    status=$?
    [ $status -eq 3 ] || fail "with $broken the exit code is $status"
    [ "$(wc -l <"$folder/err")" = 1 ] && grep -q -- --headless "$folder/err" ||
        fail "with $broken: $(cat "$folder/err")"
done

# The window is closed and a key is pressed between two polls.
"$program" --size 640x360 --quiet &
game=$!
until_true window_focused || fail "no second window"
until_true moves || fail "the second window shows nothing"
kill -STOP $game
"$(dirname "$0")/close_window.py" "$(xdotool search --name "$title")" || fail "the window cannot be closed"
xdotool key w
kill -CONT $game
wait $game
status=$?
[ $status -eq 0 ] || fail "a closed window leaves with exit code $status"

"$program" --size 640x360 --quiet --trace "$folder/trace.csv" --energy "$folder/energy.csv" \
    --json "$folder/lost.json" 2>"$folder/err" &
game=$!
until_true window_focused || fail "no third window"
until_true moves || fail "the third window shows nothing"
kill -KILL $server
wait $game
status=$?
[ $status -eq 3 ] || fail "a killed server leaves with exit code $status"
[ "$(wc -l <"$folder/err")" = 1 ] || fail "not one line: $(cat "$folder/err")"
steps=$(sed -n 's/^ *"steps": \([0-9]*\),$/\1/p' "$folder/lost.json")
for file in trace energy; do
    last=$(tail -n 1 "$folder/$file.csv")
    [ "${last%%,*}" = "$steps" ] || fail "$file ends at '$last', not at step '$steps'"
done
echo "window_test: passed"
