# Sourced by samples/run.sh and tests/run.sh: installs what the build needs on Debian 12 and 13, if anything is missing.
# Takes the packages as arguments of install_packages.

say() { printf '\n== %s\n' "$*"; }

install_packages() {
  missing=
  for package in "$@"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing="$missing $package"
  done
  if [ -z "$missing" ]; then
    say "All packages are installed"
    return
  fi
  say "Installing:$missing"
  sudo=
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "run as root, or install sudo" >&2; exit 1; }
    sudo="sudo"
  fi
  $sudo apt-get update -qq
  # shellcheck disable=SC2086 # a list of words
  $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends $missing >/dev/null
}

# shellcheck disable=SC2034 # used where this is sourced
build_packages="g++ cmake ninja-build pkg-config libglm-dev libeigen3-dev libstb-dev nlohmann-json3-dev
  libopenexr-dev libpng-dev libcli11-dev libfmt-dev libglfw3-dev libosmesa6-dev libegl-dev libgl-dev libosmesa6 libegl1
  libegl-mesa0 libgl1-mesa-dri libglx-mesa0"
# shellcheck disable=SC2034
test_packages="clang clang-format clang-tidy libclang-rt-14-dev catch2 libembree-dev glslang-tools xvfb xauth python3-numpy
  python3-matplotlib"
