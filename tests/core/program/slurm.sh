#!/bin/bash
# A study under a real Slurm of two nodes on loopback: parts are sent, a node dies with what runs on
# it, its parts are queued again and end on the other node, with the results of an undisturbed run.
#   slurm.sh FLANKFILM SCRIPT TOYS...
set -eu
flankfilm=$(realpath "$1")
script=$(realpath "$2")
shift 2
export PATH="$PATH:/usr/sbin"
for tool in munged slurmctld slurmd sbatch; do
    type -P $tool >/dev/null || { echo "needs $tool" && exit 77; }
done
scratch=$(mktemp -d)
lab="$scratch/the lab"
conf=$scratch/slurm
mkdir "$lab" "$conf"
export SLURM_CONF=$conf/slurm.conf

# The processes that were started with the variable $1, such as SLURMD_NODENAME=n1.
with() {
    grep -lsazxF "SLURM_CONF=$SLURM_CONF" /proc/[0-9]*/environ | xargs -r grep -lsazxF "$1" |
        cut -d/ -f3
}

# The keepers of the jobs of node $1, which are parents of what runs there.
keepers() {
    local pid parent
    for pid in $(with "SLURMD_NODENAME=$1"); do
        parent=$(awk '{print $4}' "/proc/$pid/stat" 2>/dev/null) || continue
        if grep -qsa '^slurmstepd' "/proc/$parent/cmdline"; then echo "$parent"; fi
    done | sort -u
}

# Kills a node at once: its daemon, the keepers of its jobs, and the jobs.
lose() {
    local slurmd=
    if [ -s "$conf/slurmd-$1.pid" ]; then slurmd=$(cat "$conf/slurmd-$1.pid"); fi
    rm -f "$conf/slurmd-$1.pid"
    kill -9 $slurmd $(keepers "$1") $(with "SLURMD_NODENAME=$1") 2>/dev/null || true
}

end() {
    code=$?
    trap - EXIT
    set +e
    if [ $code -ne 0 ] && [ $code -ne 77 ]; then tail -n 30 "$conf"/log/* "$lab"/log/*; fi
    lose n0
    lose n1
    kill -9 $(with "SLURM_CONF=$SLURM_CONF") 2>/dev/null
    rm -rf "$scratch"
    exit $code
}
trap end EXIT
trap 'exit 1' TERM INT

# until_true SECONDS COMMAND...
until_true() {
    local left=$(($1 * 10))
    shift
    until "$@"; do
        left=$((left - 1))
        [ $left -gt 0 ] || return 1
        sleep 0.1
    done
}

start_slurm() {
    local ports
    ports=($(python3 -c '
import socket
taken = [socket.socket() for _ in range(4)]
for s in taken: s.bind(("127.0.0.1", 0))
print(*[s.getsockname()[1] for s in taken])'))
    mkdir -p "$conf"/{state,log,spool-n0,spool-n1}
    chmod 755 "$scratch" "$conf"
    dd if=/dev/urandom of="$conf/munge.key" bs=1024 count=1 status=none
    chmod 600 "$conf/munge.key"
    munged --force --key-file="$conf/munge.key" --socket="$conf/munge.sock" \
        --pid-file="$conf/munged.pid" --log-file="$conf/log/munged" \
        --seed-file="$conf/munge.seed" 2>/dev/null
    cat >"$SLURM_CONF" <<CONF
ClusterName=flankfilm
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmctldPort=${ports[0]}
SlurmdPort=${ports[1]}
AuthType=auth/munge
AuthInfo=socket=$conf/munge.sock,cred_expire=5
CryptoType=crypto/munge
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
StateSaveLocation=$conf/state
SlurmdSpoolDir=$conf/spool-%n
SlurmctldPidFile=$conf/slurmctld.pid
SlurmdPidFile=$conf/slurmd-%n.pid
SlurmctldLogFile=$conf/log/slurmctld
SlurmdLogFile=$conf/log/slurmd-%n
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=sched_interval=2,bf_interval=2
SlurmdTimeout=3
MessageTimeout=5
KillWait=2
ReturnToService=2
MpiDefault=none
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
SlurmdParameters=config_overrides
NodeName=n0 NodeHostname=$(hostname) NodeAddr=127.0.0.1 Port=${ports[2]} CPUs=2
NodeName=n1 NodeHostname=$(hostname) NodeAddr=127.0.0.1 Port=${ports[3]} CPUs=2
PartitionName=main Nodes=n0,n1 Default=YES MaxTime=INFINITE State=UP
CONF
    slurmctld -c
    slurmd -N n0
    slurmd -N n1
    until_true 30 nodes_are_idle
}
nodes_are_idle() { [ "$(sinfo -h -N -o %t 2>/dev/null | grep -c '^idle')" -eq 2 ]; }
both_nodes_work() { [ "$(squeue -h -r -t R -o %N | sort -u | wc -l)" -eq 2 ]; }
queue_is_empty() { [ -z "$(squeue -h 2>&1)" ]; }
# each of the parts that run on n1 has written a case down
parts_are_under_way() {
    local part
    for part in $(squeue -h -r -t R -w n1 -o %K); do
        [ -s "$lab/my results/journal.$part-of-4.jsonl" ] || return 1
    done
}

mkdir -p "$lab/my toys/toy"
for toy; do
    name=${toy##*/cli-toy-}
    ln -s "$(realpath "$toy")" "$lab/my toys/toy/$name"
