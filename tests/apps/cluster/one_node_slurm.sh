# A Slurm of one node for tests, all of it in one folder. To be sourced.

# start_slurm FOLDER CPUS: sets the environment of sbatch and the others. Fails with the reason in FOLDER/*.log.
start_slurm() {
  slurm=$1
  user=$(id -un) host=$(hostname -s)
  mkdir -p "$slurm/state" "$slurm/spool"
  chmod 755 "$slurm"
  dd if=/dev/urandom of="$slurm/munge.key" bs=64 count=1 2>/dev/null
  chmod 400 "$slurm/munge.key"
  munged --force --key-file="$slurm/munge.key" --socket="$slurm/munge.socket" --pid-file="$slurm/munged.pid" \
    --log-file="$slurm/munged.log" --seed-file="$slurm/munge.seed" >/dev/null 2>&1
  # Ports that are likely to be free.
  port=$((20000 + $$ % 10000 * 2))
  cat >"$slurm/slurm.conf" <<CONF
ClusterName=swell
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/munge
AuthInfo=socket=$slurm/munge.socket
CredType=cred/munge
StateSaveLocation=$slurm/state
SlurmdSpoolDir=$slurm/spool
SlurmctldPidFile=$slurm/slurmctld.pid
SlurmdPidFile=$slurm/slurmd.pid
SlurmctldLogFile=$slurm/slurmctld.log
SlurmdLogFile=$slurm/slurmd.log
JobCompType=jobcomp/filetxt
JobCompLoc=$slurm/jobs.txt
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=100000,bf_interval=1
MinJobAge=300
ReturnToService=2
SlurmdParameters=config_overrides
NodeName=$host NodeAddr=127.0.0.1 CPUs=$2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=10 State=UP
CONF
  export SLURM_CONF="$slurm/slurm.conf"
  slurmctld >"$slurm/start.log" 2>&1 && slurmd >>"$slurm/start.log" 2>&1 || return 1
  for _ in $(seq 200); do
    [ "$(sinfo -h -o %t 2>/dev/null)" = idle ] && return
    sleep 0.1
  done
  return 1
}

stop_slurm() {
  for daemon in slurmd slurmctld munged; do
    pid=$(cat "$slurm/$daemon.pid" 2>/dev/null) || continue
    kill "$pid" 2>/dev/null || continue
    for _ in $(seq 100); do
      kill -0 "$pid" 2>/dev/null || break
      sleep 0.1
    done
  done
}
