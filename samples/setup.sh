# shellcheck shell=sh
# Sourced by samples/run.sh and the scripts in tests: what the build needs on Debian 12 and 13.

say() { printf '\n== %s\n' "$*"; }

# Installs those of the packages that are missing. One that ends in "?" may be one that this Debian does not have.
install_packages() {
  missing='' optional=''
  for package in "$@"; do
    dpkg-query -W -f '${Status}' "${package%\?}" 2>/dev/null | grep -q 'install ok installed' && continue
    case $package in *\?) optional="$optional ${package%\?}" ;; *) missing="$missing $package" ;; esac
  done
  if [ -z "$missing$optional" ]; then
    say "All packages are installed"
    return
  fi
  sudo=
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "run as root, or install sudo" >&2; exit 1; }
    sudo="sudo"
  fi
  [ -z "$missing" ] || $sudo apt-get update -qq
  for package in $optional; do
    if [ -n "$(apt-cache policy "$package")" ]; then missing="$missing $package"; else say "This Debian has no $package"; fi
  done
  [ -n "$missing" ] || return 0
  say "Installing:$missing"
  # shellcheck disable=SC2086 # a list of words
  $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
}

# shellcheck disable=SC2034 # used where this is sourced
build_packages="g++ cmake ninja-build pkg-config libglm-dev libeigen3-dev libstb-dev nlohmann-json3-dev
  libopenexr-dev libpng-dev libcli11-dev libfmt-dev libglfw3-dev libimgui-dev? libegl-dev libgl-dev libosmesa6? libegl1 libegl-mesa0
  libgl1-mesa-dri libglx-mesa0"
# shellcheck disable=SC2034
test_packages="catch2 libembree-dev python3-numpy python3-matplotlib"
# For tests/run.sh --all: sanitizers, lint, the reference compiler of GLSL, X, Windows, a browser, Slurm and OGRE. Debian 12 and 13
# both have this version of Clang: formats and findings differ from one to the next.
clang_version=19
# shellcheck disable=SC2034
all_packages="clang-$clang_version llvm-$clang_version clang-format-$clang_version clang-tidy-$clang_version
  libclang-rt-$clang_version-dev glslang-tools xvfb xauth g++-mingw-w64-x86-64 wine wine64 chromium munge slurmctld slurmd
  slurm-client ffmpeg xz-utils xdotool libogre-1.12-dev?"
