# Sourced by run and campaigns: runs commands of the READMEs, with warnings as errors.
export CI=true DEBIAN_FRONTEND=noninteractive
# Presets with the same compiler options share objects, so that each is compiled once.
export CCACHE_BASEDIR=$PWD CCACHE_NOHASHDIR=true CCACHE_SLOPPINESS=pch_defines,time_macros
export CMAKE_C_COMPILER_LAUNCHER=ccache CMAKE_CXX_COMPILER_LAUNCHER=ccache

# Prints the text of the sh blocks on standard input. A failure before && or || does not end a
# script, so the commands are separated.
blocks() {
    awk '/^```sh$/ { on = 1; next } /^```$/ { on = 0 } on' |
        sed 's/ && /; /g; s/ &&$//; s/ || break//'
}

# Runs the commands on standard input up to the first that fails. Prints each before it begins, and
# at the end those that took a second and more, the longest first.
run_timed() {
    bash -euo pipefail -c '
        times=() running=
        note() {
            if [ -n "$running" ] && [ "$((SECONDS - began))" -gt 0 ]; then
                times+=("$(printf "%5d s  %.110s" "$((SECONDS - began))" "$running")")
            fi
            running=$1 began=$SECONDS
        }
        trap '\''trap - DEBUG; note ""; printf "%s\n" "${times[@]}" | sort -rn; echo "all: $SECONDS s"'\'' EXIT
        trap '\''note "$BASH_COMMAND"; echo "+ $BASH_COMMAND"'\'' DEBUG
        '"$(cat)"
}
