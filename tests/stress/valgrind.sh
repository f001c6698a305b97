#!/bin/sh
# valgrind.sh: memcheck on what needs no OpenGL (mathematics, settings, scene, medium and image files, lists of cases),
# and on a small frame by OSMesa's softpipe, which interprets shaders: llvmpipe's would be compiled ones. Uses what
# build/ holds.
set -eu
cd "$(dirname "$0")/../.."
# shellcheck source=samples/setup.sh
. samples/setup.sh
command -v valgrind >/dev/null || { echo "valgrind is not installed (Debian: valgrind)" >&2; exit 1; }
[ -x build/bin/tyndall-unit-tests ] || { echo "build/ is missing: run tests/run.sh" >&2; exit 1; }
out=$(mktemp -d "${TMPDIR:-/tmp}/tyndall-valgrind-XXXXXX")
failed=

# check NAME COMMAND...: errors, and blocks that nothing points to any more.
check() {
  name=$1
  shift
  begin=$(date +%s)
  if valgrind --quiet --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite --track-origins=no \
    --suppressions=tests/stress/valgrind.supp --log-file="$out/$name.log" "$@" >"$out/$name.out" 2>&1; then
    echo "$name: clean, $(($(date +%s) - begin)) s"
  else
    failed="$failed $name"
    echo "$name: FAILED"
    tail -n 5 "$out/$name.out"
    head -n 60 "$out/$name.log"
  fi
}

say "valgrind"
check settings build/bin/tyndall-settings-tests \
  'a state that*,every setting out*,what a state leaves*,words are*,every setting has*'
check scene build/bin/tyndall-unit-tests '[animation],[camera],[medium],[image],[files],The good file*,a PNG*,a JPEG*'
check effect build/bin/tyndall-unit-tests 'numbers that 32*,directions may*,a range is*,*epipole*'
export GALLIUM_DRIVER=softpipe DRAW_USE_LLVM=0
check frame build/bin/tyndall-render build/scenes/smoke.glb --size 16x12 --shadow-size 32 \
  --no-program-cache --context osmesa --slices 16 --samples 64 --out "$out/frame.exr"
[ -z "$failed" ] || { echo "logs: $out" && exit 1; }
rm -r "$out"
