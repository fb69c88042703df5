# SPDX-License-Identifier: MIT
# until_true COMMAND...: repeats the command for up to 20 s.
until_true() {
    for _ in $(seq 200); do
        "$@" && return 0
        sleep 0.1
    done
    return 1
}
