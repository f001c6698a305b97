# Read by the tests of gpu.sh: from here on they are in a folder of their own, $work, which stays if one fails.
work=$(mktemp -d "${TMPDIR:-/tmp}/tyndall-gpu-test-XXXXXX")
# shellcheck disable=SC2329 # called by a trap
end() {
  status=$?
  trap - EXIT
  if [ "$status" -eq 0 ]; then rm -rf "$work"; else echo "FAILED; all that it wrote is in $work" >&2; fi
  exit "$status"
}
trap end EXIT
trap 'exit 130' HUP INT TERM
cd "$work"
