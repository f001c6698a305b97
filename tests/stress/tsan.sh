#!/bin/sh
# tsan.sh [osmesa|egl]: ThreadSanitizer on two effects in two contexts in two threads, and on the viewer's loader beside
# them. Builds with clang++ what that needs into build-thread/. First the setup has to find a race that is planted.
set -eu
cd "$(dirname "$0")/../.."
# shellcheck source=samples/setup.sh
. samples/setup.sh
context=${1:-osmesa}
scene=build/scenes/projector.glb

say "Building with clang++ and ThreadSanitizer into build-thread/"
# shellcheck disable=SC2154 # from setup.sh
cmake -S . -B build-thread -G Ninja -DTYNDALL_BUILD_TESTS=ON -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DCMAKE_C_COMPILER="clang-$clang_version" -DCMAKE_CXX_COMPILER="clang++-$clang_version" \
  -DCMAKE_C_FLAGS=-fsanitize=thread -DCMAKE_CXX_FLAGS=-fsanitize=thread >/dev/null
cmake --build build-thread --target tyndall-two-threads -j 2

# Mesa draws in the thread that asks it to: what it does in threads of its own is not ours.
run() {
  LP_NUM_THREADS=0 TSAN_OPTIONS="suppressions=$PWD/tests/stress/threads/tsan.supp:exitcode=66:halt_on_error=0" \
    TSAN_SYMBOLIZER_PATH=/usr/bin/llvm-symbolizer-$clang_version build-thread/bin/tyndall-two-threads "$@"
}

say "A race that is planted"
status=0
run --plant-race "$context" >build-thread/planted.log 2>&1 || status=$?
if [ "$status" -ne 66 ] || ! grep -q "SUMMARY: ThreadSanitizer: data race.*TwoThreads.cpp" build-thread/planted.log; then
  tail -n 40 build-thread/planted.log
  echo "ThreadSanitizer does not find it (exit status $status)" >&2
  exit 1
fi
grep -m 1 'SUMMARY.*data race' build-thread/planted.log

say "Two effects in two threads"
[ -f "$scene" ] || { scene='' && say "SKIPPED: the loader, since build/scenes is not built"; }
# shellcheck disable=SC2086 # no word where there is no scene
run "$context" $scene
