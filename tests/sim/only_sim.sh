#!/bin/sh
# SPDX-License-Identifier: MIT
# only_sim.sh PROGRAM EXPECTED: checks that the program prints the expected line and links no window
# and no GL.
set -eu
printed=$("$1")
if [ "$printed" != "$2" ]; then
    echo "expected $2, got $printed"
    exit 1
fi
libraries=$(ldd "$1")
case $libraries in
*libc.so*) ;;
*) echo "ldd listed no libraries: $libraries"; exit 1 ;;
esac
if echo "$libraries" | grep -E 'libSDL|libGL|libEGL|libOSMesa|libX11|libxcb|libwayland'; then
    echo "a program that only simulates links the libraries above"
    exit 1
fi
