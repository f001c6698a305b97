#!/bin/sh
# compile.sh COMPILER CONFIGURE...: runs the command CONFIGURE... and builds in the folder behind its -B. 77: skipped.
set -eu
[ -x "$1" ] || { echo "skipped: g++-mingw-w64-x86-64 is not installed"; exit 77; }
shift
"$@"
while [ "$1" != -B ]; do shift; done
cmake --build "$2"
