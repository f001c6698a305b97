#!/bin/sh
# gpu.sh as a user meets it, with tools that hang, fail or fill the disk in the place of those that measure.
#   test.sh BIN_FOLDER [FOLDER_OF_FAKE_EGL]
# shellcheck disable=SC2030,SC2031 # what is set for one command in a subshell is meant to end there
set -eu
real=$(cd "$1" && pwd) fake_egl=${2:+$(cd "$2" && pwd)}
here=$(cd "$(dirname "$0")" && pwd)
gpu=$(dirname "$here")/gpu.sh

# shellcheck source=tests/gpu/scratch.sh
. "$here/scratch.sh"

say() { printf '%s  %s\n' "$(date +%T)" "$*"; }
die() {
  echo "$*" >&2
  [ ! -f out.log ] || cat out.log >&2
  exit 1
}
require() { "$@" || die "not so: $*"; }
has() { grep -qF -- "$2" "$1" || die "$1 lacks: $2"; }

# refused STATUS LINE COMMAND...: it ends with the status, and says the line on standard error.
refused() {
  wanted=$1 line=$2 status=0
  shift 2
  "$@" >refused.out 2>refused.err || status=$?
  if [ "$status" -ne "$wanted" ] || ! grep -qF -- "$line" refused.err || [ "$(wc -l <refused.err)" -gt 2 ]; then
    cat refused.out refused.err >&2
    die "status $status; wanted $wanted and the line \"$line\" of: $*"
  fi
}

# A build whose tools are scripts. Who draws is what COMMIT and DRIVER say; the report is made by the real tool.
mkdir -p build/bin build/scenes
cat >build/bin/tyndall-gpu <<STUB
#!/bin/sh
case \$1 in
who)
  cat >"\$3" <<JSON
{
  "commit": "\${COMMIT:-abc123}",
  "date": "2026-01-01T00:00:00Z",
  "driver": "\${DRIVER:-ACME, Card 7, OpenGL 4.6}",
  "software": false,
  "display": "device 0: ACME",
  "vendor": "ACME",
  "renderer": "Card 7",
  "version": "4.6",
  "glsl": "4.60",
  "processor": "P",
  "cores": 2,
  "memory_gib": 4.0,
  "system": "S",
  "devices": [],
  "limits": {},
  "extensions": {}
}
JSON
  ;;
report) exec "$real/tyndall-gpu" "\$@" ;;
esac
STUB
for tool in tyndall-bench tyndall-regress tyndall-gl-tests tyndall-render-tests tyndall-avsm-bench; do
  printf '#!/bin/sh\nexit 0\n' >build/bin/$tool
done
# What it does is a file's: hang, fail, fill.
cat >build/bin/tyndall-sequence <<STUB
#!/bin/sh
[ "\$1" != --help ] || exit 0
echo "\$1" >>"$work/called"
if [ -f "$work/hang" ]; then
  echo "\$\$" >"$work/hanging"
  exec sleep 1000
fi
if [ -f "$work/fail" ]; then
  echo "no such luck" >&2
  exit 3
fi
if [ -f "$work/fill" ]; then
  exec cat /dev/zero >"\$(cat "$work/fill")/filler"
fi
echo "# \${1##*/}, 8x8"
echo "frame,full_ms,objects_ms,detect_ms,objects_share,detect_share,objects_error,detect_error"
for frame in 0 1 2 3 4; do echo "\$frame,8,2,4,0.5,0.5,0,0"; done
STUB
chmod +x build/bin/*
run() { sh "$gpu" --build build "$@" >out.log 2>&1; }
status_of() { sed -n 's/.*"result": "\([^"]*\)".*/\1/p' "$1/status.json"; }
unpacked() { rm -rf unpacked && mkdir unpacked && tar -xzf "$1/details.tar.gz" -C unpacked; }

