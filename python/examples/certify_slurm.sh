#!/usr/bin/env bash
# A study as an array of Slurm's: sbatch --array=1-8 certify_slurm.sh SCENE VARY.toml SAMPLES
# and then: surefoot certify merge out/shard-* --out out/all
# The same with GNU parallel: seq 8 | parallel SLURM_ARRAY_TASK_ID={} SLURM_ARRAY_TASK_COUNT=8 ./certify_slurm.sh SCENE VARY.toml SAMPLES
#SBATCH --cpus-per-task=4
set -euo pipefail
k=$SLURM_ARRAY_TASK_ID n=$SLURM_ARRAY_TASK_COUNT
resume=()
if [[ -e out/shard-$k/study.json ]]; then resume=(--resume); fi
exec surefoot certify "$1" --vary "$2" --samples "$3" --shard "$k/$n" --out "out/shard-$k" "${resume[@]}"
