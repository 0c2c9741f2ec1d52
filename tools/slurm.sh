#!/usr/bin/env bash
# The scripts of examples/cluster under a real Slurm of one node, on this machine alone: a run in four parts, merged, must have the bits
# of a whole run. Needs root and `carom` on the path; ends what it started.
set -euo pipefail
cd "$(dirname "$0")/.."

if ! command -v slurmd >/dev/null || ! command -v munged >/dev/null; then
    apt-get update -qq && apt-get install -y -qq slurmd slurmctld slurm-client munge >/dev/null
fi
room=$(mktemp -d)
chmod 755 "$room"
started=()
end() {
    for pid in "${started[@]}"; do kill "$pid" 2>/dev/null || true; done
    wait
    rm -rf "$room"
}
trap end EXIT

host=$(hostname -s)
mkdir -p "$room"/{munge,state,spool,log}
dd if=/dev/urandom of="$room/munge/key" bs=128 count=1 status=none
chmod 700 "$room/munge"
chmod 400 "$room/munge/key"
chown -R munge: "$room/munge"
mkdir -p /run/munge && chown munge: /run/munge
runuser -u munge -- munged --foreground --force --key-file="$room/munge/key" --socket="$room/munge/socket" --pid-file="$room/munge/pid" \
    --log-file="$room/munge/log" --seed-file="$room/munge/seed" &
started+=($!)
chmod 711 "$room/munge"

cat >"$room/slurm.conf" <<CONF
ClusterName=one
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=16817
SlurmdPort=16818
AuthType=auth/munge
AuthInfo=socket=$room/munge/socket
CredType=cred/munge
SlurmUser=root
StateSaveLocation=$room/state
SlurmdSpoolDir=$room/spool
SlurmctldPidFile=$room/slurmctld.pid
SlurmdPidFile=$room/slurmd.pid
SlurmctldLogFile=$room/log/slurmctld
SlurmdLogFile=$room/log/slurmd
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SlurmdParameters=config_overrides
MpiDefault=none
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=4 RealMemory=4000
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$room/slurm.conf
slurmctld -D &
started+=($!)
slurmd -D -N "$host" &
started+=($!)

wait_for() { # SECONDS WHAT COMMAND...
    local left=$1 what=$2
    until "${@:3}"; do
        ((left-- > 0)) || { echo "no $what"; tail -n 20 "$room"/log/* "$room"/munge/log; exit 1; }
        read -rt 1 <> <(:) || true
    done
}
idle() { sinfo -h -o %T 2>/dev/null | grep -q idle; }
wait_for 60 "node" idle
sinfo

sed '/^\[\[injection\]\]/a count = 1500' examples/wind-tunnel.toml >"$room/case.toml"
carom run "$room/case.toml" --out "$room/whole" --threads 1 >/dev/null
cp -r examples/cluster "$room"
cd "$room"
# as README.md has it
job=$(sbatch --parsable --output="$room/log/part-%a" --array=1-4 cluster/slurm-array.sh case.toml out 4)
merging=$(sbatch --parsable --output="$room/log/merge" --dependency=afterok:"$job" --wrap "carom merge out/parts/*-of-4 --out out")
done_() { ! squeue -h -o %i | grep -q .; }
wait_for 180 "end of the jobs $job and $merging" done_
cat "$room"/log/part-* "$room/log/merge"
for file in impacts.csv fates.csv trajectories.csv deposition.csv summary.json; do cmp "$room/whole/$file" "$room/out/$file"; done
echo "Slurm: four parts and their merging have the bits of the whole run"
