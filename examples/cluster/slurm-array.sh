#!/bin/bash
# A part of a run for each task of a Slurm array:
#
#   sbatch --array=1-N slurm-array.sh CASE.toml OUT N
#
# Submit it again to go on with what was interrupted. README.md beside this file tells how the parts are merged.
#SBATCH --job-name=carom
#SBATCH --cpus-per-task=4
#SBATCH --mem=1G
#SBATCH --time=04:00:00
set -euo pipefail

usage="usage: sbatch --array=1-N slurm-array.sh CASE.toml OUT N"
case_file=${1:?$usage}
out=${2:?$usage}
parts=${3:?$usage}
part=${SLURM_ARRAY_TASK_ID:?$usage}

exec carom run "$case_file" --out "$out/parts/$part-of-$parts" --shard "$part/$parts" \
    --threads "${SLURM_CPUS_PER_TASK:-1}" --resume
