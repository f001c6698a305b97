# shellcheck shell=sh disable=SC2154 # sourced by gpu.sh
# A folder of at most 50 MiB with all that gpu.sh needs: tools, their libraries, scenes, references and shaders, packed,
# and what unpacks them. What is GL's or the C library's is the other machine's.

most_kibibytes=51200

make_bundle() {
  [ ! -f "$here/payload.tar.xz" ] || stop "--bundle: this is a bundle; make another from a build"
  if [ -e "$bundle" ] && { [ ! -d "$bundle" ] || [ -n "$(ls -A "$bundle")" ]; }; then stop "--bundle $bundle: exists, and is no empty folder"; fi
  for program in xz strip objdump ldd; do
    command -v $program >/dev/null || stop "--bundle: $program is missing (Debian's packages xz-utils, binutils, libc-bin)"
  done
  find_places
  mkdir -p "$bundle" 2>/dev/null || stop "--bundle $bundle: cannot be made"
  bundle=$(cd "$bundle" && pwd)
  payload=$scratch/payload
  gather_tools
  gather_data
  say "Packing"
  rm -f "$bundle/payload.new"
  (cd "$payload" && tar -cf - -- *) | xz -6 -T0 >"$bundle/payload.new" || stop "$bundle: cannot be written; is the disk full?"
  gather_unpacker
  mv "$bundle/payload.new" "$bundle/payload.tar.xz"
  kibibytes=$(du -sk "$bundle" | cut -f 1)
  [ "$kibibytes" -le $most_kibibytes ] || stop "$bundle: has $kibibytes KiB, of at most $most_kibibytes"
  say "Done: $bundle, $kibibytes KiB, for x86-64 Linux with $(cat "$payload/needs"): sh $bundle/gpu.sh"
}

# Libraries that an ELF file needs, but those of GL and of the C library.
libraries_of() {
  ldd "$@" | sed -n 's/^.* => \(\/[^ ]*\) (0x.*/\1/p' | sort -u |
    grep -Ev '/(ld-linux|libc|libm|libdl|libpthread|librt|libresolv|libGL|libGLX|libEGL|libOpenGL|libGLdispatch|libOSMesa)[-.0-9a-zA-Z_]*\.so' || :
}

# The newest version of the C library that files ask for.
newest_libc() { objdump -T "$@" | sed -n 's/.*GLIBC_\([0-9.]*\).*/\1/p' | sort -uV | tail -n 1; }

gather_tools() {
  mkdir -p "$payload/bin" "$payload/lib" "$payload/shared" "$payload/glvnd"
  for tool in tyndall-gpu tyndall-bench tyndall-regress tyndall-gl-tests tyndall-render-tests tyndall-sequence tyndall-avsm-bench; do
    [ -x "$bin/$tool" ] || stop "$bin/$tool: is not there; build the project"
    strip -o "$payload/bin/$tool" "$bin/$tool"
  done
  libraries_of "$payload"/bin/* >"$scratch/libraries"
  while read -r file; do
    # What a driver may load, too, must be the system's where it has it.
    case ${file##*/} in
    libstdc++.so* | libgcc_s.so* | libz.so* | libX* | libxcb* | libbsd.so* | libmd.so* | libdrm* | libexpat* | libzstd*) to=shared ;;
    *) to=lib ;;
    esac
    cp -L "$file" "$payload/$to/"
  done <"$scratch/libraries"
  # The dispatcher, which is no driver: where a container has NVIDIA's libEGL_nvidia and nothing that finds it.
  for name in libEGL.so.1 libGLdispatch.so.0; do
    file=$(library $name)
    [ -z "$file" ] || cp -L "$file" "$payload/glvnd/"
  done
  [ -e "$payload/glvnd/libGLdispatch.so.0" ] || rm -rf "$payload/glvnd"
  echo "glibc $(newest_libc "$payload"/bin/* "$payload"/lib/*) or newer ($(newest_libc "$payload"/shared/*) where it has no C++ library as new)" >"$payload/needs"
}

gather_data() {
  cp -r "$scenes" "$payload/scenes"
  cp "$cases" "$payload/cases.json"
  cp -r "$here/bench/baselines" "$payload/baselines"
  cp -r "$here/bench/avsm/shaders" "$payload/rivals"
  cp -r "$here/../glsl" "$payload/glsl"
  "$bin/tyndall-gpu" commit >"$payload/commit"
  say "References, by OSMesa"
  if "$bin/tyndall-regress" record "$cases" --scenes "$scenes" --references "$payload/references" --context osmesa \
    --jobs "$(nproc)" >"$scratch/record" 2>&1; then return 0; fi
  tail -n 1 "$scratch/record"
  say "OSMesa's references cannot be made: those that the project keeps are taken"
  rm -rf "$payload/references"
  cp -r "$here/../samples/regress/references" "$payload/references"
}

gather_unpacker() {
  mkdir -p "$bundle/gpu" "$bundle/xz"
  cp "$here/gpu.sh" "$bundle/"
  cp "$here"/gpu/*.sh "$here/gpu/plots.py" "$here/bench/plot.py" "$here/bench/report.py" "$bundle/gpu/"
  rm -f "$bundle/gpu/test.sh" "$bundle/gpu/bundle_test.sh"
  cp -L "$(command -v xz)" "$bundle/xz/"
  libraries_of "$bundle/xz/xz" | while read -r file; do cp -L "$file" "$bundle/xz/"; done
  cat >"$bundle/README" <<README
Tyndall's check of a GPU, commit $(cat "$payload/commit"). It needs x86-64 Linux with $(cat "$payload/needs"), a driver of
OpenGL 4.3 or later with EGL, 300 MB of \${TMPDIR:-/tmp} while it runs, and nothing installed:

    sh gpu.sh --out DIR        at most eight minutes; DIR then has at most eight files, the first to read is report.md

sh gpu.sh --help lists more. Debian 12 has such a C library, as has all that is newer.
README
}