done
cd "$lab"
cat >"my study.yaml" <<YAML
format: 2
pipeline:
  wave: {use: toy/wave, amplitude: 2 mm, work: 400 ms}
  sum: {use: toy/sum, wave: wave}
outputs: [sum.*, wave.height]
study:
  sweep:
    wave.amplitude: {from: 1 mm, to: 4 mm, points: 40}
YAML
"$flankfilm" run "my study.yaml" -j 8 -o calm --plugin-path "my toys" >calm.out

# without control groups, or in a container, Slurm itself may refuse to run
start_slurm || {
    echo "needs a system that Slurm runs on: $(sed -n 's/.*\(error\|fatal\): //p' "$conf"/log/slurmd* | uniq | head -n 3 | paste -sd ';')"
    exit 77
}
echo "Slurm is up after $SECONDS s"
mkdir log
job=$(PATH="$(dirname "$flankfilm"):$PATH" sbatch --parsable --array=1-4 --time=00:10:00 \
    --output=log/part-%a.out "$script" "my study.yaml" -o "my results" --plugin-path "my toys")
until_true 30 both_nodes_work
until_true 30 parts_are_under_way
lost=$(squeue -h -r -t R -w n1 -o %K | sort | tr '\n' ' ')
late=$(squeue -h -r -t R -w n0 -o %K | head -n 1)
[ -n "$lost" ]
[ -n "$late" ]
lose n1
scancel --batch --signal=USR1 "${job}_$late"
echo "job $job: node n1 is lost with the parts $lost, part $late is warned, after $SECONDS s"
until_true 90 queue_is_empty
echo "the queue is empty after $SECONDS s"

for part in 1 2 3 4; do
    told=$(scontrol show job "${job}_$part")
    grep -q 'JobState=COMPLETED' <<<"$told"
    if [[ " $lost $late " == *" $part "* ]]; then
        grep -q 'Restarts=1' <<<"$told"
        grep -q 'NodeList=n0' <<<"$told"
        echo "part $part has run twice"
    fi
done
grep -q 'the study was stopped' "log/part-$late.out"
cmp calm/table.csv "my results/table.csv"
for results in calm "my results"; do
    "$flankfilm" export "$results" --to csv -o "$results-csv"
done
cmp calm-csv/wave-t.csv "my results-csv/wave-t.csv"
echo "40 cases as without Slurm"
