#!/bin/sh
# Dresses a list on a cluster with Slurm, a part a task; the second job makes the table when all parts have ended. A part that was
# stopped goes on where it was when it is queued again.
#   sbatch --export=ALL,LIST=list.jsonl,OUT=out slurm.sh
#   sbatch --dependency=afterany:JOB --wrap 'toile report merge out --out table.csv'
#SBATCH --job-name=toile
#SBATCH --array=1-64
#SBATCH --cpus-per-task=1
#SBATCH --mem=2G
#SBATCH --time=04:00:00
#SBATCH --requeue
exec toile dress --list "$LIST" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --out "$OUT" --threads 1 --resume
