# SPDX-License-Identifier: MIT
# Sourced by campaigns that build in another Debian, whose root folder is in `root`.

# inside COMMANDS: runs them in it, where this repository has the same path.
inside() {
    mkdir -p "$root$PWD"
    unshare --mount bash -euc '
        mount -t proc proc "$0/proc"
        mount --rbind /dev "$0/dev"
        mount --bind "$PWD" "$0$PWD"
        exec chroot "$0" sh -euc "cd \"$PWD\"; $1"' "$root" "$1"
}
