#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Runs a command with a Slurm cluster of this one machine: munged, slurmctld and slurmd with configuration, keys, state and
# logs of their own in a temporary folder, on free ports, gone when the command ends. For tests of workflows; needs no root.
#   scripts/slurm_here.sh [--cpus N] [--keep FOLDER] COMMAND ...
# Exit code 77: slurm-wlm or munge is not installed.
set -euo pipefail

cpus=$(nproc)
folder=
while [[ ${1:-} == --* ]]; do
  case $1 in
    --cpus) cpus=$2 ;;
    --keep) folder=$2 ;;
    *) echo "slurm_here.sh: unknown option $1" >&2; exit 2 ;;
  esac
  shift 2
done
PATH=$PATH:/usr/sbin:/sbin
for program in munged slurmctld slurmd sbatch; do
  command -v "$program" >/dev/null || { echo "slurm_here.sh: $program is missing (packages slurm-wlm, munge)" >&2; exit 77; }
done

daemons=()
stop() {
  for pid in "${daemons[@]}"; do kill "$pid" 2>/dev/null || true; done
  for pid in "${daemons[@]}"; do wait "$pid" 2>/dev/null || true; done
  [ -z "${temporary:-}" ] || rm -rf "$temporary"
}
trap stop EXIT
if [ -z "$folder" ]; then
  temporary=$(mktemp -d /tmp/slurm-XXXXXX)  # short: the names of sockets have a limit
  folder=$temporary
fi
mkdir -p "$folder"/{munge,state,spool}
folder=$(cd "$folder" && pwd)
chmod 755 "$folder" "$folder/munge"

start() {  # NAME COMMAND ...: in its foreground, with its output in a file
  local name=$1
  shift
  "$@" >"$folder/$name.out" 2>&1 &
  daemons+=($!)
}

(umask 077 && head -c 1024 /dev/urandom >"$folder/munge/key")
start munged munged --foreground --force --key-file="$folder/munge/key" --socket="$folder/munge/socket" \
  --pid-file="$folder/munge/pid" --log-file="$folder/munge/log" --seed-file="$folder/munge/seed" --num-threads=2

free_ports() {
  python3 -c 'import socket
sockets = [socket.socket() for _ in range(2)]
for s in sockets: s.bind(("127.0.0.1", 0))
print(*(s.getsockname()[1] for s in sockets))'
}
read -r controller_port node_port < <(free_ports)
user=$(id -un)
host=$(hostname -s)
memory=$(($(awk '/MemTotal/ { print $2 }' /proc/meminfo) / 1024 * 9 / 10))
cat >"$folder/slurm.conf" <<END
ClusterName=here
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$controller_port
SlurmdPort=$node_port
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
CredType=cred/munge
AuthInfo=socket=$folder/munge/socket
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
# No control groups: they may not be there, and belong to the machine.
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/linux
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SchedulerType=sched/backfill
SchedulerParameters=sched_min_interval=100000,batch_sched_delay=0,defer
ReturnToService=2
KillWait=5
MinJobAge=300
NodeName=$host NodeAddr=127.0.0.1 CPUs=$cpus RealMemory=$memory State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
END
export SLURM_CONF=$folder/slurm.conf
start slurmctld slurmctld -D -c
start slurmd slurmd -D -N "$host"

for _ in $(seq 150); do
  if sinfo --noheader --format=%T 2>/dev/null | grep -qx idle; then ready=1; break; fi
  sleep 0.2
done
if [ -z "${ready:-}" ]; then
  echo "slurm_here.sh: the cluster did not start" >&2
  tail -n 5 "$folder"/*.out "$folder/munge/log" >&2
  exit 1
fi
"$@"
