#!/bin/sh
# Runs the README's two commands, or COMMAND..., on a copy of the working tree in a bare Debian, made by debootstrap:
#   sh tests/bare.sh [--release bookworm|trixie] [--folder FOLDER] [--mirror URL] [--keep] [COMMAND...]
# Needs root. The mounts and processes of the chroot have namespaces of their own: they end with it, however it ends.
# Without --keep the folder (a new one unless given) is removed; with it, a folder that exists is entered again.
set -eu
cd "$(dirname "$0")/.."
# shellcheck source=samples/setup.sh
. samples/setup.sh

release=trixie folder='' mirror=http://deb.debian.org/debian keep=''
fail() { echo "bare.sh: $*" >&2; exit 2; }
while [ $# -gt 0 ]; do
  case $1 in
  --release | --folder | --mirror)
    [ $# -gt 1 ] || fail "$1: a value must follow"
    case $1 in --release) release=$2 ;; --folder) folder=$2 ;; --mirror) mirror=$2 ;; esac
    shift 2
    ;;
  --keep) keep=1 && shift ;;
  -*) fail "$1: must be --release, --folder, --mirror, --keep or a command" ;;
  *) break ;;
  esac
done
case $release in bookworm | trixie) ;; *) fail "--release $release: must be bookworm (Debian 12) or trixie (13)" ;; esac
[ "$(id -u)" -eq 0 ] || fail "needs root, for debootstrap and chroot"
[ $# -gt 0 ] || set -- "sh samples/run.sh" "sh tests/run.sh"

if [ -z "$folder" ]; then
  folder=$(mktemp -d /var/tmp/tyndall-bare.XXXXXX)
elif [ -e "$folder" ]; then
  [ -n "$keep" ] || fail "--folder $folder: exists; --keep enters it again"
  [ -e "$folder/etc/debian_version" ] || fail "--folder $folder: exists, and holds no Debian"
fi
# shellcheck disable=SC2317 # the trap calls it
leave() { [ -n "$keep" ] || rm -rf --one-file-system "$folder"; }
trap leave EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

# The working tree with its uncommitted changes. Build folders of an earlier run stay, and so do the times of what has not
# changed: what has is newer than all that was built from it.
copy_tree() {
  fresh=$folder/tyndall.new
  rm -rf "$fresh" && mkdir -p "$fresh" "$folder/tyndall"
  git -c core.quotePath=off ls-files --cached --others --exclude-standard | while read -r file; do
    [ ! -e "$file" ] || echo "$file"
  done | tar -cf - -T - | tar -xmf - -C "$fresh"
  for kept in "$folder"/tyndall/build* "$folder"/tyndall/out; do
    [ ! -e "$kept" ] || mv "$kept" "$fresh"
  done
  (cd "$folder/tyndall" && find . -type f) | while read -r file; do
    if cmp -s "$folder/tyndall/$file" "$fresh/$file"; then touch -r "$folder/tyndall/$file" "$fresh/$file"; fi
  done
  rm -rf "$folder/tyndall" && mv "$fresh" "$folder/tyndall"
}

if [ -e "$folder/etc/debian_version" ]; then
  say "$folder holds Debian $(cat "$folder/etc/debian_version") from before: not bare"
else
  install_packages debootstrap
  say "debootstrap $release into $folder"
  debootstrap --variant=minbase "$release" "$folder" "$mirror" >"$folder.log" 2>&1 || { tail "$folder.log" >&2; exit 1; }
  rm "$folder.log"
fi
copy_tree

# shellcheck disable=SC2016 # the inner shell expands them
enter='mount -t proc proc "$1/proc" && mount -t devpts devpts "$1/dev/pts" && \
  mount -t tmpfs -o mode=1777 tmpfs "$1/dev/shm" && exec chroot "$1" \
  env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin sh -c "cd /tyndall && $2"'
status=0 times=''
for command in "$@"; do
  say "Debian $(cat "$folder/etc/debian_version"): $command"
  start=$(date +%s) result=passed
  unshare --mount --pid --fork --kill-child sh -c "$enter" enter "$folder" "$command" || { result="FAILED ($?)" status=1; }
  seconds=$(($(date +%s) - start))
  times="$times$(printf '%3d min %02d s  %s  %s' $((seconds / 60)) $((seconds % 60)) "$result" "$command")
"
done
say "Debian $(cat "$folder/etc/debian_version"), $(nproc) cores"
printf '%s' "$times"
exit $status
