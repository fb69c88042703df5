#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# slurm.sh SCENE N OUT [OPTION...]: runs `oiler tradeoff SCENE OPTION...` as a Slurm array of N jobs
# and merges their parts in OUT. OUT/parts has the parts and the log of each job. A requeued job
# continues its part, and after a failure the same command continues all parts.
# OILER is the program, `oiler` if not set. `man sbatch` lists variables such as SBATCH_PARTITION.
set -euo pipefail
fail() { echo "slurm.sh: $*" >&2; exit 2; }

# measure PROGRAM...: USR1, a minute before the time limit, stops the program and requeues the job.
measure() {
    local program status=0 late=no
    "$@" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_MAX" & program=$!
    trap 'late=yes; kill "$program" 2>/dev/null || true' USR1
    trap 'kill "$program" 2>/dev/null || true' TERM
    wait "$program" || wait "$program" || status=$?
    if [ $late = yes ] && [ $status != 0 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 100 ]; then
        scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
    fi
    exit $status
}
case ${1-} in
    --measure) measure "${@:2}" ;;
    --merge) exec "$2" merge "$3"/parts/part-*-of-"$4".json --out "$3" ;;
esac

[ $# -ge 3 ] || fail "usage: slurm.sh SCENE N OUT [OPTION...], such as slurm.sh orbit.toml 16 orbit"
scene=$1 n=$2 out=$3
[ -r "$scene" ] || fail "$scene: cannot be read; give a scene file"
[[ $n =~ ^([2-9]|[1-9][0-9]{1,2}|1000)$ ]] || fail "N $n: give 2 to 1000 jobs"
oiler=$(command -v "${OILER:-oiler}") || fail "${OILER:-oiler}: not found; set OILER to the program"
command -v sbatch >/dev/null || fail "sbatch: not found; run this on a machine of a Slurm cluster"
mkdir -p "$out/parts"
array=$(sbatch --parsable --array="1-$n" --requeue --signal=B:USR1@60 --open-mode=append \
    --output="$out/parts/%a.log" "$0" --measure "$oiler" tradeoff "$scene" --out "$out/parts" "${@:4}")
merge=$(sbatch --parsable --dependency="afterok:${array%%;*}" --kill-on-invalid-dep=yes \
    --output="$out/merge.log" "$0" --merge "$oiler" "$out" "$n")
echo "array job $array measures $n parts; job ${merge%%;*} merges them in $out"
