# shellcheck shell=sh
# Sourced: a Slurm of one node, this machine, that lives in a folder and ends with the test. It needs no system services
# and touches none: its own configuration, key, sockets and ports.

# start_slurm FOLDER CPUS: exports SLURM_CONF; the folder must be empty.
start_slurm() {
  slurm=$1
  user=$(id -un)
  node=$(hostname -s)
  mkdir -p "$slurm/state" "$slurm/spool" "$slurm/run"
  chmod 755 "$slurm" "$slurm/run"
  # shellcheck disable=SC2046 # three numbers
  set -- "$2" $(free_ports)
  write_slurm_conf "$@" >"$slurm/slurm.conf"
  # No control groups; before 23.02 the first version of the plugin, which does nothing unless it is asked.
  case $(slurmd -V) in
    *" 2"[0-2].*) echo "CgroupPlugin=cgroup/v1" ;;
    *) echo "CgroupPlugin=disabled" ;;
  esac >"$slurm/cgroup.conf"
  export SLURM_CONF="$slurm/slurm.conf"

  (umask 077 && head -c 128 /dev/urandom >"$slurm/munge.key")
  munged --foreground --force --key-file="$slurm/munge.key" --socket="$slurm/run/munge" --num-threads=2 \
    --pid-file="$slurm/run/munged.pid" --seed-file="$slurm/munge.seed" 2>"$slurm/munged.err" &
  munged_pid=$!
  wait_until 20 "munged" test -S "$slurm/run/munge" || return 1
  slurmctld -D -c 2>"$slurm/slurmctld.err" &
  slurmctld_pid=$!
  wait_until 30 "slurmctld" sh -c 'scontrol ping | grep -q "is UP"' || return 1
  slurmd -D -c 2>"$slurm/slurmd.err" &
  slurmd_pid=$!
  wait_until 30 "slurmd" sh -c 'sinfo --noheader --format=%T | grep -q idle'
}

# Ends it, jobs first; what was not started is passed over.
stop_slurm() {
  [ -z "${slurmctld_pid:-}" ] || scancel --me --quiet 2>/dev/null || true
  [ -z "${slurmctld_pid:-}" ] || wait_until 30 "the last jobs" is_idle || true
  for pid in "${slurmd_pid:-}" "${slurmctld_pid:-}" "${munged_pid:-}"; do
    [ -z "$pid" ] || kill "$pid" 2>/dev/null || true
  done
  for pid in "${slurmd_pid:-}" "${slurmctld_pid:-}" "${munged_pid:-}"; do
    [ -z "$pid" ] || wait "$pid" 2>/dev/null || true
  done
}

is_idle() { [ -z "$(squeue --noheader)" ]; }

free_ports() {
  python3 -c '
import socket
sockets = [socket.socket() for _ in range(2)]
for each in sockets:
    each.bind(("127.0.0.1", 0))
print(*(each.getsockname()[1] for each in sockets))'
}

# write_slurm_conf CPUS PORT PORT
write_slurm_conf() {
  cat <<CONF
ClusterName=tyndall
SlurmctldHost=$node(127.0.0.1)
SlurmctldPort=$2
SlurmdPort=$3
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$slurm/run/munge
StateSaveLocation=$slurm/state
SlurmdSpoolDir=$slurm/spool
SlurmctldPidFile=$slurm/run/slurmctld.pid
SlurmdPidFile=$slurm/run/slurmd.pid
SlurmctldLogFile=$slurm/slurmctld.log
SlurmdLogFile=$slurm/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
SchedulerParameters=batch_sched_delay=0,sched_interval=1,bf_interval=1
KillWait=2
ReturnToService=2
SlurmdParameters=config_overrides
NodeName=$node NodeAddr=127.0.0.1 CPUs=$1 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
}

# wait_until SECONDS WHAT COMMAND...: until the command succeeds.
wait_until() {
  polls=$(($1 * 10)) what=$2
  shift 2
  while ! "$@" >/dev/null 2>&1; do
    polls=$((polls - 1))
    [ "$polls" -gt 0 ] || { echo "waited in vain for $what" >&2; return 1; }
    sleep 0.1
  done
}
