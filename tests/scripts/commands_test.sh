#!/usr/bin/env bash
# commands_test.sh PROGRAM [--two-parts] MODEL...: every command that takes a model does its work on each, or refuses it
# as bad input; with --two-parts first on the first model twice in one file.
set -euo pipefail
zskel=$(readlink -f "$1")
here=$(dirname "$(readlink -f "$0")")
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
if [[ $1 == --two-parts ]]; then
    shift
    awk -f "$here/two_parts.awk" "$1" >"$work/two.obj"
    set -- "$work/two.obj" "$@"
fi
failures=0

# try NAME ARGUMENTS...
try() {
    local name=$1 code=0
    shift
    timeout 300 "$zskel" -q "$@" >"$work/out" 2>"$work/err" </dev/null || code=$?
    if ((code != 0 && code != 3)); then
        echo "FAILED $name: exit code $code: $(tail -n 1 "$work/err")"
        failures=$((failures + 1))
    fi
    printf '%s %s\n' "$name" "$code"
    return 0
}

echo '{"moves": [{"near": [0, 0, 0], "bend": 30, "axis": [0, 0, 1]}]}' >"$work/pose.json"
for model in "$@"; do
    echo "== $(basename "$model")"
    rm -f "$work"/a.*
    try check check "$model"
    try extract extract "$model" -o "$work/a.json"
    try rig rig "$model" -o "$work/a.glb"
    try deform deform "$model" --pose "$work/pose.json" -o "$work/a.obj"
    try reconstruct reconstruct "$model" --map-px 16 -o "$work/a.ply"
    try match match "$model" "$model"
    try report report "$model" --map-px 8 -o "$work/a.html"
done | tee "$work/log"
failures=$(grep -c ^FAILED "$work/log" || true)
((failures == 0))
