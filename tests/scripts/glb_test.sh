#!/usr/bin/env bash
# glb_test.sh PROGRAM MODELS_DIR: every GLB and glTF file that the program writes, by Khronos' validator. Without it the
# test is skipped, or fails if ZSKEL_REQUIRE_READERS=1.
set -euo pipefail
zskel=$(readlink -f "$1")
models=$(readlink -f "$2")
here=$(dirname "$(readlink -f "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# A limb tree, a ring, a lone node, two parts, holes.
awk -f "$here/two_parts.awk" "$models/cube_coarse.obj" >two.obj
for model in "$models"/{horse,torus,double_torus,cube_coarse,vessels_open}.obj two.obj; do
    "$zskel" -q rig "$model" --backend ray --face-px 6 -o "rig_$(basename "$model" .obj).glb"
done
"$zskel" -q rig "$models/hand.obj" --backend ray --face-px 6 --max-bones 6 -o few.glb
"$zskel" -q extract "$models/hand.obj" --backend ray --face-px 6 -o lines.json
for form in lines.glb lines.gltf; do "$zskel" -q convert lines.json -o "$form"; done
"$zskel" -q convert lines.json --tubes -o tubes.glb

"$zskel" -q deform --demo hand --backend ray --face-px 6 -o curl.glb --strip /dev/null
echo '{"moves": [{"branch": 0, "bend": 40, "axis": [0, 0, 1], "stretch": 1.3}]}' >longer.json
"$zskel" -q deform "$models/y.obj" --backend ray --face-px 6 --pose longer.json --frames 5 -o longer.glb

code=0
if command -v node >/dev/null; then
    node "$here/../node/validate_glb.js" ./*.glb ./*.gltf || code=$?
else
    echo "node is not installed (tools/setup --test)"
    code=77
fi
if ((code == 77)) && [[ ${ZSKEL_REQUIRE_READERS:-0} == 1 ]]; then code=1; fi
exit "$code"
