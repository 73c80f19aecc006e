#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
# A study over the processes of a cluster, for Slurm:   sbatch docs/slurm-job.sh my_case
# Submit it again after it ran out of time: --resume goes on, finished scenes are in the store.
#SBATCH --job-name=breech
#SBATCH --ntasks=8
#SBATCH --cpus-per-task=4
#SBATCH --time=04:00:00
set -euo pipefail
case=${1:?which case?}
export OMP_NUM_THREADS=${SLURM_CPUS_PER_TASK:-1} OMP_WAIT_POLICY=passive # no OMP_PLACES: idle processes lend their threads

# Stop by itself ten minutes before Slurm would: rank 0's scene is checkpointed, the others' are computed again.
srun breech onset "$case" -o "out/$(basename "$case" .yaml)" --store "${BREECH_STORE:-out/store}" \
    --threads "$OMP_NUM_THREADS" --resume --max-walltime 3:50:00 --quiet
