#!/bin/sh
# clang-format over every file, clang-tidy over every source of the build in build/ whose result is not known yet: a file
# is looked at again when it, a header, or the rules change.
set -eu
cd "$(dirname "$0")/.."

# Our files whose name matches $1; the GL loader is generated.
list() { find .clang-tidy effect host samples tests -type f -name "$1" ! -path 'host/gl/glad/*' | sort; }

{ list '*.cpp' && list '*.h'; } | xargs clang-format --dry-run --Werror
echo "clang-format: clean"

[ -f build/compile_commands.json ] || { echo "build/ is missing: run tests/run.sh" >&2; exit 1; }
stamps=build/lint
mkdir -p "$stamps"
# Without precompiled headers: they are the other compiler's, and a source has to include what it uses.
sed -E 's/ -Winvalid-pch//; s/( -Xclang)? -include(-pch)?( -Xclang)? [^ ]*cmake_pch[^ ]*//g' build/compile_commands.json \
  >"$stamps/compile_commands.json"
rules=$({ list '*.h' && list .clang-tidy; } | xargs cat | sha256sum | cut -c1-16)
# The package's consumer is a project of its own, which the build does not know.
list '*.cpp' | grep -v '^tests/package/' | while read -r source; do
  stamp=$stamps/$(echo "$source" | cat - "$source" | sha256sum | cut -c1-16)-$rules
  [ -f "$stamp" ] || echo "$source $stamp"
done >"$stamps/todo"
# shellcheck disable=SC2016 # the inner shell expands them
xargs -r -n 2 -P "$(nproc)" sh -c '
  clang-tidy -p build/lint --quiet "$1" >"$2.log" 2>&1 && mv "$2.log" "$2" || { cat "$2.log"; exit 1; }' sh <"$stamps/todo"
echo "clang-tidy: clean"
