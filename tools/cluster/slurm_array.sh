#!/usr/bin/env bash
# One task of a Slurm job array: its part of a batch. Options of sbatch and of zskel batch go in as they are:
#   sbatch --array=1-8 tools/cluster/slurm_array.sh models.txt -o 'out/{stem}.json' --item-timeout 60
# A task that was ended, for its time or by scancel, goes on where it was when the same line is submitted again, or
# by itself where --requeue lets it. Afterwards `cat batch.*-of-8.jsonl > batch.jsonl` and the same zskel batch without
# --shard, on any node, does what is missing and says how all of it stands.
#SBATCH --job-name=zskel
#SBATCH --ntasks=1
#SBATCH --requeue
#SBATCH --signal=TERM@60
#SBATCH --open-mode=append
set -euo pipefail
zskel=${ZSKEL:-zskel}
first=${SLURM_ARRAY_TASK_MIN:?submit it with --array=1-N}
count=$((SLURM_ARRAY_TASK_MAX - first + 1))
number=$((SLURM_ARRAY_TASK_ID - first + 1))
cores=${SLURM_CPUS_ON_NODE:-1}
# The node's share, unless the line says otherwise: memory that a job was not given ends the whole job.
own=()
[[ " $* " == *" --workers"* ]] || own+=(--workers "$cores")
[[ " $* " == *" --item-memory"* || -z ${SLURM_MEM_PER_NODE:-} ]] ||
    own+=(--item-memory $((SLURM_MEM_PER_NODE * 9 / 10 / cores)))
# exec: the signals are zskel's, which leaves a state to go on from.
exec "$zskel" batch "$@" --shard "$number/$count" "${own[@]}"
