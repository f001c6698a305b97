#!/bin/sh
# Stands in for tyndall-regress where that is not built: does nothing but what submit.py depends on.
set -eu
command=$1 list=$2
shift 2
share=1/1 out=
while [ $# -gt 0 ]; do
  case $1 in
    --out) out=$2 && shift 2 ;;
    --share) share=$2 && shift 2 ;;
    --references) references=$2 && shift 2 ;;
    --scenes) shift 2 ;;
    --resume) shift ;;
    *) echo "tyndall-regress: $1: is unknown" >&2 && exit 2 ;;
  esac
done
cases=$(sed -n 's/.*"name": "\([a-z]*\)".*/\1/p' "$list")
case $command in
  record) mkdir -p "$references" ;;
  check)
    mkdir -p "$out"
    index=0
    for case in $cases; do
      [ $((index % ${share#*/})) -ne $((${share%/*} - 1)) ] || echo same >"$out/$case.json"
      index=$((index + 1))
    done
    [ "$share" != 1/1 ] || echo report >"$out/report.html"
    ;;
  report)
    for case in $cases; do
      [ -f "$out/$case.json" ] || { echo "tyndall-regress: case $case: there is no result of it" >&2 && exit 1; }
    done
    echo report >"$out/report.html"
    ;;
esac
