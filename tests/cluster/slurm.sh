#!/usr/bin/env bash
# Runs a suite as a job array on a real Slurm with two nodes on this machine, kills one node with SIGKILL while its shard
# runs, and compares the summary of the merged run with that of a local run.
#
#   tests/cluster/slurm.sh PROGRAM SOURCES
#
# Exit code 77: skipped, for the printed reason. Needs root, because slurmd starts jobs for users.
set -euo pipefail

program=$(readlink -f "$1")
sources=$(readlink -f "$2")

skip() { echo "skipped: $1"; exit 77; }
fail() { echo "failed: $1"; exit 1; }
say() { printf '%3d s  %s\n' "$SECONDS" "$1"; }

[[ ${SCANBENCH_CLUSTER:-} == 1 ]] || skip "SCANBENCH_CLUSTER is not 1 (.ci/cluster sets it)"
((EUID == 0)) || skip "only root can start the daemons of Slurm"
for tool in slurmctld slurmd sbatch squeue munged mungekey unshare; do
  command -v "$tool" >/dev/null || skip "$tool is not installed (tests/cluster/packages.txt)"
done
unshare --pid --fork --mount-proc true 2>/dev/null || skip "this machine has no process namespaces"

work=$(mktemp -d /tmp/scanbench-slurm-XXXXXX)
chmod 755 "$work"
daemons=()  # process ids of namespaces, each with one daemon and all that it starts
stop() {
  for pid in "${daemons[@]}"; do kill -9 "$pid" 2>/dev/null || true; done
  wait 2>/dev/null || true
  rm -rf "$work"
}
trap stop EXIT

# A daemon in a process namespace of its own: when that is killed, so is all that the daemon has started.
start() {  # name command...
  local name=$1
  shift
  setsid unshare --pid --fork --kill-child --mount-proc "$@" >"$work/$name.out" 2>&1 &
  daemons+=($!)
  declare -g "pid_$name=$!"
}

# --- a Slurm of two nodes -----------------------------------------------------------------------------------------
port=$((20000 + RANDOM % 10000))
host=$(hostname -s)
mkdir "$work/munge" "$work/state"
mungekey --create --keyfile="$work/munge/key"
export SLURM_CONF=$work/slurm.conf
cat >"$SLURM_CONF" <<CONF
ClusterName=scanbench
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket,cred_expire=15
MpiDefault=none
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
SlurmctldPort=$port
SlurmctldPidFile=$work/slurmctld.pid
SlurmctldLogFile=$work/slurmctld.log
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool.%n
SlurmdPidFile=$work/slurmd.%n.pid
SlurmdLogFile=$work/slurmd.%n.log
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
JobCompType=jobcomp/none
SchedulerParameters=batch_sched_delay=0,sched_min_interval=0,bf_interval=1
SlurmdTimeout=10
SlurmdParameters=config_overrides
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 RealMemory=1000
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 RealMemory=1000
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
CONF
start munged munged --foreground --force --key-file="$work/munge/key" --socket="$work/munge/socket" \
  --pid-file="$work/munge/pid" --log-file="$work/munge/log" --seed-file="$work/munge/seed"
start slurmctld slurmctld -D -c
start n1 slurmd -D -N n1
start n2 slurmd -D -N n2
for ((i = 0; ; ++i)); do
  (($(sinfo -h -N -t idle -o %N 2>/dev/null | wc -l) == 2)) && break
  ((i < 150)) || { cat "$work"/*.out "$work"/*.log; fail "the nodes are not idle after 30 s"; }
  sleep 0.2
done
say "two idle nodes"

# --- a sweep -----------------------------------------------------------------------------------------------------
cat >"$work/suite.yaml" <<SUITE
schema: 1
about: eight recordings, two extractors
scenarios: [$sources/scenarios/abcdef.yaml]
seeds: {first: 1, count: 8}
pipelines:
  - {name: iepf, extract: {module: iepf, params: {threshold_m: 0.10}}}
  - {name: polyline, extract: {module: polyline}}
metrics: [segments]
figures: []
SUITE
cd "$work"
"$program" sweep plan suite.yaml --out sweep --shards 8
"$program" sweep submit slurm sweep --out merged
say "submitted"

# The second node is killed while it runs a shard: its unfinished folder exists.
task_on_n2() { squeue -h -r -w n2 -t R -o %K 2>/dev/null | head -1; }
for ((i = 0; ; ++i)); do
  shard=$(task_on_n2)
  [[ -n $shard ]] && compgen -G "sweep/shards/.$shard.tmp-*" >/dev/null && break
  ((i < 600)) || fail "no shard was seen on the second node"
  sleep 0.05
done
kill -9 "$pid_n2"
say "killed node n2, which was running shard $shard"
sleep 1
compgen -G "sweep/shards/.$shard.tmp-*" >/dev/null || fail "shard $shard had ended before its node was killed"
"$program" sweep status sweep || true

for ((i = 0; ; ++i)); do
  [[ -z $(squeue -h -o %i) ]] && break
  ((i < 600)) || { squeue; fail "the jobs have not ended after two minutes"; }
  sleep 0.2
done
say "the queue is empty"
"$program" sweep status sweep
tail -n 1 sweep/slurm/merge_*.log
grep -i "requeue" "$work/slurmctld.log" || fail "Slurm has not requeued the shard of the killed node"

"$program" run suite.yaml --out local --quiet
say "run locally"
sha256sum merged/summary.csv local/summary.csv
cmp merged/summary.csv local/summary.csv || fail "the summaries differ"
[[ $(find sweep/shards -maxdepth 1 -name "$shard.*" | wc -l) == 1 ]] || fail "shard $shard was not committed once"
say "equal"
