#!/bin/sh
# A task of the array: COMMAND on its share, of which it leaves what is whole. submit.py submits it.
#   task.sh TASKS COMMAND...
set -u
tasks=$1
shift

# llvmpipe would take every core of the machine.
export LP_NUM_THREADS="${LP_NUM_THREADS:-${SLURM_CPUS_ON_NODE:-1}}"
echo "$(date -u +%FT%TZ) $(hostname): share $SLURM_ARRAY_TASK_ID/$tasks of $*"
"$@" --share "$SLURM_ARRAY_TASK_ID/$tasks" --resume
status=$?
echo "$(date -u +%FT%TZ) ended with $status"

# Ended by a signal, for want of memory, say, or by hand: twice more, then it counts as failed.
if [ "$status" -gt 128 ] && [ "${SLURM_RESTART_COUNT:-0}" -lt 2 ]; then
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
fi
exit "$status"
