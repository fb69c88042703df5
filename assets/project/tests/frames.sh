# SPDX-License-Identifier: MIT
# frames.sh GAME: plays tests/play.txt and compares the frames with the golden ones. If there are
# none, it writes them: commit them, and remove their folder to accept a change.
set -e
golden=tests/golden/game
film="--headless --script tests/play.txt --fps 5 --frames 15 --size 640x360"
if [ -e $golden/manifest.json ]; then
    "$1" $film --golden $golden --out frames/game --junit frames/game.xml
else
    echo "There are no frames in $golden: they are written. A CI job needs them in the repository."
    "$1" $film --golden $golden --update-golden
fi
