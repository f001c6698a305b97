#!/bin/sh
# compile.sh GLSLANG TOOL DIR: has TOOL (tyndall-shaders) write every shader into DIR, the effect's as ESSL, too, and the
# Khronos reference compiler read all of them, as they are and those of OpenGL with their #version raised: words that a
# later GLSL reserves are refused there.
set -eu
glslang=$1 tool=$2 dir=$3
[ -x "$glslang" ] || { echo "glslangValidator is missing: run tests/run.sh --all" >&2; exit 1; }
rm -rf "$dir"
"$tool" "$dir/own"
"$tool" --essl "$dir/essl"

# Says which files of a folder are refused, and why.
compile() {
  if ! find "$dir/$1" -type f -print0 | xargs -0 -n 100 -P "$(nproc)" "$glslang" >"$dir/$1.log"; then
    grep -E '^(ERROR|WARNING)' "$dir/$1.log" | sort | uniq -c | sort -rn | head -50
    echo "refused with the #version: $1"
    exit 1
  fi
  echo "accepted with the #version: $1"
}

compile own
compile essl
for version in 430 460; do
  mkdir "$dir/$version"
  cp "$dir"/own/* "$dir/$version"
  find "$dir/$version" -type f -exec sed -i '1s/^#version \(330\|430\) core/#version '$version' core/' {} +
  compile "$version"
done
rm -rf "$dir"
