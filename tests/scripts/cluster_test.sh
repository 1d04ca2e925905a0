#!/usr/bin/env bash
# cluster_test.sh PROGRAM MODELS_DIR ROOT: what is in tools/cluster passes its linters, and the parts of a batch by GNU
# parallel are the whole. Without the tools it says so and exits with 77.
set -euo pipefail
zskel=$(realpath "$1")
models=$(realpath "$2")
root=$(realpath "$3")
for tool in shellcheck yamllint parallel; do
    command -v "$tool" >/dev/null || { echo "skipped: no $tool (tools/setup --long)"; exit 77; }
done
fail() { echo "FAILED: $*"; exit 1; }

shellcheck "$root"/tools/cluster/*.sh
yamllint --strict -d '{extends: default, rules: {line-length: {max: 120}, document-start: disable, braces: disable}}' \
    "$root/tools/cluster/kubernetes_job.yaml"

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir 'in put'
for i in 1 2 3 4 5 6 7; do { echo "# $i"; cat "$models/torus.obj"; } >"in put/m$i.obj"; done
run() {
    ZSKEL=$zskel "$root/tools/cluster/parallel.sh" 3 'in put' -o 'out/{stem}.json' --backend cpu --face-px 4 --seeds 60 \
        --item-memory 0
}
run >first.txt || fail "exit code $?"
[[ $(find out -type f | wc -l) == 7 ]] || fail "files are there: $(ls -A out)"
rm out/m5.json
run >second.txt || fail "exit code $?"
[[ -s out/m5.json && $(grep -c ' skipped$' second.txt) == 3 ]] || fail "$(cat second.txt)"
grep -q '^2 items = 1 ok + 0 warned + 0 failed + 1 skipped$' second.txt || fail "$(cat second.txt)"
