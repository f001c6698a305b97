#!/bin/sh
# samples/cluster on a real Slurm: an animation with two tasks killed has the frames of one plain run, bit for bit.
#   test.sh BIN_FOLDER SCENE [FRAMES [SIZE]]
# Exit status 77: skipped, since a package is missing.
# shellcheck disable=SC2030,SC2031 # what is set for one command in a subshell is meant to end there
set -eu
bin=$(cd "$1" && pwd) scene=$(realpath "$2") frames=${3:-24} size=${4:-160x90}
here=$(cd "$(dirname "$0")" && pwd)
cluster=$(cd "$here/../../samples/cluster" && pwd)
# shellcheck source=tests/cluster/slurm.sh
. "$here/slurm.sh"
export PATH="$PATH:/usr/sbin:/sbin"

for program in munged slurmctld slurmd sbatch ffmpeg ffprobe python3; do
  command -v "$program" >/dev/null && continue
  echo "SKIPPED: no test of samples/cluster: $program is missing" >&2
  echo "Debian's packages: munge slurmctld slurmd slurm-client ffmpeg" >&2
  exit 77
done

work=$(mktemp -d "${TMPDIR:-/tmp}/tyndall-cluster-XXXXXX")
# shellcheck disable=SC2329 # called by a trap
end() {
  status=$?
  trap - EXIT
  stop_slurm
  if [ "$status" -eq 0 ]; then
    rm -rf "$work"
  else
    echo "FAILED; all that it wrote is in $work" >&2
  fi
  exit "$status"
}
trap end EXIT
trap 'exit 130' HUP INT TERM
cd "$work"
export XDG_CACHE_HOME="$work/cache"
mkdir "$work/slurm"
last=$((frames - 1)) tasks=4 status=0

say() { printf '%s  %s\n' "$(date +%T)" "$*"; }
die() {
  echo "$*" >&2
  exit 1
}
require() { "$@" || die "not so: $*"; }

# refused STATUS LINE COMMAND...: the command ends with the status and one line on standard error, which holds LINE.
refused() {
  wanted=$1 line=$2 status=0
  shift 2
  "$@" >refused.out 2>refused.err || status=$?
  if [ "$status" -ne "$wanted" ] || [ "$(wc -l <refused.err)" -ne 1 ] || ! grep -qF -- "$line" refused.err; then
    cat refused.out refused.err >&2
    die "status $status; wanted $wanted and the line \"$line\" of: $*"
  fi
}

# film OUT [OPTION...]: what a user types.
film() {
  out=$1
  shift
  "$cluster/submit.py" film "$scene" --frames "0-$last" --tasks "$tasks" --out "$out" --exr --bin "$bin" "$@" \
    -- --size "$size" --shadow-size 512
}

# render OPTION...: the same by hand.
render() { "$bin/tyndall-render" "$scene" --frames "0-$last" --size "$size" --shadow-size 512 "$@"; }

drawn_of() { # how many EXRs there are of a task's share
  find out/frames -name '[0-9]*.exr' 2>/dev/null | sed 's/.*\///; s/^0*\(.\)/\1/; s/\.exr//' |
    awk -v tasks=$tasks -v task="$1" '$1 % tasks == task - 1' | wc -l
}
is_midway() { [ "$(drawn_of "$1")" -ge $((frames / tasks / 3)) ]; }
is_killable() { is_midway "$1" && [ "$(drawn_of "$1")" -lt $((frames / tasks)) ]; }
state_of() { scontrol show job "$1" | sed -n 's/.*JobState=\([A-Z]*\).*/\1/p'; }
is_requeued() { scontrol show job "$1" | grep -q 'Restarts=1' && [ "$(state_of "$1")" = PENDING ]; }
last_job() { sed -n 's/.*; job \([0-9]*\): the .*/\1/p' "$1"; }
array_job() { sed -n 's/^job \([0-9]*\):.*/\1/p' "$1"; }

# ----------------------------------------------------------------------------------------------------------------------
say "what is refused before Slurm is asked"
submit=$cluster/submit.py
python=$(python3 -c 'import sys; print(sys.executable)')
mkdir locked foreign another damaged empty_path
chmod 555 locked
echo mine >foreign/file
echo '{"kind": "regress"}' >another/tyndall.json
echo '{"kind": ' >damaged/tyndall.json
refused 1 "nothing.glb: cannot be read: No such file" \
  "$submit" film nothing.glb --frames 0-9 --tasks 2 --out out --bin "$bin"
refused 1 "locked: cannot be written: it is write-protected" film locked
refused 1 "foreign/file: cannot be written: it is no folder" film foreign/file/out
refused 1 "foreign: is not empty, and no folder of submit.py's" film foreign
refused 1 'another: was made with kind "regress", not "film"' film another
refused 1 "damaged/tyndall.json: is damaged" film damaged
refused 1 "tyndall-render: cannot be run" film out --bin /nowhere
refused 2 "argument --frames: 9-3: must be FIRST-LAST" "$submit" film "$scene" --frames 9-3 --tasks 2 --out out
refused 2 "argument --tasks: 0: must be a whole number" "$submit" film "$scene" --frames 0-9 --tasks 0 --out out
refused 2 "argument --film: a.gif: must be a file's name that ends in .mp4 or .webm" film out --film a.gif
refused 2 "must not hold %" film out%A
refused 2 "--stats: is set by submit.py" "$submit" film "$scene" --frames 0-9 --tasks 2 --out out -- --stats s.json
refused 2 "--technique: guess not in" "$submit" film "$scene" --frames 0-9 --tasks 2 --out out --bin "$bin" -- --technique guess
refused 1 "Slurm's squeue is not found" env PATH="$work/empty_path" "$python" "$submit" film "$scene" \
  --frames 0-9 --tasks 2 --out out --bin "$bin"
