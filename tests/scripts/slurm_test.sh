#!/usr/bin/env bash
# slurm_test.sh PROGRAM MODELS_DIR ROOT: a batch as an array of two jobs on a Slurm cluster of one node, made here and
# ended with the test. One task is killed and goes on; what the two made is merged, and checked by the files that are
# there, never by what the cluster says of its jobs. Without Slurm, or not as root, it says so and exits with 77.
set -euo pipefail
zskel=$(realpath "$1")
models=$(realpath "$2")
root=$(realpath "$3")
for tool in slurmctld slurmd munged sbatch scontrol; do
    command -v "$tool" >/dev/null || { echo "skipped: no $tool (tools/setup --long)"; exit 77; }
done
((EUID == 0)) || { echo "skipped: the daemons need root"; exit 77; }

work=$(mktemp -d)
# munged wants no folder on the way to its socket that others may write to.
run=$(mktemp -d /run/zskel-slurm.XXXXXX)
chmod 755 "$run" "$work"
daemons=()
clean_up() {
    ((${#daemons[@]} == 0)) || kill "${daemons[@]}" 2>/dev/null || true
    wait 2>/dev/null || true
    rm -rf "$work" "$run"
}
trap clean_up EXIT
fail() {
    echo "FAILED: $*"
    tail -n 15 "$run"/*.log "$work"/*.out 2>/dev/null || true
    exit 1
}
# until_true WHAT COMMAND...: waits; a minute is far more than anything here takes.
until_true() {
    local what=$1 i
    shift
    for ((i = 0; i < 1200; ++i)); do
        if "$@"; then return 0; fi
        sleep 0.1
    done
    fail "waited in vain for: $what"
}

free_ports() {
    /usr/bin/python3 -c '
import socket
open_ones = [socket.socket() for _ in range(2)]
for one in open_ones: one.bind(("127.0.0.1", 0))
print(*(one.getsockname()[1] for one in open_ones))'
}

start_cluster() {
    local ports host
    read -r -a ports <<<"$(free_ports)"
    host=$(hostname -s)
    mkdir "$run/state" "$run/spool"
    head -c 1024 /dev/urandom >"$run/key"
    chmod 400 "$run/key"
    chown -R root:root "$run"
    cat >"$run/slurm.conf" <<END
ClusterName=zskel
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmctldPort=${ports[0]}
SlurmdPort=${ports[1]}
AuthType=auth/munge
AuthInfo=socket=$run/munge.socket
StateSaveLocation=$run/state
SlurmdSpoolDir=$run/spool
SlurmctldPidFile=$run/slurmctld.pid
SlurmdPidFile=$run/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
END
    export SLURM_CONF=$run/slurm.conf
    munged --foreground --force --key-file="$run/key" --socket="$run/munge.socket" --pid-file="$run/munged.pid" \
        --log-file="$run/munged.log" --seed-file="$run/seed" >/dev/null 2>&1 &
    daemons+=($!)
    until_true "munged" test -S "$run/munge.socket"
    slurmctld -D >"$run/slurmctld.log" 2>&1 &
    daemons+=($!)
    slurmd -D -N "$host" >"$run/slurmd.log" 2>&1 &
    daemons+=($!)
    until_true "an idle node" is_idle
}
is_idle() { sinfo -h -o %T 2>/dev/null | grep -qx idle; }

count=40
make_models() {
    local i name names=(cube_coarse y capsule torus)
    mkdir in
    for ((i = 0; i < count; ++i)); do
        name=${names[i % 4]}
        { echo "# $i"; cat "$models/$name.obj"; } >"in/m$(printf %03d "$i").obj"
    done
    # Holds the second task up, so that there is something to kill: nobody writes to it.
    rm in/m039.obj
    mkfifo in/m039.obj
}

line=(in -o "out/{stem}.json" --backend cpu --face-px 4 --seeds 60 --item-timeout 0 --item-memory 2000)
submit() {
    sbatch --parsable --chdir="$work" --output="$work/task-%a.out" --array="$1" --export=ALL,ZSKEL="$zskel" \
        "$root/tools/cluster/slurm_array.sh" "${line[@]}"
}
lines_of() { if [[ -e $1 ]]; then wc -l <"$1"; else echo 0; fi; }
has_lines() { (($(lines_of "$1") == $2)); }
is_running() {
    local state
    state=$(sed 's/.*) //' "/proc/$1/stat" 2>/dev/null) || return 1
    [[ ${state:0:1} != [ZX] ]]
}
# Processes of this test's program that run, by what the system says of them.
running_batches() {
    local folder
    for folder in /proc/[0-9]*; do
        [[ $(readlink "$folder/exe" 2>/dev/null) == "$zskel" && $(readlink "$folder/cwd" 2>/dev/null) == "$work" ]] ||
            continue
        if is_running "${folder#/proc/}"; then echo "${folder#/proc/}"; fi
    done
}
none_runs() { [[ -z $(running_batches) ]]; }
one_hangs() { has_lines batch.1-of-2.jsonl 20 && has_lines batch.2-of-2.jsonl 19; }

cd "$work"
make_models
start_cluster
job=$(submit 1-2)
until_true "all items but the one that hangs" one_hangs

# The second task is killed, all its processes at once.
for pid in $(running_batches); do kill -KILL "$pid" 2>/dev/null || true; done
until_true "the end of the second task" none_runs
scancel "$job" 2>/dev/null || true
[[ ! -e out/m039.json ]] || fail "an output of the item that hung"
rm in/m039.obj
{ echo "# 39"; cat "$models/torus.obj"; } >in/m039.obj

# The same again: the task goes on where it was.
echo '{"torn": ' >>batch.2-of-2.jsonl
truncate -s -1 batch.2-of-2.jsonl
submit 1-2 >/dev/null
until_true "the output that was missing" test -s out/m039.json
until_true "the end of both tasks" none_runs
until_true "the journal's last line" has_lines batch.2-of-2.jsonl 20

# Merged and reconciled by the files: nothing is left to do, and a file that is missing is made.
cat batch.*-of-2.jsonl >batch.jsonl
rm out/m007.json
"$zskel" batch "${line[@]}" --json >summary.json || fail "the merged batch failed"
/usr/bin/python3 - "$count" <<'END' || fail "the results do not add up"
import json, os, sys
count = int(sys.argv[1])
tally = json.load(open("summary.json"))
assert (tally["items"], tally["skipped"], tally["ok"] + tally["warned"]) == (count, count - 1, 1), tally
assert sorted(os.listdir("out")) == [f"m{i:03}.json" for i in range(count)], os.listdir("out")
for name in os.listdir("out"):
    assert json.load(open(f"out/{name}"))["format"] == "zskel-skeleton", name
END
echo "two tasks, $count items, all there"
