#!/bin/sh
# clang-format over every file, clang-tidy over every source of the build in build/ whose result is not known yet: a file
# is looked at again when it, a header, or the rules change. Both of one version: the next has other formats and findings.
set -eu
cd "$(dirname "$0")/.."
# shellcheck source=samples/setup.sh
. samples/setup.sh
clang_format=clang-format-$clang_version clang_tidy=clang-tidy-$clang_version

# Our files whose name matches $1; the GL loader is generated.
list() { find .clang-tidy effect host samples tests -type f -name "$1" ! -path 'host/gl/glad/*' | sort; }
sources() { list '*.cpp' && list '*.h'; }

# Catch2's header differs between the versions that tests/support/Catch.h takes.
if sources | grep -v '^tests/support/Catch.h$' | xargs grep -n 'include <catch2/'; then
  echo "include support/Catch.h instead" >&2
  exit 1
fi

# Cases run side by side: a name that two of them choose is a failure that nobody sees twice.
if sources | grep -v '^tests/support/TemporaryFolder.h$' | grep '^tests/' | xargs grep -n temp_directory_path; then
  echo "write into a tests::TemporaryFolder instead" >&2
  exit 1
fi

if command -v "$clang_format" >/dev/null; then
  sources | xargs "$clang_format" --dry-run --Werror
  echo "$clang_format: clean"
else
  say "SKIPPED: $clang_format is not installed"
fi

if ! command -v "$clang_tidy" >/dev/null; then
  say "SKIPPED: $clang_tidy is not installed"
  exit 0
fi

[ -f build/compile_commands.json ] || { echo "build/ is missing: run tests/run.sh" >&2; exit 1; }
stamps=build/lint
mkdir -p "$stamps"
# Without precompiled headers: they are the other compiler's, and a source has to include what it uses. That the standard
# library uses what it calls deprecated is no news of ours, as in CMakeLists.txt.
sed -E 's/ -Winvalid-pch//; s/( -Xclang)? -include(-pch)?( -Xclang)? [^ ]*cmake_pch[^ ]*//g' build/compile_commands.json \
  >"$stamps/compile_commands.json"
rules=$({ echo "$clang_tidy" && { list '*.h' && list .clang-tidy; } | xargs cat; } | sha256sum | cut -c1-16)
# The package's consumer is a project of its own, which the build does not know; nor does it know what needs OGRE without.
unknown='^tests/package/'
if ! grep -q samples/ogre/ build/compile_commands.json; then
  say "SKIPPED: samples/ogre, since OGRE is not installed"
  unknown="$unknown|^samples/ogre/"
fi
list '*.cpp' | grep -vE "$unknown" | while read -r source; do
  stamp=$stamps/$(echo "$source" | cat - "$source" | sha256sum | cut -c1-16)-$rules
  [ -f "$stamp" ] || echo "$source $stamp"
done >"$stamps/todo"
# Paths through calls are followed less far than the analyzer's default has it, which takes three times as long.
# shellcheck disable=SC2016 # the inner shell expands them
xargs -r -n 2 -P "$(nproc)" sh -c '
  "$0" -p build/lint --quiet --extra-arg=-Wno-deprecated-declarations --extra-arg=-Xclang --extra-arg=-analyzer-config \
    --extra-arg=-Xclang --extra-arg=mode=shallow "$1" >"$2.log" 2>&1 && mv "$2.log" "$2" || { cat "$2.log"; exit 1; }' "$clang_tidy" <"$stamps/todo"
echo "$clang_tidy: clean"
