# shellcheck shell=sh disable=SC2154 # sourced by gpu.sh
# Where tools, scenes and libraries are: in a build, or in a bundle, which is unpacked for the time of a run.

scratch='' running=''
# shellcheck disable=SC2329 # called by a trap
leave() {
  status=$?
  trap - EXIT HUP INT TERM
  if [ -n "$running" ]; then
    kill "$running" 2>/dev/null || :
    wait "$running" 2>/dev/null || :
  fi
  [ -z "$scratch" ] || rm -rf "$scratch"
  exit "$status"
}

make_scratch() {
  scratch=$(mktemp -d "${TMPDIR:-/tmp}/tyndall-gpu.XXXXXX") || stop "${TMPDIR:-/tmp}: no folder can be made there; TMPDIR names another"
  trap leave EXIT
  trap 'exit 129' HUP
  trap 'exit 130' INT
  trap 'exit 143' TERM
}

# Sets bin, scenes, cases, references (empty: to be recorded).
find_places() {
  make_scratch
  if [ -f "$here/payload.tar.xz" ]; then
    unpack_bundle
  else
    build=${build:-$here/../build}
    [ -x "$build/bin/tyndall-gpu" ] || stop "$build/bin/tyndall-gpu: is not there; build the project, by sh tests/run.sh, or name its folder by --build"
    build=$(cd "$build" && pwd)
    bin=$build/bin scenes=$build/scenes cases=$here/../samples/regress/cases.json references=''
  fi
  find_driver
  choose_libraries
  # Nothing but EGL, and nothing of a screen.
  unset DISPLAY WAYLAND_DISPLAY
  export TYNDALL_TEST_CONTEXT=egl TYNDALL_FAILED_DIR="$scratch/failed"
}

unpack_bundle() {
  [ -z "$build" ] || usage "--build $build: this is a bundle, which has its own"
  LD_LIBRARY_PATH="$here/xz" "$here/xz/xz" --version >"$scratch/xz" 2>&1 ||
    stop "the bundle cannot run here: $(tail -n 1 "$scratch/xz"); its README says what it needs"
  say "Unpacking the bundle into $scratch"
  LD_LIBRARY_PATH="$here/xz" "$here/xz/xz" -dc "$here/payload.tar.xz" | tar -xf - -C "$scratch" ||
    stop "$scratch: the bundle cannot be unpacked there; is the disk full? TMPDIR names another folder"
  bin=$scratch/bin scenes=$scratch/scenes cases=$scratch/cases.json references=$scratch/references
  export TYNDALL_BUNDLE="$scratch"
}

library_folders="/lib/x86_64-linux-gnu /usr/lib/x86_64-linux-gnu /usr/local/nvidia/lib64 /usr/local/nvidia/lib /lib64 /usr/lib64 /usr/local/lib64 /usr/local/lib /usr/lib"

# The path of a library of the system's, or nothing.
library() {
  found=$(ldconfig -p 2>/dev/null || /sbin/ldconfig -p 2>/dev/null || :)
  found=$(printf '%s\n' "$found" | sed -n "s|^[[:space:]]*$1 (.*x86-64.*) => ||p" | head -n 1)
  if [ -z "$found" ]; then
    for folder in $(printf '%s' "${LD_LIBRARY_PATH:-}" | tr ':' ' ') $library_folders; do
      [ -z "$found" ] && [ -e "$folder/$1" ] && found=$folder/$1
    done
  fi
  printf '%s' "$found"
}

# A container may have NVIDIA's libraries where the loader does not look, and without the file that tells libEGL of them.
find_driver() {
  for folder in /usr/local/nvidia/lib64 /usr/local/nvidia/lib; do
    if [ -d "$folder" ]; then export LD_LIBRARY_PATH="${LD_LIBRARY_PATH:+$LD_LIBRARY_PATH:}$folder"; fi
  done
  if [ -n "${__EGL_VENDOR_LIBRARY_FILENAMES:-}${__EGL_VENDOR_LIBRARY_DIRS:-}" ]; then return 0; fi
  nvidia=$(library libEGL_nvidia.so.0)
  [ -n "$nvidia" ] || return 0
  vendors=''
  for file in /etc/glvnd/egl_vendor.d/*.json /usr/share/glvnd/egl_vendor.d/*.json; do
    [ -e "$file" ] || continue
    if grep -q libEGL_nvidia "$file"; then return 0; fi
    vendors=$vendors:$file
  done
  say "libEGL is told of $nvidia: no file of the system's does"
  printf '{"file_format_version": "1.0.0", "ICD": {"library_path": "%s"}}\n' "$nvidia" >"$scratch/nvidia.json"
  export __EGL_VENDOR_LIBRARY_FILENAMES="$scratch/nvidia.json$vendors"
}

# The bundle's libraries: those that a driver may load, too, only where the system has none, or too old ones.
choose_libraries() {
  if [ -n "${TYNDALL_BUNDLE:-}" ]; then
    before=${LD_LIBRARY_PATH:-}
    mkdir "$scratch/chosen"
    for file in "$scratch"/shared/*; do
      [ -n "$(library "${file##*/}")" ] || ln -s "$file" "$scratch/chosen/"
    done
    if [ -z "$(library libEGL.so.1)" ] && [ -d "$scratch/glvnd" ]; then
      say "The system has no libEGL.so.1: the bundle's dispatcher is used, which looks for a driver"
      ln -s "$scratch"/glvnd/* "$scratch/chosen/"
    fi
    export LD_LIBRARY_PATH="$scratch/lib:$scratch/chosen${before:+:$before}"
    is_runnable || export LD_LIBRARY_PATH="$scratch/lib:$scratch/shared:$scratch/chosen${before:+:$before}"
  fi
  is_runnable || stop "the tools cannot run: $(head -n 1 "$scratch/loader")$([ ! -f "$scratch/needs" ] || sed 's/^/; needed: /' "$scratch/needs")"
}

is_runnable() {
  for tool in tyndall-gpu tyndall-bench tyndall-regress tyndall-gl-tests tyndall-render-tests tyndall-sequence tyndall-avsm-bench; do
    LD_BIND_NOW=1 "$bin/$tool" --help >/dev/null 2>"$scratch/loader" || return 1
  done
}
