#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# slurm_test.sh [OILER]: runs assets/ci/slurm.sh on a Slurm of one node that the test starts in a
# temporary folder. Jobs are killed, cancelled, requeued and stopped at the time limit. The merged
# errors equal those of one run bit for bit. Exit 77: Slurm is not installed or cannot run here.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
OILER=$(realpath "${1:-$source/build/bin/oiler}")
export OILER
folder=$(mktemp -d)
out="$folder/the sweep"
parts=$out/parts
scene="$folder/a chain.toml"
options=(--max-rate 250 --duration 60)
# shellcheck source=tests/slurm/cluster.sh
. "$here/cluster.sh"
whole=
trap 'stop_cluster; kill $whole 2>/dev/null' EXIT

fail() {
    echo "slurm_test: $*"
    squeue --format "%i %T %r" || true
    tail -n 5 "$out"/*.log "$parts"/*.log "$folder"/*d.log 2>/dev/null || true
    exit 1
}
# until_true SECONDS COMMAND...: repeats the command until it succeeds.
until_true() {
    local end=$((SECONDS + $1))
    until "${@:2}"; do
        [ $SECONDS -lt $end ] || return 1
        sleep 0.2
    done
}
slurm() { "$source/assets/ci/slurm.sh" "$@"; }

# refuses TEXT ARGUMENT...: slurm.sh exits with 2 and one line that has the text.
refuses() {
    local status=0 line
    line=$(slurm "${@:2}" 2>&1) || status=$?
    [ $status = 2 ] || fail "slurm.sh ${*:2} exits with $status"
    [[ $line == *"$1"* && $line != *$'\n'* ]] || fail "slurm.sh ${*:2} prints $line"
}
# submit N OPTION...: sets `array` and `merged`, the numbers of the jobs.
submit() {
    local answer
    answer=$(slurm "$scene" "$1" "$out" "${@:2}") || fail "slurm.sh exits with $?"
    [[ $answer =~ ^array\ job\ ([0-9]+)\ .*\ job\ ([0-9]+)\ merges ]] || fail "slurm.sh prints $answer"
    array=${BASH_REMATCH[1]}
    merged=${BASH_REMATCH[2]}
}

part() { echo "$parts/part-$1-of-8.json"; }
# A part of the sweep has 9 or 10 of the 74 series.
finished_series() { grep -c '"done": true' "$(part "$1")" 2>/dev/null || true; }
# is_in_the_middle JOB COUNT: the part has more finished series than COUNT, and not all.
is_in_the_middle() {
    local finished
    finished=$(finished_series "$1")
    [ "${finished:-0}" -gt "$2" ] && [ "$finished" -lt 9 ]
}
reach_the_middle() {
    until_true 60 is_in_the_middle "$1" "$2" || fail "job $1 does not reach the middle of its part"
}
kill_program() {
    local program
    program=$(pgrep -f -- "tradeoff $folder/.* --shard $1/8") || fail "job $1 has no program"
    kill -KILL "$program"
}
# continued JOB COUNT: the log tells COUNT times that the part was continued.
continued() {
    local counts
    counts=$(sed -n 's/.*continuing .*: \([1-9][0-9]*\) of 74 methods.*/\1/p' "$parts/$1.log")
    [ "$(wc -w <<<"$counts")" = "$2" ] || fail "job $1 was not continued $2 times: '$counts'"
    echo "job $1 kept ${counts//$'\n'/, then } series"
}
job_state() { scontrol --oneliner show job "$1" | grep -o 'JobState=[A-Z]*'; }
is_idle() { [ -z "$(squeue --noheader)" ]; }

# The errors of a sweep: all but times, and what depends on them.
errors_csv() { cut -d, -f1-5,7-12 "$1/tradeoff.csv"; }
errors_json() { grep -vE '"(ns_per_second|ns_spread|ns_together|pareto|cores)":' "$1/tradeoff.json"; }
same_errors() {
    cmp <(errors_csv "$1") <(errors_csv "$2") && cmp <(errors_json "$1") <(errors_json "$2")
}
merge() {
    "$OILER" merge "$parts"/part-*-of-8.json --out "$folder/merged" --quiet >"$folder/merged.log" 2>&1
}

cp "$source/assets/scenes/chain.toml" "$scene"
refuses "usage: slurm.sh SCENE N OUT" "$scene" 8
refuses "N 1: give 2 to 1000 jobs" "$scene" 1 "$out"
refuses "nowhere.toml: cannot be read" "$folder/nowhere.toml" 8 "$out"
OILER=$folder/nowhere refuses "nowhere: not found; set OILER" "$scene" 8 "$out"
start_cluster

submit 8 "${options[@]}"
"$OILER" tradeoff "$scene" --out "$folder/whole" "${options[@]}" --quiet >"$folder/whole.log" &
whole=$!
reach_the_middle 1 0
kill_program 1
reach_the_middle 3 0
reach_the_middle 8 0
scancel "$array"
until_true 30 is_idle || fail "cancelled jobs stay"
[ "$(job_state "$merged")" = JobState=CANCELLED ] || fail "the merge: $(job_state "$merged")"
echo "killed and cancelled after $SECONDS s"

kept_by_3=$(finished_series 3)
kept_by_8=$(finished_series 8)
submit 8 "${options[@]}"
reach_the_middle 3 "$kept_by_3"
scontrol requeue "${array}_3"
# Job 8 is the last of the array: its own number is also that of the array.
reach_the_middle 8 "$kept_by_8"
scancel --signal=USR1 --batch "${array}_8"
until_true 300 is_idle || fail "the jobs do not finish"
[ "$(job_state "$merged")" = JobState=COMPLETED ] || fail "the merge: $(job_state "$merged")"
continued 1 1
continued 3 2
continued 8 2
wait $whole || fail "the whole sweep exits with $?"
whole=
same_errors "$folder/whole" "$out" || fail "the merged errors differ from those of one run"
echo "$(($(wc -l <"$out/tradeoff.csv") - 1)) rows are equal after $SECONDS s"

# Controls: a changed number is found, a missing part is refused.
awk '/"rows"/ { rows = 1 } rows && !changed { changed = sub(/"velocity_error": [0-9]/, "&1") } 1' \
    "$(part 5)" >"$folder/changed"
mv "$folder/changed" "$(part 5)"
if merge && same_errors "$folder/whole" "$folder/merged" >/dev/null; then fail "a changed number is not found"; fi
rm "$(part 5)"
if merge; then fail "a missing part is not noticed"; fi

# A failed job cancels the merge.
submit 2 --max-rate nonsense
until_true 60 is_idle || fail "the merge of failed jobs stays in the queue"
grep -q "max-rate" "$parts/1.log" || fail "the log does not have the error"
echo "slurm_test: passed in $SECONDS s"
