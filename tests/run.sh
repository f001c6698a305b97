#!/bin/sh
# Installs packages, builds with g++ and runs the tests that fit into a quarter of an hour on two cores, packages
# included; says at the end what it left out. With --all, which is for build servers and takes over an hour: every kind
# of OpenGL context, the long sweeps, the build by clang++ under AddressSanitizer and UndefinedBehaviorSanitizer, the
# Khronos compiler of GLSL and the lint. Exit status 0 only if all passed.
set -eu
cd "$(dirname "$0")/.."
# shellcheck source=samples/setup.sh
. samples/setup.sh

case "$*" in
'') all= ;;
--all) all=1 ;;
*) echo "run.sh $*: the only option is --all" >&2 && exit 2 ;;
esac

# A case may take a gigabyte, and Mesa draws with all cores anyway.
test_jobs=$(nproc)
[ "$test_jobs" -le 4 ] || test_jobs=4

build_plain() {
  say "Building with g++ into build/"
  cmake -S . -B build -G Ninja -DTYNDALL_BUILD_TESTS=ON &&
    cmake --build build
}

build_sanitized() {
  say "Building with clang++ and sanitizers into build-sanitize/"
  cmake -S . -B build-sanitize -G Ninja -DTYNDALL_BUILD_TESTS=ON -DTYNDALL_SANITIZE=ON -DCMAKE_BUILD_TYPE=RelWithDebInfo \
    -DCMAKE_CXX_FLAGS_RELWITHDEBINFO="-O1 -gline-tables-only -DNDEBUG" -DTYNDALL_SHADER_CACHE="$PWD/build/shader-cache" \
    -DCMAKE_C_COMPILER="clang-$clang_version" -DCMAKE_CXX_COMPILER="clang++-$clang_version" &&
    cmake --build build-sanitize --target tyndall_sanitized_tests
}

# run_cases FOLDER [OPTION...]: ctest, which prints what fails whole.
run_cases() {
  folder=$1
  shift
  rm -f "$folder/Testing/Temporary/LastTestsFailed.log"
  ctest --test-dir "$folder" --output-on-failure --no-tests=error -j "$test_jobs" "$@"
}

# What failed, once more at the end, where a long log is looked at first: names, and the end of what each one printed.
say_failures() {
  for folder in build build-sanitize; do
    log=$folder/Testing/Temporary/LastTest.log
    [ ! -s "$folder/Testing/Temporary/LastTestsFailed.log" ] || awk -v most=25 '
      / Testing: / { name = $0; sub(/.* Testing: /, "", name); count = 0 }
      { lines[count++ % most] = $0 }
      /^Test (Failed|Timeout|Exception)/ {
        print "-- " name
        for (i = count > most ? count - most : 0; i < count; ++i) print "   " lines[i % most]
      }' "$log"
  done
}

# Says which cases were not run, in groups: what stands before the first dot or two of a name.
left_out() {
  say "Left out, and run by sh tests/run.sh --all:"
  ctest --test-dir build -N -L slow | sed -n 's/^ *Test *#[0-9]*: //p' |
    sed -E 's/^(gl\.[a-z]+(-3\.3|-softpipe)?|bench(\.avsm\.[a-z]+)?|unit|render|shaders)\..*/\1/' | sort | uniq -c |
    while read -r count group; do echo "  $group: $count"; done
  echo "  the build under sanitizers with its tests, and the lint"
}

# shellcheck disable=SC2086,SC2154 # lists of words, from setup.sh
install_packages $build_packages $test_packages ${all:+$all_packages}
build_plain
if [ -z "$all" ]; then
  say "Tests"
  run_cases build -LE slow
  left_out
  exit
fi

lint() {
  say "Formatting and static analysis"
  sh tests/lint.sh
}

# Mesa and LLVM keep memory until exit: leaks are looked for in our own code by tests/leaks.supp.
# The symbolizer is that of the compiler: an older one says that it cannot be used, on the standard error that tests read.
test_sanitized() {
  say "Tests under the sanitizers"
  ASAN_SYMBOLIZER_PATH=/usr/bin/llvm-symbolizer-$clang_version ASAN_OPTIONS=detect_leaks=1 \
    LSAN_OPTIONS="suppressions=$PWD/tests/leaks.supp:print_suppressions=0" run_cases build-sanitize -L sanitize
}

test_plain() {
  say "Tests"
  run_cases build
}

# Each step is taken even where one before it failed: a build server is asked once for all that is wrong.
failed=
for step in lint test_plain build_sanitized test_sanitized; do
  started=$(date +%s)
  "$step" || failed="$failed $step"
  say "$step took $(($(date +%s) - started)) s"
done
[ -z "$failed" ] || { say "FAILED:$failed" && say_failures && exit 1; }
