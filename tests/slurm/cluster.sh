# SPDX-License-Identifier: MIT
# shellcheck shell=bash
# Sourced: start_cluster and stop_cluster, a Slurm of one node in "$folder".
for program in munged slurmctld slurmd sbatch; do
    PATH=$PATH:/usr/sbin command -v $program >/dev/null && continue
    echo "skipped: no $program; install the packages slurm-wlm and munge"
    exit 77
done
PATH=$PATH:/usr/sbin
export SLURM_CONF=${folder:?}/slurm.conf
daemons=()

free_port() {
    local port
    while port=$((20000 + RANDOM % 10000)); do
        (: <"/dev/tcp/127.0.0.1/$port") 2>/dev/null || break
    done
    echo $port
}

# More CPUs than the machine has, so that all jobs run together. A requeued job waits until its
# credential has expired.
write_config() {
    local host user
    host=$(hostname -s)
    user=$(id -un)
    cat >"$SLURM_CONF" <<END
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
SlurmUser=$user
SlurmdUser=$user
AuthInfo=socket=$folder/munge.socket,cred_expire=5
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SwitchType=switch/none
MpiDefault=none
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
SlurmdParameters=config_overrides
ReturnToService=2
KillWait=5
NodeName=$host NodeAddr=127.0.0.1 CPUs=8
PartitionName=all Nodes=ALL Default=YES
END
    echo "IgnoreSystemd=yes" >"$folder/cgroup.conf"
}

# start NAME COMMAND...: a daemon in the background that writes NAME.log.
start() {
    "${@:2}" >"$folder/$1.log" 2>&1 &
    daemons=($! "${daemons[@]}")
}
node_is_idle() { [ "$(sinfo --noheader --format %T 2>/dev/null)" = idle ]; }

start_cluster() {
    local core
    mkdir "$folder/state" "$folder/spool"
    head -c 1024 /dev/urandom >"$folder/munge.key"
    chmod 600 "$folder/munge.key"
    write_config
    start munged munged --force --foreground --key-file "$folder/munge.key" \
        --socket "$folder/munge.socket" --pid-file "$folder/munge.pid" \
        --log-file "$folder/munge.log" --seed-file "$folder/munge.seed"
    until_true 10 test -S "$folder/munge.socket" || skip_cluster
    start slurmctld slurmctld -D -f "$SLURM_CONF"
    # All jobs share one core, so that they take some seconds on any machine.
    core=$(sed -n 's/^Cpus_allowed_list:\t\([0-9]*\).*/\1/p' /proc/self/status)
    start slurmd taskset --cpu-list "$core" slurmd -D -f "$SLURM_CONF"
    until_true 20 node_is_idle || skip_cluster
}

skip_cluster() {
    echo "skipped: Slurm does not start here"
    tail -n 5 "$folder"/munged.log "$folder"/slurm*.log
    exit 77
}

stop_cluster() {
    set +e
    if node=$(sinfo --noheader --format %T 2>/dev/null) && [ -n "$node" ]; then
        scancel --quiet --user "$(id -un)"
        until_true 15 is_idle
    fi
    if [ ${#daemons[@]} != 0 ]; then
        kill "${daemons[@]}" 2>/dev/null
        wait "${daemons[@]}" 2>/dev/null
    fi
    rm -rf "$folder"
}
