# SPDX-License-Identifier: MIT
# frames.sh GAME: plays tests/play.txt and compares the frames with the golden ones. If there are
# none, it writes them: commit them, and remove their folder to accept a change.
program=$1
golden=tests/golden/game
film() {
    "$program" --headless --script tests/play.txt --fps 5 --size 640x360 --golden $golden "$@"
}
if [ -e $golden/manifest.json ]; then
    film --out frames/game --junit frames/game.xml
else
    echo "There are no frames in $golden: they are written. A CI job needs them in the repository."
    film --update-golden
fi
