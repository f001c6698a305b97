#!/bin/sh
# Installs packages, builds with g++ and with clang++ under AddressSanitizer and UndefinedBehaviorSanitizer, and runs every
# test and the lint. Ends with ctest's own summary; exit status 0 only if all passed.
set -eu
cd "$(dirname "$0")/.."
# shellcheck source=samples/setup.sh
. samples/setup.sh

# shellcheck disable=SC2086,SC2154 # lists of words, from setup.sh
install_packages $build_packages $test_packages $all_packages

say "Building with g++ into build/"
cmake -S . -B build -G Ninja -DTYNDALL_BUILD_TESTS=ON
cmake --build build

say "Building with clang++ and sanitizers into build-sanitize/"
cmake -S . -B build-sanitize -G Ninja -DTYNDALL_BUILD_TESTS=ON -DTYNDALL_SANITIZE=ON -DCMAKE_BUILD_TYPE=RelWithDebInfo \
  -DCMAKE_C_COMPILER="clang-$clang_version" -DCMAKE_CXX_COMPILER="clang++-$clang_version"
cmake --build build-sanitize

say "Formatting and static analysis"
sh tests/lint.sh

say "Tests under the sanitizers"
# Mesa and LLVM keep memory until exit: leaks are looked for in our own code by tests/leaks.supp.
ASAN_OPTIONS=detect_leaks=1 LSAN_OPTIONS="suppressions=$PWD/tests/leaks.supp:print_suppressions=0" \
  ctest --test-dir build-sanitize --output-on-failure -j 2 -L sanitize

say "Tests"
ctest --test-dir build --output-on-failure -j 2