say "wrong usage"
refused 2 "--outside: must be one of --out" sh "$gpu" --outside
refused 2 "--out: a value must follow" sh "$gpu" --out
refused 2 "--out: must not be empty" sh "$gpu" --out ""
refused 2 "--only x: must be letters of abcde" sh "$gpu" --only x
refused 2 "--limits 0: must be a number from 0.01 to 60" sh "$gpu" --limits 0
refused 2 "--limits 1e3: must be a number" sh "$gpu" --limits 1e3
refused 2 "--full: excludes --quick" sh "$gpu" --quick --full
refused 1 "nowhere/bin/tyndall-gpu: is not there" sh "$gpu" --build nowhere
refused 1 "report.json: is not there" sh "$gpu" --plots build
refused 1 "--bundle build: exists, and is no empty folder" sh "$gpu" --build build --bundle build
sh "$gpu" --help >help
has help "sh gpu.sh --bundle DIR"

say "what cannot be gone on with"
mkdir foreign && echo mine >foreign/file
refused 1 "foreign: is not empty, and holds no report" sh "$gpu" --build build --out foreign
refused 1 "foreign/file: is no folder" sh "$gpu" --build build --out foreign/file
require test "$(find foreign)" = "foreign
foreign/file"

say "no EGL"
mkdir no-egl && : >no-egl/libEGL.so.1
LD_LIBRARY_PATH="$work/no-egl" refused 1 "context egl: libEGL.so.1 cannot be opened; is libegl1 installed?" \
  sh "$gpu" --build "$real/.." --out without --only a
require test ! -e without/report.json

say "a device that is not there"
TYNDALL_EGL_DEVICE=Voodoo refused 1 "context egl: TYNDALL_EGL_DEVICE=Voodoo: must be the number or a part of the name" \
  sh "$gpu" --build "$real/.." --out without --only a

# The devices of FakeEgl.cpp: 0 draws in software unless FAKE_RENDERER is set, 1 does not open.
if [ -n "$fake_egl" ]; then
  say "the GPU is taken, wherever it is in EGL's list, and nothing else for one"
  who() { LD_LIBRARY_PATH=$fake_egl "$real/tyndall-gpu" who --out who.json; }
  who 2>who.err
  has who.json '"display": "surfaceless"'
  has who.err "context egl: device 0: /dev/dri/card0 draws in software"
  has who.err "context egl: device 1: /dev/dri/card1 cannot be initialised"
  (export FAKE_RENDERER="Card 7" && who 2>who.err)
  has who.json '"display": "device 0: /dev/dri/card0"'
  has who.json '"software": false'
  require test ! -s who.err
  (export TYNDALL_EGL_DEVICE=card0 && who)
  has who.json '"display": "device 0: /dev/dri/card0"'
  has who.json '"software": true'
  (export TYNDALL_EGL_DEVICE=1 && refused 1 "TYNDALL_EGL_DEVICE=1: device 1: /dev/dri/card1 cannot be initialised" who)
else
  echo "SKIPPED: the choice among EGL's devices: no libEGL to wrap" >&2
fi

say "a part that hangs is ended at its limit, and the rest goes on"
touch hang
require run --out hung --only e --limits 0.1
has out.log "Reuse: pendulum: ended at its limit of 1 s"
has out.log "Smoke and hair: smoke: done"
has hung/report.md "| e-reuse-pendulum | Reuse: pendulum | killed |"
has hung/report.json '"result": "killed"'
require test ! -e "/proc/$(cat hanging)"
rm hang
: >called
require run --out hung --only e --limits 0.1
has out.log "Reuse: pendulum: kept"
require test ! -s called
require run --out hung --only e --limits 0.5
has out.log "Reuse: pendulum: done"
has out.log "Smoke and hair: smoke: kept"
has hung/report.md "| pendulum.glb, 8x8 | 5 | 8 | 2 | 4 | 4× | 2× | 50 % | 0 |"

