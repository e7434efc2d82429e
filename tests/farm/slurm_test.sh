#!/usr/bin/env bash
# slurm_test.sh SDLC: renders shards on a Slurm of two virtual nodes on this machine, kills a task and a node on the
# way, and compares the picture with that of a local render. Exit status 77: skipped. It takes a minute; most of it is
# the time until Slurm notices that a node is gone.
set -euo pipefail
PATH=$PATH:/usr/sbin

skip() {
  echo "skipped: $*"
  exit 77
}
for program in slurmctld slurmd munged sbatch squeue scontrol scancel; do
  command -v "$program" >/dev/null ||
    skip "$program is not installed (Debian: slurmctld slurmd slurm-client munge)"
done
[[ $EUID -eq 0 ]] || skip "the daemons are started as root"

export SDLC=$1
dir=$(mktemp -d)
daemons=()
finish() {
  local status=$?
  if ((status)); then
    tail -n 30 "$dir"/log/*.log "$dir"/*/log/*.txt >&2 || true
  fi
  scancel --full --quiet --user=root 2>/dev/null || true
  kill "${daemons[@]}" 2>/dev/null || true
  wait 2>/dev/null || true
  rm -rf -- "$dir"
}
trap finish EXIT
say() { printf '%3d s: %s\n' "$SECONDS" "$*"; }

# Without systemd and cgroups. SlurmdTimeout: a node that is gone is noticed after 10 s, not 300 s.
mkdir -m 700 "$dir/munge"
mkdir "$dir/state" "$dir/spool" "$dir/log"
head -c 1024 /dev/urandom >"$dir/munge/key"
chmod 400 "$dir/munge/key"
port=$((20000 + $$ % 10000))
export SLURM_CONF=$dir/slurm.conf
cat >"$SLURM_CONF" <<CONF
ClusterName=sdlc
SlurmctldHost=localhost(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$dir/munge/munge.sock
CredType=cred/munge
SlurmctldPort=$port
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool/%n
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd.%n.pid
SlurmctldLogFile=$dir/log/slurmctld.log
SlurmdLogFile=$dir/log/slurmd.%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
JobRequeue=1
SlurmdTimeout=10
KillWait=5
SchedulerParameters=batch_sched_delay=0,sched_interval=5,sched_min_interval=0
NodeName=w0 NodeHostname=localhost NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=1 RealMemory=500 State=UNKNOWN
NodeName=w1 NodeHostname=localhost NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=1 RealMemory=500 State=UNKNOWN
PartitionName=main Nodes=w0,w1 Default=YES MaxTime=INFINITE State=UP
CONF

# The plugin for version 1 starts without any cgroups, which containers may lack; the other one does not.
echo CgroupPlugin=cgroup/v1 >"$dir/cgroup.conf"

start() {
  "$@" >/dev/null 2>&1 &
  daemons+=($!)
}
start munged --foreground --force --key-file="$dir/munge/key" --socket="$dir/munge/munge.sock" \
  --pid-file="$dir/munge/pid" --log-file="$dir/log/munged.log" --seed-file="$dir/munge/seed"
until [[ -S $dir/munge/munge.sock ]]; do sleep 0.1; done
start slurmctld -D
start slurmd -D -N w0
node=${daemons[-1]}
start slurmd -D -N w1
until [[ $(sinfo -h -o '%T %D' 2>/dev/null) == 'idle 2' ]]; do
  kill -0 "${daemons[@]}" 2>/dev/null || skip "Slurm does not start here: $(tail -qn 1 "$dir"/log/*.log)"
  sleep 0.2
done
say "two nodes are idle"

# The processes of the job on a node (default: any) whose command line matches.
processes() {
  local pid
  for pid in $(pgrep -f "$1" || true); do
    if { tr '\0' '\n' <"/proc/$pid/environ"; } 2>/dev/null | grep -q "^SLURMD_NODENAME=${2:-}"; then echo "$pid"; fi
  done
}
renderers() { processes "render a.sdlc.zip" "$@"; }

cat >"$dir/a.scene" <<'SCENE'
scene 1
render { width: 320, height: 200, samples: 3000 }
camera { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }
sphere { center: (0, -100.5, 0), radius: 100, material: diffuse(#888888) }
sphere { center: (0, 0, 0), radius: 0.5, material: transmissive(#FFFFFF, ior: 1.5) }
sphere { center: (1, 2, 1), radius: 0.1, material: emissive(#FFFFFF, 50) }
SCENE
cd "$dir"
"$SDLC" render a.scene -o a.png --quiet
say "rendered here"
"$SDLC" farm a.scene --engine slurm -o job --tasks 8
SDLC_PAUSE=1 sh job/submit.sh

# shellcheck disable=SC2046 # words are process ids
until kill -KILL $(renderers) 2>/dev/null; do sleep 0.1; done
say "killed the tasks"
scripts=()
until ((${#scripts[@]})); do
  sleep 0.1
  mapfile -t scripts < <(processes 'task\.sh render\.tasks' w0)
done
mapfile -t steps < <(ps -o ppid= -p "${scripts[0]}")
# shellcheck disable=SC2046
kill -KILL "$node" "${steps[@]// /}" "${scripts[@]}" $(renderers w0)
say "killed a node with its task"
while [[ -n $(squeue -h) ]]; do
  # Slurm holds a task for two minutes after it was requeued.
  for job in $(squeue -h -r -t PENDING -o '%i %r' | sed -n 's/ BeginTime$//p'); do
    scontrol update "jobid=$job" StartTime=now 2>/dev/null || true
  done
  sleep 1
done
say "the queue is empty"
"$SDLC" farm status job
grep -h 'task.sh:' job/log/*.txt
grep -i 'requeue' log/slurmctld.log
cmp a.png job/frames/a.png
say "the picture is the same"

"$SDLC" farm a.scene --engine slurm -o canceled --tasks 1 --quiet
job=$(cd canceled && sbatch --parsable render.sbatch)
until [[ -n $(renderers) ]]; do sleep 0.1; done
sleep 1
scancel "$job"
while [[ -n $(squeue -h) ]]; do sleep 0.2; done
while [[ -n $(renderers) ]]; do sleep 0.2; done
grep -h 'resume goes on from parts/a.1.film' canceled/log/*.txt
say "a canceled task saved its film"
