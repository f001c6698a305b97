# shellcheck shell=sh disable=SC2154 # of test.sh
# Sourced by test.sh, in its folder and with its Slurm: a list of cases whose third task does not run at first.
say "a regression list"
cat >list.json <<'LIST'
{"format": 1,
 "defaults": {"options": {"size": "64x36", "shadow-size": 256}},
 "cases": [{"name": "one", "scene": "scene.glb"},
           {"name": "two", "scene": "scene.glb", "options": {"technique": "tree"}},
           {"name": "three", "scene": "scene.glb", "options": {"technique": "exact"}},
           {"name": "four", "scene": "scene.glb", "options": {"frames": "3-4"}}]}
LIST
mkdir scenes
cp "$scene" scenes/scene.glb
regress() {
  out=$1
  shift
  "$submit" regress list.json --references references --scenes scenes --tasks 3 --out "$out" --bin "$bin" "$@"
}

refused 1 "--references references: no such folder" regress checked
"$bin/tyndall-regress" record list.json --references references --scenes scenes
refused 1 'out: was made with kind "film", not "regress"' regress out
refused 2 "--only: is set by submit.py" regress checked -- --only one

regress checked --sbatch=--hold >submitted
cat submitted
scancel "$(array_job submitted)_3"
scontrol release "$(array_job submitted)" "$(last_job submitted)"
wait_until 300 "the jobs" is_idle
log=checked/log/report-$(last_job submitted).log
cat "$log"
require test "$(state_of "$(last_job submitted)")" = FAILED
require grep -q "three" "$log"
sed -n 's/^report: this renders cases that are missing and no others: //p' "$log" | sed 's/ --sbatch=--hold//' >again.sh
sh again.sh >submitted
wait_until 300 "the jobs" is_idle
cat "checked/log/report-$(last_job submitted).log"
require test "$(state_of "$(last_job submitted)")" = COMPLETED
require test -s checked/results/report.html
"$bin/tyndall-regress" check list.json --references references --scenes scenes --out alone >alone.out 2>&1
require test "$(cd checked/results && find . | sort)" = "$(cd alone && find . | sort)"
