# SPDX-License-Identifier: MIT
# For a script that plays a game in a real window. Exit 77: Xvfb, xdotool or python3 is missing.
# Before it: program=, title=. It gives: folder, which is removed at the end; game=, which is ended.
. "$(dirname "$0")/../support/until_true.sh"
command -v Xvfb >/dev/null && command -v xdotool >/dev/null && command -v python3 >/dev/null || exit 77

folder=$(mktemp -d)
server=
game=
trap 'kill $game $server 2>/dev/null; rm -rf "$folder"' EXIT
fail() { echo "$(basename "$0" .sh): $1"; exit 1; }
window_focused() { xdotool search --name "$title" windowfocus >/dev/null 2>&1; }

# open_display WIDTHxHEIGHT: its pixels are in $folder/Xvfb_screen0.
# Without -noreset the server restarts when its last client leaves, and refuses clients meanwhile.
open_display() {
    Xvfb -noreset -displayfd 3 -screen 0 "${1}x24" -fbdir "$folder" 3>"$folder/display" >/dev/null 2>&1 &
    server=$!
    until_true test -s "$folder/display" || fail "Xvfb does not start"
    DISPLAY=:$(cat "$folder/display")
    export DISPLAY
}

# start_game OPTIONS...
start_game() {
    "$program" "$@" >"$folder/out" 2>"$folder/err" &
    game=$!
    until_true window_focused || fail "no window: $(cat "$folder/err")"
}
