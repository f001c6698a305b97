#!/bin/sh
# run.sh [MINUTES [NAME...]]: fuzzes each target (all, 30 minutes) with what build-sanitize holds, two at a time. The
# corpora grow in build-sanitize/fuzz/NAME/corpus, from those in the repository, and are merged at the end: what reaches
# nothing new goes. Prints a table; exit status 1 if anything was found, which is in build-sanitize/fuzz/NAME/found.
# With KEEP=64, say, so many files of each go into the repository's corpora.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
build=$(cd "$here/../../.." && pwd)/build-sanitize
minutes=${1:-30}
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- scene png exr medium state cases arguments frame
export ASAN_SYMBOLIZER_PATH="${ASAN_SYMBOLIZER_PATH:-$(command -v llvm-symbolizer-19 || true)}"
export LSAN_OPTIONS="suppressions=$here/../../leaks.supp:print_suppressions=0"

# Inputs are files: in memory, if there is a folder that is.
memory=${TMPDIR:-/tmp}
[ ! -w /dev/shm ] || memory=/dev/shm

dictionary() { [ ! -f "$here/$1.dict" ] || echo "-dict=$here/$1.dict"; }

# one NAME: a target, for so long as is asked; it goes on where something was found.
one() {
  folder=$build/fuzz/$1
  rm -rf "$folder/found" "$folder/merged"
  mkdir -p "$folder/corpus" "$folder/found"
  scratch=$(mktemp -d "$memory/tyndall-fuzz-XXXXXX")
  : >"$folder/log"
  end=$(($(date +%s) + $(awk "BEGIN { print int(60 * $minutes) }")))
  executable=$build/bin/tyndall-fuzz-$1
  while left=$((end - $(date +%s))) && [ "$left" -gt 0 ] && [ "$(find "$folder/found" -type f | wc -l)" -lt 20 ]; do
    # shellcheck disable=SC2046 # lists of words
    TMPDIR=$scratch nice -n 10 "$executable" "$folder/corpus" "$here/corpus/$1" $(dictionary "$1") \
      $(cat "$here/options") -max_total_time="$left" -print_final_stats=1 -artifact_prefix="$folder/found/" \
      >>"$folder/log" 2>&1 || true
  done
  mkdir "$folder/merged"
  # shellcheck disable=SC2046
  TMPDIR=$scratch nice -n 10 "$executable" -set_cover_merge=1 $(cat "$here/options") "$folder/merged" "$here/corpus/$1" \
    "$folder/corpus" >"$folder/merge.log" 2>&1
  rm -r "$folder/corpus" "$scratch"
  mv "$folder/merged" "$folder/corpus"
}

# keep NAME: into the repository KEEP files of at most 4 KiB, evenly from the smallest to the largest.
keep() {
  find "$build/fuzz/$1/corpus" -type f -size -9b -printf '%s %p\n' | sort -n | cut -d' ' -f2 >"$build/fuzz/$1/small"
  awk -v most="$KEEP" '{ file[NR] = $0 } END { n = NR < most ? NR : most
    for (i = 0; i < n; ++i) print file[1 + int(i * NR / n)] }' "$build/fuzz/$1/small" | xargs cp -t "$here/corpus/$1"
}

# row NAME: what became of it.
row() {
  folder=$build/fuzz/$1
  runs=$(awk '/number_of_executed_units/ { n += $2 } END { print n + 0 }' "$folder/log")
  cover=$(sed -nE 's/.* with ([0-9]+) new features added; ([0-9]+) new coverage edges.*/\2, \1/p' "$folder/merge.log")
  echo "| $1 | $runs | $cover | $(find "$folder/corpus" -type f | wc -l) | $(find "$folder/found" -type f | wc -l) |"
}

while [ $# -gt 0 ]; do
  one "$1" &
  first=$1 second=${2:-}
  [ -z "$second" ] || one "$second" &
  wait
  for name in $first $second; do
    row "$name" >"$build/fuzz/$name/row"
    names="${names:-} $name"
    [ -z "${KEEP:-}" ] || keep "$name"
  done
  shift
  [ $# -eq 0 ] || shift
done
echo "| target | runs in $minutes min | edges, features | corpus | found |"
echo "|---|---|---|---|---|"
found=0
for name in $names; do
  cat "$build/fuzz/$name/row"
  [ -z "$(find "$build/fuzz/$name/found" -type f)" ] || found=1
done
exit $found
