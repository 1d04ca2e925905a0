#!/usr/bin/env bash
# The parts of a batch by GNU parallel, on this machine or on others that see the same files:
#   tools/cluster/parallel.sh 8 models.txt -o 'out/{stem}.json'
#   PARALLEL='--sshlogin a,b --workdir .' tools/cluster/parallel.sh 8 models.txt
# The first argument says how many parts; each part runs one worker on this machine, as many as there are cores at a
# time. The same line again goes on where it was.
set -euo pipefail
zskel=${ZSKEL:-zskel}
parts=$1
shift
# Quoted for the shells that parallel starts; braces of a template are not parallel's.
line=$(printf '%q ' "$zskel" batch "$@" --workers 1)
seq "$parts" | parallel -I @@ --termseq TERM,3000,KILL,25 "$line --shard @@/$parts"
