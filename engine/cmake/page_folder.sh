#!/bin/sh
# SPDX-License-Identifier: MIT
# page_folder.sh PROGRAM FOLDER ASSETS: puts the files of the page and its program, PROGRAM.js and
# PROGRAM.wasm, into FOLDER. A page that is opened from a disk can fetch nothing, and no worker may
# load a file there: so the program is a function, and its WebAssembly is in a script, too.
set -eu
program=$1 folder=$2 assets=$3
mkdir -p "$folder/pictures"
cp "$assets"/web/* "$program.wasm" "$folder"
cp "$assets"/pictures/menu/*.png "$folder/pictures"
{
    echo 'function oilerProgram() {'
    cat "$program.js"
    echo 'return createOiler;'
    echo '}'
} >"$folder/program.js"
{
    printf 'oilerWasm = "'
    base64 -w 0 "$program.wasm"
    echo '";'
} >"$folder/wasm.js"