require test "$(find foreign another damaged | sort | tr '\n' ' ')" = \
  "another another/tyndall.json damaged damaged/tyndall.json foreign foreign/file "

film out --dry-run >dry
require grep -q "^sbatch .*--array=1-4 .*/task.sh 4 .*/tyndall-render " dry
require grep -q "^sbatch .*--dependency=afterany:ARRAY .*/film.sh " dry
require test ! -e out

# ----------------------------------------------------------------------------------------------------------------------
say "one plain run of $frames frames"
mkdir plain
render --out plain/%04d.png --out plain/%04d.exr

say "a Slurm of one node"
start_slurm "$work/slurm" 2 || die "no Slurm"

say "two of four tasks are killed"
film out >submitted
cat submitted
array=$(array_job submitted)
refused 1 "jobs still work on it" film out
# The first: its process, by the kernel for want of memory, say. Slurm runs it again.
wait_until 300 "the first task's frames" is_midway 1
require is_killable 1
process=$(pgrep -f "^$bin/tyndall-render .*$work/out/frames/.* --share 1/4 ")
kill -KILL "$process"
say "task 1 was killed with $(drawn_of 1) frames drawn"
wait_until 60 "its second run" is_requeued "${array}_1"
scontrol update "JobId=${array}_1" StartTime=now # and not in two minutes
# The third: all of it, by a user. It is gone.
wait_until 300 "the third task's frames" is_midway 3
require is_killable 3
scancel --signal=KILL "${array}_3"
say "task 3 was killed with $(drawn_of 3) frames drawn"
wait_until 1800 "the jobs" is_idle
require test "$(state_of "$(last_job submitted)")" = FAILED
require grep -q "ended with 137" "out/log/task-${array}_1.log"
require test "$(drawn_of 1)" -eq $((frames / tasks))
require test "$(drawn_of 3)" -lt $((frames / tasks))

say "the last job names what is missing"
missing=$(render --out out/frames/%04d.png --out out/frames/%04d.exr --missing) && die "nothing is missing"
log=out/log/film-$(last_job submitted).log
cat "$log"
require grep -qF "film: $work/out: frames $missing are missing or not whole" "$log"
require test ! -e out/film.mp4
require test -z "$(find out -name '.*' ! -name .)"

say "a whole frame is cut, another damaged; submitted again by the line that it gave"
head -c 1000 plain/0001.exr >out/frames/0001.exr
head -c -1 plain/0004.png >out/frames/0004.png
# A task may have been killed between the two files of a frame.
find out/frames -type f ! -name 0001.\* ! -name 0004.\* -printf '%i %f\n' | sort >there
while read -r inode name; do
  [ ! -f "out/frames/${name%.*}.exr" ] || [ ! -f "out/frames/${name%.*}.png" ] || echo "$inode $name"
done <there >kept
sed -n 's/^film: this renders them and no others: //p' "$log" >again.sh
sh again.sh >submitted
cat submitted
wait_until 1800 "the jobs" is_idle
cat "out/log/film-$(last_job submitted).log"
require test "$(state_of "$(last_job submitted)")" = COMPLETED

say "the same files, bit for bit"
require diff -r plain out/frames
require test "$(find out/frames -type f | wc -l)" -eq $((2 * frames))
find out/frames -type f -printf '%i %f\n' | sort >now
require test -z "$(comm -23 kept now)" # whole frames are the files that they were
require test -z "$(find out -name '.*' ! -name .)"
counted=$(ffprobe -v error -count_frames -show_entries stream=nb_read_frames -of csv=p=0 out/film.mp4)
require test "${counted%,}" = "$frames"

# ----------------------------------------------------------------------------------------------------------------------
say "another run's folder"
(size=64x64 && refused 1 "out: was made with options" film out)
cp "$scene" other.glb
(scene=other.glb && refused 1 "out: was made with other contents of other.glb" film out)
require diff -r plain out/frames

say "a queue that refuses"
refused 1 "sbatch failed: " film out --sbatch=--partition=none
require is_idle

say "a scene that cannot be read: the tasks say so, and so does the last job"
echo "no glTF" >broken.glb
(scene=broken.glb && film broken) >submitted
wait_until 120 "the jobs" is_idle
require test "$(state_of "$(last_job submitted)")" = FAILED
require grep -q "broken: frames 0-$last are missing or not whole" broken/log/film-*.log
require grep -q "tyndall-render: .*broken.glb" broken/log/task-*_1.log

# ----------------------------------------------------------------------------------------------------------------------
# shellcheck source=tests/cluster/regress.sh
. "$here/regress.sh"
say "passed"
