#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Finds the symmetry of every mesh of a folder, a task of a Slurm array for each.
#
#   sbatch --array=1-$(ls scans/*.ply | wc -l) slurm_array.sh scans/*.ply
#
# The results are in results/NAME.csv. Submitted again, it does what is missing.
#SBATCH --job-name=ga_symmetry
#SBATCH --cpus-per-task=2
#SBATCH --mem=2G
#SBATCH --time=00:10:00
#SBATCH --output=ga_symmetry-%A_%a.log
set -euo pipefail
mesh=${!SLURM_ARRAY_TASK_ID}
name=$(basename "${mesh%.*}")
mkdir -p results
if [ -e "results/$name.csv" ]; then  # written whole or not at all
  echo "results/$name.csv is there"
  exit
fi
# exec: the signal that ends a task reaches the program, which then leaves no half-written file.
exec ga_symmetry find "$mesh" --threads "$SLURM_CPUS_PER_TASK" --summary text -o "results/$name.csv"