say "a case that fails, crashes or hangs takes no other with it, and is told with its first lines"
cat >cases <<STUB
#!/bin/sh
case "\$1 \$2" in
"--list-test-names-only ~[slow]") printf 'passes\nfails, with a comma\ncrashes\nhangs\n' && exit 4 ;;
"--list-test-names-only [slow]") echo slow && exit 1 ;;
esac
echo "\$1" >>"$work/called"
case \$1 in
passes | slow) echo '<testsuites><testsuite name="t" tests="1"><testcase name="p"/></testsuite></testsuites>' >"\$5" ;;
'fails\, with a comma')
  echo '<testsuites><testsuite name="t" tests="1"><testcase name="f"><failure message="m">1 &lt; 0' >"\$5"
  echo 'at Some.cpp:3</failure></testcase></testsuite></testsuites>' >>"\$5"
  exit 1
  ;;
crashes) kill -SEGV \$\$ ;;
hangs) exec sleep 100 ;;
esac
STUB
chmod +x cases
: >called
cases() { "$real/tyndall-gpu" cases "$work/cases" --out cased --jobs 3 --case-seconds 1; }
require cases
tr -d '\n' <cased/cases.json >flat
has flat '"name": "passes",      "result": "passed"'
has flat '"name": "fails, with a comma",      "result": "failed",      "message": "1 < 0\nat Some.cpp:3\n"'
has flat '"name": "crashes",      "result": "crashed",      "message": "ended by signal 11'
has flat '"name": "hangs",      "result": "killed",      "message": "took more than 1 s'
has flat '"name": "slow",      "result": "passed"'
require test "$(grep -c '<testsuite ' cased/junit.xml)" -eq 5
: >called
require cases
require test "$(cat called)" = hangs

say "few files, all of them whole"
require test "$(find hung -type f | grep -cv '\.png$')" -eq 3
require test -z "$(find hung -name '*new*')"

say "a part that fails is recorded with what it said, and run again when asked"
touch fail
require run --out failed --only e --limits 0.1
has out.log "Reuse: pendulum: FAILED (3)"
has failed/report.md "no such luck"
rm fail
: >called
require run --out failed --only e --limits 0.1
require test ! -s called
require run --out failed --only e --limits 0.1 --again
require test -s called
unpacked failed
require test "$(status_of unpacked/parts/e-reuse-pendulum)" = "done"

say "an interrupted run leaves nothing half-written, ends what it began, and goes on"
sh "$gpu" --build build --out halted --only e --limits 0.5 >out.log 2>&1 # whole
rm -rf halted/parts && mkdir -p halted && tar -xzf halted/details.tar.gz -C halted && rm halted/details.tar.gz
rm halted/parts/e-reuse-orrery/status.json halted/parts/e-reuse-sweep/status.json
touch hang && rm -f hanging
sh "$gpu" --build build --out halted --only e --limits 60 >out.log 2>&1 &
process=$!
waited=0
while [ ! -s hanging ] && [ $waited -lt 100 ]; do sleep 0.1 && waited=$((waited + 1)); done
require test -s hanging
refused 1 "halted: another gpu.sh works on it" sh "$gpu" --build build --out halted --only e --limits 60
kill -TERM "$process"
status=0
wait "$process" || status=$?
require test "$status" -eq 143
require test ! -e "/proc/$(cat hanging)"
require test ! -e halted/parts/e-reuse-orrery/status.json
require test -z "$(find halted -name '*.new')"
rm hang
: >called
require run --out halted --only e --limits 0.5
require test "$(cat called)" = "$work/build/scenes/orrery.glb
$work/build/scenes/sweep.glb"

say "a report of another commit, driver or size is refused by name"
COMMIT=def456 refused 1 "halted: holds a report of commit abc123, and this is def456" sh "$gpu" --build build --out halted
DRIVER="Other, Card 8" refused 1 "halted: holds a report of ACME, Card 7, OpenGL 4.6, and this is Other, Card 8" \
  sh "$gpu" --build build --out halted
refused 1 "halted: was begun with --full, and this is --quick" sh "$gpu" --build build --out halted --quick

