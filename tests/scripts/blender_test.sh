#!/usr/bin/env bash
# blender_test.sh PROGRAM MODELS_DIR: Debian's Blender opens what zskel rig writes. Without it the test is skipped, or
# fails if ZSKEL_REQUIRE_READERS=1.
set -euo pipefail
zskel=$(readlink -f "$1")
models=$(readlink -f "$2")
script=$(dirname "$(readlink -f "$0")")/blender_rig.py
if ! command -v blender >/dev/null; then
    echo "blender is not installed (tools/setup --long)"
    [[ ${ZSKEL_REQUIRE_READERS:-0} != 1 ]] || exit 1
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for name in horse hand octopus torus; do
    "$zskel" -q rig "$models/$name.obj" --backend ray --face-px 8 -o "$work/rig.glb"
    blender -b --factory-startup --python "$script" -- "$work/rig.glb" "$(grep -c '^v ' "$models/$name.obj")" \
        >"$work/log" 2>&1 || true
    grep -qx SOUND "$work/log" || {
        echo "$name:"
        tail -n 20 "$work/log"
        exit 1
    }
    echo "$name: $(grep -B1 -x SOUND "$work/log" | head -n 1)"
done
