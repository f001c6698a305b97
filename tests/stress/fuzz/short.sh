#!/bin/sh
# short.sh EXECUTABLE NAME: a fuzz target for 20 seconds upon a copy of its corpus, always from the same seed. Writes into a
# folder of its own, which stays where something was found.
set -eu
executable=$1 name=$2
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d "${TMPDIR:-/tmp}/tyndall-fuzz-XXXXXX")
mkdir "$folder/corpus" "$folder/found" "$folder/tmp"
cp "$here/corpus/$name/"* "$folder/corpus"
dictionary=
[ ! -f "$here/$name.dict" ] || dictionary=-dict=$here/$name.dict
# shellcheck disable=SC2046,SC2086 # lists of words
TMPDIR=$folder/tmp "$executable" "$folder/corpus" $dictionary $(cat "$here/options") -seed=1 -max_total_time=20 \
  -print_final_stats=1 -artifact_prefix="$folder/found/" >"$folder/log" 2>&1 || {
  tail -n 60 "$folder/log"
  echo "what was found: $folder/found"
  exit 1
}
grep -E 'stat::number_of_executed_units|DONE|INITED|Done' "$folder/log"
rm -r "$folder"
