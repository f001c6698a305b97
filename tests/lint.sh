#!/bin/sh
# clang-format over every file, clang-tidy over every source of the build in build/ whose result is not known yet: a file
# is looked at again when it, a header, or the rules change.
set -eu
cd "$(dirname "$0")/.."
files=$(git ls-files '*.cpp' '*.h' | grep -v '^host/gl/glad/')
clang-format --dry-run --Werror $files

[ -f build/compile_commands.json ] || { echo "build/ is missing: run tests/run.sh" >&2; exit 1; }
stamp=build/lint
mkdir -p "$stamp"
headers=$(cat $(git ls-files '*.h' .clang-tidy | grep -v '^host/gl/glad/') | sha256sum | cut -c1-16)
todo=
for source in $(git ls-files '*.cpp' | grep -v '^tests/package/'); do
  key="$stamp/$(cat "$source" | sha256sum | cut -c1-16)-$headers"
  [ -f "$key" ] || todo="$todo $source:$key"
done
[ -z "$todo" ] && { echo "clang-tidy: nothing changed"; exit 0; }
printf '%s\n' $todo | xargs -P 2 -I{} sh -c '
  source=${1%%:*}; key=${1#*:}
  clang-tidy -p build --quiet "$source" 2>/dev/null >"$key.log" && mv "$key.log" "$key" || { cat "$key.log"; rm -f "$key.log"; exit 255; }' sh {}
echo "clang-tidy: clean"
