#!/usr/bin/env bash
# report_test.sh PROGRAM MODELS_DIR: headless Chromium opens the pages that zskel report writes. Without it the test is
# skipped, or fails if ZSKEL_REQUIRE_READERS=1.
set -euo pipefail
zskel=$(readlink -f "$1")
models=$(readlink -f "$2")
here=$(dirname "$(readlink -f "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# A limb tree, a ring, a lone node, two parts, holes, patches; a name that would end the script that it stands in.
mkdir 'two <'
awk -f "$here/two_parts.awk" "$models/cube_coarse.obj" >'two </script> & "parts".obj'
for model in "$models"/{horse.obj,torus.obj,sphere.obj,vessels_open.obj,teapot.bpt} two*/*.obj; do
    "$zskel" -q report "$model" --backend cpu -o page.html
    code=0
    node "$here/../node/browse.js" page.html page.png || code=$?
    if ((code == 77)) && [[ ${ZSKEL_REQUIRE_READERS:-0} != 1 ]]; then exit 77; fi
    ((code == 0)) || {
        echo "$model: its page is not as promised"
        exit 1
    }
done
