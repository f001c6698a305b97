#!/bin/sh
# A bundle is small, whole and enough: packed from a build, it says who draws and compares pictures, by EGL alone.
#   bundle_test.sh BUILD_FOLDER
# Exit status 77: skipped, since what packs it is missing.
set -eu
build=$(cd "$1" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
gpu=$(dirname "$here")/gpu.sh
for program in xz strip objdump; do
  command -v $program >/dev/null && continue
  echo "SKIPPED: no bundle: $program is missing (Debian's packages xz-utils, binutils)" >&2
  exit 77
done

# shellcheck source=tests/gpu/scratch.sh
. "$here/scratch.sh"
require() {
  "$@" && return
  echo "not so: $*" >&2
  exit 1
}

sh "$gpu" --build "$build" --bundle packed
require test "$(du -sk packed | cut -f 1)" -le 51200
require test -s packed/README
# Nothing of this shell's, and no OSMesa.
mkdir home no-osmesa
for name in libOSMesa.so.8 libOSMesa.so.6 libOSMesa.so; do : >no-osmesa/$name; done
env -i PATH="$PATH" HOME="$work/home" LD_LIBRARY_PATH="$work/no-osmesa" sh packed/gpu.sh --out report --only ac --quick --limits 4
require grep -q '| a-who | Who draws | done |' report/report.md
require grep -q '| c-pictures | Pictures against references | done |' report/report.md
require grep -qE '^\| nave \| [^|]+ % \|' report/report.md
require test -s report/pictures.png
require test "$(find report -type f | wc -l)" -le 8
require test -z "$(find "${TMPDIR:-/tmp}" -maxdepth 1 -name 'tyndall-gpu.*' -newer packed/README)"
