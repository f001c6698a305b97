#!/bin/sh
# The job after the array: makes the report of the cases. submit.py submits it.
#   report.sh FOLDER RESUBMIT COMMAND...
# RESUBMIT is the command that renders what is missing; COMMAND writes the report.
set -u
folder=$1 resubmit=$2
shift 2

# No task is left: what a killed one had not finished goes.
find "$folder/results" -name '.tyndall-*.part' -exec rm -f {} +

"$@"
status=$?
if [ "$status" -ne 0 ]; then
  echo "report: $folder: ended with $status; its page, if all cases were there, is in $folder/results" >&2
  echo "report: this renders cases that are missing and no others: $resubmit" >&2
fi
exit "$status"
