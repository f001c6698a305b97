#!/bin/sh
# What a GPU says of Tyndall, in one folder and at most eight minutes: who it is, the tests on its driver, pictures against
# references, time against error, temporal reuse, smoke and hair. From a build or from a bundle:
#   sh gpu.sh [--out DIR] [--build DIR] [--only LETTERS] [--quick|--full] [--limits FACTOR] [--again]
#   sh gpu.sh --bundle DIR [--build DIR]      packs what it needs, to run where nothing is installed but a driver
#   sh gpu.sh --plots DIR                     draws the plots of a report (python3 with matplotlib)
# Run again on the same folder it goes on where it was ended. TYNDALL_EGL_DEVICE names EGL's device, by number or name.
# Exit status: 0: the report is whole, whatever it says; 1: it is not; 2: wrong usage.
set -eu
here=$(cd "$(dirname "$0")" && pwd)

say() { printf '== %s\n' "$*"; }
stop() { # a line, and the end
  echo "gpu.sh: $*" >&2
  exit 1
}
usage() {
  echo "gpu.sh: $*" >&2
  echo "usage: sh gpu.sh [options]; sh gpu.sh --help lists them" >&2
  exit 2
}
help() {
  cat <<'HELP'
sh gpu.sh [options]            measures, and writes a report into a folder
  --out DIR        the folder ; one that holds a report of the same commit and driver is gone on with
  --only LETTERS   of the parts: a who (always), b tests, c pictures, d run time, e reuse, smoke and hair (default abcde)
  --quick          small pictures, as a software driver gets anyway
  --full           the sizes of a GPU, also for a software driver
  --limits FACTOR  on all limits of time, from 0.01 to 60 (default 1: eight minutes)
  --again          what failed, or was ended at its limit, is run again
  --build DIR      the build folder (default: build/ of the project)
sh gpu.sh --bundle DIR         packs all that this needs into a new folder
sh gpu.sh --plots DIR          draws the plots of the report in DIR
TYNDALL_EGL_DEVICE=NAME        the device of EGL, by its number or a part of its name (default: the first that is a GPU)
HELP
  exit 0
}

# A function: the script may change while it runs.
main() {
  out=out/gpu parts=abcde size='' factor=1 again='' build='' command=run bundle=''
  while [ $# -gt 0 ]; do
    case $1 in
    --out | --only | --limits | --build | --bundle | --plots)
      [ $# -gt 1 ] || usage "$1: a value must follow"
      [ -n "$2" ] || usage "$1: must not be empty"
      case $1 in
      --out) out=$2 ;;
      --only) parts=$2 ;;
      --limits) factor=$2 ;;
      --build) build=$2 ;;
      --bundle) command=bundle bundle=$2 ;;
      --plots) command=plots out=$2 ;;
      esac
      shift
      ;;
    --quick | --full)
      [ -z "$size" ] || [ "$size" = "${1#--}" ] || usage "$1: excludes --$size"
      size=${1#--}
      ;;
    --again) again=1 ;;
    --help | -h) help ;;
    *) usage "$1: must be one of --out, --only, --quick, --full, --limits, --again, --build, --bundle, --plots, --help" ;;
    esac
    shift
  done
  case $parts in *[!abcde]*) usage "--only $parts: must be letters of abcde" ;; esac
  case $factor in
  *[!0-9.]* | *.*.* | .) valid=0 ;;
  *) valid=$(awk "BEGIN { print ($factor >= 0.01 && $factor <= 60) }") ;;
  esac
  [ "$valid" = 1 ] || usage "--limits $factor: must be a number from 0.01 to 60"

  # shellcheck source=tests/gpu/places.sh
  . "$here/gpu/places.sh"
  # shellcheck source=tests/gpu/plots.sh
  . "$here/gpu/plots.sh"
  case $command in
  plots) draw_plots "$out" && exit ;;
  bundle)
    # shellcheck source=tests/gpu/bundle.sh
    . "$here/gpu/bundle.sh"
    make_bundle
    exit
    ;;
  esac
  # shellcheck source=tests/gpu/steps.sh
  . "$here/gpu/steps.sh"
  # shellcheck source=tests/gpu/parts.sh
  . "$here/gpu/parts.sh"

  find_places
  open_folder
  part_who # which the report needs
  case $parts in *d*) part_goals ;; esac
  case $parts in *b*) part_tests ;; esac
  case $parts in *c*) part_pictures ;; esac
  case $parts in *d*) part_time ;; esac
  case $parts in *e*) part_motion ;; esac
  close_folder
}
main "$@"
exit
