#!/bin/bash
# A study as an array of jobs:  sbatch --array=1-40 --cpus-per-task=4 --time=04:00:00 configs/slurm-array.sh study.yaml -o results/map
# A part whose node is lost is queued again. One that nears its time limit ends the cases at hand, and queues itself again.
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:USR1@120
flankfilm run "$@" -j "${SLURM_CPUS_PER_TASK:-1}" --shard "$SLURM_ARRAY_TASK_ID/${PARTS:-$SLURM_ARRAY_TASK_MAX}" &
work=$! late=
trap 'late=yes; kill -TERM "$work"' USR1
until wait "$work"; code=$?; ! kill -0 "$work" 2>/dev/null; do :; done
if [ "$late" ] && ((code != 0 && code != 4)); then exec scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"; fi
exit "$code"