say "a damaged file is left out of the report, and said"
rm -rf unpacked && cp -r halted damaged && tar -xzf damaged/details.tar.gz -C damaged && rm damaged/details.tar.gz
mkdir damaged/parts/d-01-nave
echo '{"results": [' >damaged/parts/d-01-nave/bench.json
require run --out damaged --only a
has damaged/report.md "d-01-nave\` left a damaged file"
has damaged/report.md "pendulum.glb, 8x8"

say "what is wanted of a GPU stands beside what was measured"
# result TECHNIQUE GROUP MILLISECONDS: of one setup.
result() {
  cat <<JSON
{"series": "curve", "x": 0, "scene": "nave", "size": [2560, 1600], "shadow_size": 4096, "lights": 0, "density": 1.0,
 "context": "egl", "driver": "D", "technique": "$1", "family": "$1", "group": "$2",
 "ms": {"median": $3, "min": $3, "max": $3, "runs": [$3]}, "gpu_ms": {"median": $3, "runs": [$3]}, "bytes": 1048576,
 "errors": {"exact": {"rrmse": 0.01, "p99": 0.02, "max": 0.1}}, "passes": [{"name": "light 0 march", "ms": 1.5}],
 "calls": {"restore": {"ms": 0.5, "processor_ms": 0.2}, "leave": {"ms": 0.4, "processor_ms": 0.1}, "lights": 1}}
JSON
}
mkdir -p goals/parts/a-who goals/parts/d-01-nave goals/parts/d-10-nave
build/bin/tyndall-gpu who --out goals/parts/a-who/who.json
for at in goals/parts/*; do echo '{"title": "T", "result": "done", "exit": 0, "seconds": 1, "limit": 2}' >"$at/status.json"; done
echo '{"machine": {}, "commit": "c", "date": "d", "results": [' "$(result exact exact 100)", "$(result high ours 5)", \
  "$(result balanced ours 4)" ']}' >goals/parts/d-01-nave/bench.json
echo '{"machine": {}, "commit": "c", "date": "d", "results": [' "$(result high ours 7)" ']}' >goals/parts/d-10-nave/bench.json
require "$real/tyndall-gpu" report goals
has goals/report.md "| nave 2560×1600, 4096² | high | 100 | 5 | 5 | 20× | ≥ 15× | yes | ≤ 6 | yes | 0.2 / 0.1 | yes |"
has goals/report.md "| nave 2560×1600, 4096² | balanced | 100 | 4 | 4 | 25× | ≥ 28× | no | ≤ 3.3 | no | 0.2 / 0.1 | yes |"
require test "$(grep -c '"technique": "high"' goals/report.json)" -eq 1 # what was measured first
has goals/report.md "| light 0 march | 1.5 |"

say "a full disk"
# In a namespace of its own, which its mount ends with.
cat >full.sh <<'FULL'
set -eu
mount -t tmpfs -o size=2m tmpfs small
mount -t tmpfs -o size=80m tmpfs full
status=0
sh "$1" --build build --out small/report --only e >small.log 2>&1 || status=$?
[ "$status" -eq 1 ] && grep -q "small/report: [0-9]* KiB are free there, and 65536 are needed" small.log
echo "$PWD/full" >fill
status=0
sh "$1" --build build --out full/report --only e >full.log 2>&1 || status=$?
cat full.log
[ "$status" -eq 1 ] && grep -q "full/report: the disk is full" full.log
[ -z "$(find full/report -name '*.new*')" ] && [ ! -e full/report/parts/e-reuse-pendulum/status.json ]
rm full/filler fill
sh "$1" --build build --out full/report --only e >again.log 2>&1
grep -q "Reuse: pendulum: done" again.log && [ -s full/report/report.json ]
FULL
mkdir small full
if unshare -m true 2>/dev/null; then
  unshare -m sh full.sh "$gpu" >out.log 2>&1 || die "a full disk: $(cat out.log small.log full.log again.log 2>/dev/null)"
else
  echo "SKIPPED: no full disk without the right to mount one" >&2
fi
say "passed"
