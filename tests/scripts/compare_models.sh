#!/usr/bin/env bash
# compare_models.sh ZSKEL 'OPTIONS' MODEL...: `zskel compare`, the Z-buffer against rays, on every model; fails
# when one is out of bounds.
set -uo pipefail
zskel=$1
read -ra options <<<"$2"
shift 2
failed=0
for model in "$@"; do
    out=$("$zskel" -q compare "$model" "${options[@]}")
    rc=$?
    printf '%-16s %s\n' "$(basename "$model" .obj)" \
        "$(grep -oE '(^  all .*|skeletons:.*|seeds that.*of [0-9]+|force,.*|.*within bounds)' <<<"$out" | tr -s ' ' | tr '\n' ';')"
    ((rc == 0)) || failed=$((failed + 1))
done
echo "$failed of $# models out of bounds"
((failed == 0))
