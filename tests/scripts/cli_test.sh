#!/usr/bin/env bash
# cli_test.sh PROGRAM MODELS_DIR CASE...: the program as its users meet it. `cli_test.sh --list` names the cases.
# A case that a missing tool keeps from running says so and exits with 77.
set -uo pipefail

failures=0
say() { printf '%s\n' "$*"; }
fail() {
    failures=$((failures + 1))
    say "FAILED [$label] $*"
    [[ -s err ]] && sed 's/^/    err: /' err
}

# run EXPECTED_CODE ARGUMENTS...: the program's output lands in `out` and `err`.
label=
run() {
    local expected=$1 code=0
    shift
    label="zskel $*"
    "$zskel" "$@" >out 2>err </dev/null || code=$?
    ((code == expected)) || fail "exit code $code, not $expected"
}
# refused EXPECTED_CODE PIECE ARGUMENTS...: nothing on standard output, one line on standard error with PIECE in it.
refused() {
    local expected=$1 piece=$2
    shift 2
    run "$expected" "$@"
    [[ ! -s out ]] || fail "something on standard output"
    (($(wc -l <err) == 1)) || fail "standard error is not one line"
    grep -qF -- "$piece" err || fail "the message lacks: $piece"
}
# holds PATTERN [FILE]: in what was printed, or in a file.
holds() { grep -qE -- "$1" "${2:-out}" || fail "${2:-the output} lacks: $1"; }
is_json() { /usr/bin/python3 -c 'import json, sys; json.load(open(sys.argv[1]))' "$1"; }
is_png() {
    local begin
    begin=$(od -A n -t x1 -N 24 "$1" | tr -d ' \n')
    [[ $begin == 89504e470d0a1a0a????????49484452$(printf '%08x%08x' "$2" "$3") ]]
}
# No file but those named is in the folder.
only_files() {
    local found
    found=$(cd "$1" && find . -mindepth 1 -printf '%P\n' | sort | tr '\n' ' ')
    shift
    [[ $found == "$(printf '%s\n' "$@" | sort | tr '\n' ' ')" || ($# == 0 && -z $found) ]] ||
        fail "files are there: $found"
}

fast=(--method paper --backend ray --face-px 4 --step 0.02)

case_usage() {
    refused 2 'subcommand'
    refused 2 '--bogus' --bogus
    refused 2 'frobnicate' frobnicate
    refused 2 '--bogus' extract cube.obj --bogus
    refused 2 'superfluous' check cube.obj superfluous
    refused 2 'model' extract
    refused 2 'model' check
    refused 2 'nosuch' extract cube.obj --method nosuch
    refused 2 'nosuch' extract cube.obj --backend nosuch
    refused 2 'nosuch' compare cube.obj --against nosuch
    refused 2 'nosuch' extract cube.obj --view nosuch
    refused 2 'nosuch' extract cube.obj --format nosuch
    refused 2 'nosuch' --log-format nosuch check cube.obj
    refused 2 '--step' extract cube.obj --step
    local value
    for value in 0 -1 nan inf x ''; do refused 2 '--step' extract cube.obj --step="$value"; done
    for value in -1 nan inf x ''; do refused 2 '--min-handle' extract cube.obj --min-handle="$value"; done
    for value in -1 nan inf x ''; do refused 2 '--resample' extract cube.obj --resample="$value"; done
    for value in nan x ''; do refused 2 '--detail' extract cube.obj --detail="$value"; done
    for value in nan inf; do refused 2 '--timeout' --timeout "$value" check cube.obj; done
    refused 2 '--view requires --picture' extract cube.obj --view front
    refused 2 '--picture-width requires --picture' rig cube.obj -o a.glb --picture-width 100
    refused 2 '--map-px requires --keep-maps' extract cube.obj --map-px 8
    refused 2 'excludes' extract cube.obj --backend ray --rays 100 --face-px 8
    refused 2 'excludes' -q -v check cube.obj
    refused 2 'excludes' repair cube.obj --caps --no-caps -o a.obj
    refused 2 '--query' match --index . cube.obj
    refused 2 '--active-contour goes with --method newton' extract cube.obj --method paper --active-contour
    refused 2 '--min-handle goes with --method newton' extract cube.obj --method paper --min-handle 1
    refused 2 '--cluster' extract cube.obj --cluster -1
    refused 2 '--offset' extract cube.obj --offset nan
    refused 2 '--max-steps' extract cube.obj --max-steps 0
    refused 2 '--threads' --threads -1 check cube.obj
    refused 2 '--rays' extract cube.obj --backend ray --rays -3
    refused 2 '--rays' extract cube.obj --backend gl --rays 197
    refused 2 '--gpu' extract cube.obj --backend ray --gpu 0
    refused 2 '--gpu' extract cube.obj --gpu -1
    refused 2 '3' extract cube.obj --backend ray --face-px 3
    refused 2 '1025' extract cube.obj --backend ray --face-px 1025
    refused 2 '--output' extract cube.obj "${fast[@]}" -o ''
    refused 2 'cube.obj' extract cube.obj "${fast[@]}" -o ./cube.obj
    ln -s cube.obj link.obj
    refused 2 'link.obj' extract cube.obj "${fast[@]}" -o link.obj
    refused 2 'a.png' extract cube.obj "${fast[@]}" -o a.png --picture ./a.png
    only_files . cube.obj link.obj out err
}

case_rig() {
    local quick=(--backend ray --face-px 6)
    run 0 rig cube.obj "${quick[@]}" -o a.glb
    [[ $(head -c 4 a.glb) == glTF ]] || fail "no GLB"
    run 0 rig cube.obj "${quick[@]}" -o -
    [[ $(head -c 4 out) == glTF ]] || fail "no GLB on standard output"
    run 0 rig cube.obj "${quick[@]}" -o a.glb --picture bones.png --picture-width 400 --picture-height 300
    is_png bones.png 400 300 || fail "no picture of the bones"
    refused 2 '.png' rig cube.obj -o b.glb --picture bones.jpg
    refused 2 '.glb' rig cube.obj -o b.fbx
    refused 2 '--output' rig cube.obj
    refused 2 'cube.obj' rig cube.obj -o ./cube.obj
    refused 2 '--max-bones' rig cube.obj -o b.glb --max-bones -1
    refused 2 '--smoothing' rig cube.obj -o b.glb --smoothing 0
    refused 2 '--smoothing' rig cube.obj -o b.glb --smoothing nan
    refused 3 'none.obj' rig none.obj -o b.glb
    refused 5 'nowhere' rig cube.obj -o nowhere/b.glb
    awk -f "$here/two_parts.awk" cube.obj >two.obj
    refused 2 '2 parts' rig two.obj "${quick[@]}" --max-bones 1 -o b.glb
    [[ ! -e b.glb && ! -e b.fbx ]] || fail "a file is there"
}

case_deform() {
    local quick=(--backend ray --face-px 6)
    cp "$models/y.obj" y.obj
    echo '{"moves": [{"branch": 0, "bend": 60, "axis": [0, 0, 1]}]}' >bend.json
    echo '{"moves": []}' >rest.json
    run 0 deform y.obj "${quick[@]}" --pose rest.json -o rest.obj
    grep -q '^volume *+0.000 %$' err || fail "a rest pose changes the volume: $(cat err)"
    run 0 deform y.obj "${quick[@]}" --pose bend.json -o bent.obj
    cmp -s <(grep '^f' rest.obj) <(grep '^f' bent.obj) || fail "other faces"
    cmp -s rest.obj bent.obj && fail "nothing moved"
    run 0 check bent.obj
    run 0 -q deform y.obj "${quick[@]}" --pose bend.json --skinning linear -o -
    [[ ! -s err ]] || fail "not quiet"
    grep -q '^v ' out || fail "no OBJ on standard output"
    run 0 deform y.obj "${quick[@]}" --pose bend.json --frames 3 -o way.ply
    [[ $(ls way*) == $'way_0001.ply\nway_0002.ply\nway_0003.ply' ]] || fail "not three files: $(ls)"
    [[ $(grep -c '^ *[123] ' err) == 3 ]] || fail "no row a frame: $(cat err)"
    run 0 check way_0003.ply
    run 0 deform y.obj "${quick[@]}" --pose bend.json -o way.glb
    [[ $(head -c 4 way.glb) == glTF ]] || fail "no GLB"
    grep -aq '"animations"' way.glb || fail "no animation"
    refused 2 'standard output' deform y.obj --pose bend.json --frames 2 -o -
    refused 2 '--demo' deform y.obj --demo hand
    refused 2 '--demo' deform --demo horse
    refused 2 'y_0001.obj' deform y_0001.obj --pose bend.json --frames 2 -o y.obj
    refused 2 '--pose' deform y.obj -o b.obj
    refused 2 'standard input' deform - --pose - -o b.obj
    refused 2 'bend.json' deform y.obj --pose bend.json -o bend.json
    refused 2 'y.obj' deform y.obj --pose bend.json -o y.obj
    refused 2 '--skinning' deform y.obj --pose bend.json -o b.obj --skinning nosuch
    refused 3 'none.json' deform y.obj --pose none.json -o b.obj
    echo '{"moves": [{"branch": 99, "twist": 60}]}' >bad.json
    refused 3 'bad.json: moves[0]: branch' deform y.obj "${quick[@]}" --pose bad.json -o b.obj
    [[ ! -e b.obj ]] || fail "a file is there"
}

case_reconstruct() {
    local quick=(--backend cpu)
    cp "$models/torus.obj" torus.obj
    run 0 extract torus.obj "${quick[@]}" -o torus.json --keep-maps torus.maps
    run 0 reconstruct torus.json --original torus.obj --json -o a.ply
    is_json out || fail "no JSON"
    run 0 reconstruct torus.maps --original torus.obj --json -o b.ply --points points.ply
    grep -q '"share_seen": 1.0' out || fail "not all was seen: $(cat out)"
    /usr/bin/cmp -s <(tail -c 100000 a.ply) <(tail -c 100000 b.ply) || fail "the same maps give another surface"
    run 0 check b.ply
    grep -q 'closed, manifold, oriented, genus 1,' out || fail "no watertight ring: $(cat out)"
    grep -aq '^property float nz' points.ply || fail "points without normals"
    run 0 -q reconstruct torus.obj "${quick[@]}" --map-px 16 --voxel 0.02 -o -
    [[ ! -s err ]] || fail "not quiet"
    grep -q '^f ' out || fail "no OBJ on standard output"
    mkdir away && run 0 extract torus.obj "${quick[@]}" -o away/torus.json --keep-maps torus.maps
    run 0 reconstruct away/torus.json --voxel 0.02 -o c.ply
    # Parts that do not hang together stay so.
    awk -f "$here/two_parts.awk" "$models/y.obj" >two.obj
    run 0 reconstruct two.obj "${quick[@]}" --voxel 0.05 -o two.ply
    run 0 check two.ply
    grep -q ' 2 components' out || fail "two parts became others: $(head -n 1 out)"
    run 0 reconstruct torus.json --original torus.obj --voxel 0.02 -o c.ply --picture c.png --picture-width 400 \
        --picture-height 300
    is_png c.png 400 300 || fail "no picture"
    refused 2 '--original' reconstruct torus.json -o d.ply --picture d.png
    refused 2 '--map-px' reconstruct torus.maps -o d.ply --map-px 16
    refused 2 'no surface is left' reconstruct torus.maps -o d.ply --voxel 50
    cp "$models/y.obj" y.obj
    run 0 extract y.obj "${quick[@]}" -o y.json --keep-maps torus.maps.y
    sed -i 's/torus.maps.y/torus.maps/' y.json
    refused 3 'torus.maps: the maps of another skeleton' reconstruct y.json -o d.ply
    run 0 reconstruct torus.maps --original y.obj --voxel 0.02 -o c.ply
    grep -q 'are they of another model' err || fail "no warning of another model"
    refused 2 '--output' reconstruct torus.obj
    refused 2 '--table' reconstruct torus.maps --table
    refused 2 '--original' reconstruct torus.obj --original torus.obj -o d.ply
    refused 2 '.stl' reconstruct torus.maps -o d.stl
    refused 2 'too small' reconstruct torus.maps --voxel 1e-6 -o d.ply
    refused 3 'none.maps' reconstruct none.maps -o d.ply
    run 0 extract torus.obj "${quick[@]}" -o bare.json
    refused 3 'bare.json: names no visibility maps' reconstruct bare.json -o d.ply
    head -c 5000 torus.maps >cut.maps
    cp "$models/y.obj" y.maps
    refused 3 'cut.maps: byte 20: the packed part is said to have' reconstruct cut.maps -o d.ply
    refused 3 'y.maps: no visibility maps' reconstruct y.maps -o d.ply
    [[ ! -e d.ply && ! -e d.stl ]] || fail "a file is there"
}

case_match() {
    local quick=(--backend ray --face-px 6) name
    mkdir all
    for name in y torus; do
        cp "$models/$name.obj" .
        run 0 extract "$name.obj" "${quick[@]}" -o "all/$name.json"
    done
    run 0 convert all/y.json -o all/same.graphml
    run 0 match all/y.json all/same.graphml
    [[ $(cat out) == 0 ]] || fail "a shape is not like itself: $(cat out)"
    run 0 convert all/y.json -o y.swc
    run 0 match all/y.json y.swc
    grep -q 'keeps no volumes' err || fail "not a word that SWC keeps no volumes"
    run 0 match y.obj "${quick[@]}" all/torus.json --json
    is_json out || fail "no JSON"
    /usr/bin/python3 -c 'import json; d = json.load(open("out")); assert d["distance"] > 0.1 and len(d["nodes"]) == 48' ||
        fail "no distance with matched nodes"
    run 0 match --index all --query y.obj "${quick[@]}" --neighbours 2
    [[ $(wc -l <out) == 2 && $(head -n 1 out) == *all/[sy]* && $(tail -n 1 out) == *all/[sy]* ]] ||
        fail "its own are not nearest: $(cat out)"
    run 0 match --index all --matrix all.csv --dendrogram all.svg
    [[ $(wc -l <all.csv) == 4 ]] || fail "no matrix of three: $(cat all.csv)"
    /usr/bin/python3 -c 'import xml.dom.minidom as m; m.parse("all.svg")' || fail "no XML"
    run 0 match all/y.json all/torus.json all/same.graphml
    [[ $(head -n 1 out) == shape,all/y.json,all/torus.json,all/same.graphml ]] || fail "no CSV: $(cat out)"
    run 0 match --index all --store all.idx
    [[ ! -s out ]] || fail "more than was asked for: $(cat out)"
    run 0 match --index all --query all/y.json
    mv out folder.txt
    run 0 match --index all.idx --query all/y.json
    cmp -s out folder.txt || fail "the stored index finds other neighbours: $(cat out)"
    refused 3 'no index of shapes' match --index y.obj --query all/y.json
    refused 2 'all.idx' match --index all.idx --store all.idx
    echo '{' >all/bad.json
    run 0 match --index all --query all/y.json --json
    is_json out || fail "no JSON"
    grep -q 'left out: all/bad.json' err || fail "nothing said about what cannot be read"
    refused 2 '--index' match
    refused 2 'alone' match all/y.json
    refused 2 '--index' match all/y.json --index all
    refused 2 '--query' match all/y.json all/torus.json --query y.obj
    refused 2 'all/y.json' match all/y.json all/torus.json --matrix all/y.json
    refused 3 'none.json' match all/y.json none.json
    refused 3 'nowhere' match --index nowhere --query y.obj
    mkdir empty
    refused 3 'holds no skeleton' match --index empty --query y.obj
    refused 3 'all/bad.json' match all/bad.json all/y.json
}

case_kills() {
    # Killed at 50 moments all over a run that writes several files: each is the old one or a whole new one, and the
    # next run is not disturbed by what was left.
    local outputs=(-o work/horse.json --keep-maps work/horse.maps)
    mkdir work whole
    local start=${EPOCHREALTIME/./} moment file
    run 0 extract "$models/horse.obj" --backend cpu "${outputs[@]}"
    local length=$((${EPOCHREALTIME/./} - start))
    cp work/horse.json work/horse.maps whole
    for ((i = 0; i < 50; ++i)); do
        echo old >work/horse.json
        echo old >work/horse.maps
        moment=$(((RANDOM << 15 | RANDOM) % (length * 5 / 4)))
        label="kill -9 after $moment of $length microseconds"
        "$zskel" extract "$models/horse.obj" --backend cpu "${outputs[@]}" >out 2>err &
        sleep "$(printf '%d.%06d' $((moment / 1000000)) $((moment % 1000000)))"
        kill -9 $! 2>/dev/null
        wait $! 2>/dev/null
        for file in horse.json horse.maps; do
            [[ $(wc -c <work/$file) == 4 ]] || is_whole work/$file whole/$file || fail "$file is damaged"
        done
    done
    label='after all kills'
    run 0 extract "$models/horse.obj" --backend cpu "${outputs[@]}"
    is_whole work/horse.json whole/horse.json || fail 'the skeleton differs'
    is_whole work/horse.maps whole/horse.maps || fail 'the maps differ'
}
# The same file, but for the seconds that it tells of.
is_whole() { cmp -s <(sed 's/"seconds":{[^}]*}//' "$1") <(sed 's/"seconds":{[^}]*}//' "$2"); }

case_limits() {
    local slow=(--method paper --backend ray --face-px 16 --step 0.00001 --max-steps 100000) code start
    refused 7 'more than the 11 that --max-faces allows' extract cube.obj --max-faces 11 -o a.json
    run 0 check cube.obj --max-faces 12
    start=$SECONDS
    refused 7 '--timeout' --timeout 1 extract cube.obj "${slow[@]}" -o a.json
    ((SECONDS - start < 10)) || fail "stopped after $((SECONDS - start)) s"
    run 0 --timeout 600 check cube.obj
    refused 2 '--timeout' --timeout -1 check cube.obj
    refused 2 '--max-memory' --max-memory x check cube.obj
    [[ -z ${ZSKEL_SANITIZED:-} ]] || return 0  # sanitizers reserve terabytes of address space
    # Each bound ends in one of two ways, and in no third.
    local megabytes
    for megabytes in 1 10 30 60 100 200 400; do
        code=0
        label="--max-memory $megabytes"
        "$zskel" --threads 2 --max-memory $megabytes extract "$models/vessels.obj" --backend cpu -o b.json >out 2>err || code=$?
        ((code == 0 || code == 7)) || fail "exit code $code: $(tail -n 1 err)"
        if ((code == 7)); then
            [[ ! -e b.json ]] || fail "a file is there"
            (($(wc -l <err) == 1)) || fail "standard error is not one line: $(cat err)"
        fi
        rm -f b.json
    done
    ((code == 0)) || fail "400 megabytes are not enough"
    only_files . cube.obj out err
}

case_repair() {
    # A cube without its last face's two triangles, and two boxes that overlap.
    head -n -2 cube.obj >open.obj
    run 0 repair cube.obj -o clean.ply
    holds 'nothing to repair'
    run 0 repair open.obj -o open.ply
    holds 'openings closed with caps, which are in no output: 1'
    run 0 check --json open.ply
    holds '"is_closed": ?false'
    run 0 repair open.obj --caps -o closed.obj
    holds 'openings closed with caps: 1'
    run 0 check --json closed.obj
    holds '"is_closed": ?true'
    refused 3 'needs repairs, and none are allowed: openings closed' extract open.obj --no-repair -o a.json
    run 0 extract open.obj --no-caps -o a.json --backend ray
    run 0 extract open.obj -o b.json --backend ray
    holds '"open_end": ?true' b.json
    awk '/^v/ {print; n++; shifted = shifted sprintf("v %f %f %f\n", $2 + 0.5, $3 + 0.3, $4 + 0.2)}
         /^f/ {print; more = more sprintf("f %d %d %d\n", $2 + 8, $3 + 8, $4 + 8)}
         END {printf "%s%s", shifted, more}' cube.obj >two.obj
    run 0 repair two.obj --join --join-voxel 0.05 -o one.ply
    holds 'parts joined by their winding number'
    run 0 check --json one.ply
    holds '"genus": ?0'
    refused 2 '--join-voxel' repair two.obj --join-voxel 0.05 -o c.ply
    only_files . cube.obj open.obj two.obj clean.ply open.ply closed.obj one.ply a.json b.json out err
}

case_surfaces() {
    local quick=(--backend ray --face-px 6)
    run 0 check "$models/teapot.bpt"
    grep -q 'closed, manifold, oriented, genus 1,' out || fail "no closed pot with a handle: $(cat out)"
    local fine
    fine=$(head -n 1 out)
    run 0 check "$models/teapot.bpt" --chord-error 0.005
    [[ $(head -n 1 out) != "$fine" ]] || fail "--chord-error changes nothing"
    cp "$models/teapot.bpt" pot
    run 0 extract pot "${quick[@]}" -o pot.json
    echo '{"surfaces": [{"type": "superquadric", "radii": [0.1, 0.1, 1], "exponents": [1, 1]}]}' >rod.surface.json
    run 0 extract rod.surface.json "${quick[@]}" -o rod.json
    run 0 match rod.surface.json rod.json "${quick[@]}"
    run 0 rig rod.surface.json "${quick[@]}" -o rod.glb
    refused 2 '--chord-error' check "$models/teapot.bpt" --chord-error 0
    echo '{"surfaces": [{"type": "cone"}]}' >bad.json
    refused 3 'bad.json: surfaces[0]: type' check bad.json
    printf '1\n3 3\n0 0 0\n' >bad.bpt
    refused 3 'bad.bpt:4: ' check bad.bpt
    refused 3 'pot.json: has no member' extract pot.json -o a.json
}

case_report() {
    local quick=(--backend ray --face-px 6)
    mkdir 'y<' && cp "$models/y.obj" 'y</script>&.obj'
    run 0 report 'y</script>&.obj' "${quick[@]}" -o y.html
    grep -qF '<title>The skeleton of script&gt;&amp;.obj</title>' y.html || fail "the name is not escaped"
    grep -qE '@[A-Z]+@' y.html && fail "something was not put in"
    sed -n 's|.*<script type="application/json" id="skeleton">\(.*\)|\1|p' y.html | head -c 30 | grep -q '^{' || fail "no skeleton"
    [[ $(grep -c '</script>' y.html) == 4 ]] || fail "a script ends early"
    run 0 report "$models/y.obj" "${quick[@]}" --map-px 8 -o -
    [[ $(head -c 15 out) == '<!DOCTYPE html>' ]] || fail "no page on standard output"
    refused 2 '--output' report "$models/y.obj"
    refused 3 'none.obj' report none.obj -o a.html
    refused 5 'nowhere' report "$models/y.obj" -o nowhere/a.html
    cp "$models/y.obj" y.obj
    refused 2 'y.obj' report y.obj -o y.obj
}

case_help() {
    local command
    run 0 --version
    grep -qE '^zskel [0-9]+\.[0-9]+\.[0-9]+$' out || fail "no version in: $(cat out)"
    run 0 --help
    grep -qF 'Exit codes:' out || fail "the exit codes are not listed"
    local commands
    commands=$(sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\+\) .*/\1/p' out)
    for command in extract convert rig deform reconstruct match check compare doctor; do
        grep -qx "$command" <<<"$commands" || fail "no subcommand $command"
    done
    for command in $commands; do
        run 0 "$command" --help
        [[ $(head -n 1 out) == [A-Z]*' '* ]] || fail "no description"
        grep -qF "Usage: zskel $command" out || fail "no usage line"
        grep -qF 'Example' out || fail "no example"
        [[ ! -s err ]] || fail "something on standard error"
    done
}

case_bad_input() {
    local command piece
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 7\n' >bad.obj
    printf 'OFF\n3 1 0\n0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n' >bad.off
    printf 'ply\nformat ascii 1.0\nelement vertex 3\nproperty flat x\nend_header\n' >bad.ply
    printf 'solid a\nfacet normal 0 0 1\nouter lap\n' >bad.stl
    { printf '%80s' '' && printf '\3\0\0\0' && printf '%60s' ''; } >cut.stl
    : >empty.obj
    mkdir folder.obj
    while read -r name piece; do
        for command in 'check' 'check --json' "extract ${fast[*]} -o kept.json" 'compare --backend ray'; do
            echo old >kept.json
            # shellcheck disable=SC2086
            refused 3 "$piece" $command "$name"
            grep -qF "$name:" err || fail "the message does not name the file"
            [[ $(cat kept.json) == old ]] || fail "the output that was there is gone"
        done
    done <<'END'
none.obj No such file
folder.obj folder.obj
empty.obj empty
bad.obj :4:
bad.obj 7
bad.off :4:
bad.off zero
bad.ply :4:
bad.ply flat
bad.stl :3:
bad.stl lap
cut.stl byte
END
    refused 3 'nothing.obj' check $'line\nbreak\tnothing.obj'
    only_files . cube.obj bad.obj bad.off bad.ply bad.stl cut.stl empty.obj folder.obj kept.json out err
}

case_streams() {
    printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n' >t.off
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >t.obj
    {
        printf 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n'
        printf 'element face 4\nproperty list uchar int vertex_indices\nend_header\n'
        printf '0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n'
    } >t.ply
    /usr/bin/python3 - <<'END'
import struct
corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
faces = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
with open("t.stl", "wb") as file:
    file.write(b" " * 80 + struct.pack("<I", 4))
    for face in faces:
        file.write(struct.pack("<12fH", 0, 0, 0, *(x for i in face for x in corners[i]), 0))
END
    local kind
    for kind in obj off ply stl; do
        label="zskel extract - <t.$kind"
        "$zskel" extract - "${fast[@]}" -o - <"t.$kind" >out 2>err || fail "exit code $?"
        is_json out || fail "no JSON"
        cat "t.$kind" | "$zskel" extract - "${fast[@]}" >piped 2>err || fail "exit code $? from a pipe"
        "$zskel" check - --json <"t.$kind" >report 2>err || fail "check: exit code $?"
        /usr/bin/python3 - <<'END' || fail "not the tetrahedron"
import json
skeleton, report = json.load(open("out")), json.load(open("report"))
assert skeleton["provenance"]["model"] == "-" and report["name"] == "-"
assert len(skeleton["vertex_node"]) == report["vertices"] == 4 and report["triangles"] == 4
assert skeleton["provenance"]["model_xxh3"] == report["hash"]
assert json.load(open("piped"))["nodes"] == skeleton["nodes"]
END
    done
    label='standard input that is empty, closed or no model'
    local code
    code=0; "$zskel" check - </dev/null >out 2>err || code=$?
    ((code == 3)) || fail "empty: exit code $code"
    code=0; "$zskel" check - <&- >out 2>err || code=$?
    ((code == 3)) || fail "closed: exit code $code"
    code=0; echo hello | "$zskel" check - >out 2>err || code=$?
    ((code == 3)) || fail "no model: exit code $code"
}

# cannot_write CODE_OF_LAST_COMMAND
cannot_write() {
    (($1 == 5)) || fail "exit code $1, not 5"
    (($(wc -l <err) == 1)) || fail "standard error is not one line"
}

case_cannot_write() {
    refused 5 'none/a.json' extract cube.obj "${fast[@]}" -o none/a.json
    refused 5 '.' extract cube.obj "${fast[@]}" -o .
    # By a link, so that a program that replaces what it should write to cannot take the system's device.
    ln -s /dev/full full
    refused 5 'full' extract cube.obj "${fast[@]}" -o full
    [[ -c full ]] || fail "the device was replaced"
    refused 5 'none/a.png' extract cube.obj "${fast[@]}" --picture none/a.png
    local arguments code
    for arguments in "extract cube.obj ${fast[*]}" 'check cube.obj' 'check cube.obj --json' 'doctor' '--help' '--version'; do
        label="zskel $arguments >/dev/full"
        # shellcheck disable=SC2086
        "$zskel" $arguments >/dev/full 2>err
        cannot_write $?
        label="zskel $arguments >&-"
        # shellcheck disable=SC2086
        "$zskel" $arguments >&- 2>err
        cannot_write $?
    done
    label='a pipe that nobody reads'
    { sleep 0.2; "$zskel" check cube.obj 2>err; echo $? >code; } | :
    cannot_write "$(cat code)"
    mkdir readonly && echo old >readonly/a.json && chmod 500 readonly
    if [[ -w readonly ]]; then
        say "a folder without permission to write: left out, this user may write anywhere"
    else
        refused 5 'readonly/a.json' extract cube.obj "${fast[@]}" -o readonly/a.json
        [[ $(cat readonly/a.json) == old ]] || fail "the output that was there is gone"
    fi
    chmod 700 readonly
    only_files readonly a.json
    label='a file size limit'
    (
        ulimit -f 1
        "$zskel" extract cube.obj "${fast[@]}" --with-paths -o readonly/a.json 2>err
    )
    cannot_write $?
    only_files readonly a.json
    [[ $(cat readonly/a.json) == old ]] || fail "the output that was there is gone"
    mkfifo pipe && (cat pipe >read) &
    run 0 extract cube.obj "${fast[@]}" -o pipe
    wait
    is_json read || fail "a named pipe does not get the whole of it"
    [[ -p pipe ]] || fail "the pipe was replaced"
    refused 5 'is a folder' extract cube.obj -o .
    refused 2 'standard output' extract cube.obj -o - --picture -
    refused 2 '.png' extract cube.obj -o a.json --picture a.jpg
}

case_signals() {
    # Small steps on a model of some size: minutes of work, were it not stopped.
    local slow=(--method paper --backend ray --face-px 16 --step 0.00001 --max-steps 100000) signal number code pid
    mkdir work
    for signal in INT:2 TERM:15 HUP:1; do
        number=${signal#*:} signal=${signal%:*}
        label="kill -$signal in the middle of work"
        echo old >work/kept.json
        # Not from the shell itself: what it puts in the background ignores SIGINT.
        /usr/bin/python3 -c '
import os, signal, sys
for s in (signal.SIGINT, signal.SIGHUP): signal.signal(s, signal.SIG_DFL)
os.execv(sys.argv[1], sys.argv[1:])' "$zskel" extract cube.obj "${slow[@]}" -o work/kept.json >out 2>err &
        pid=$!
        sleep 0.4
        kill -"$signal" "$pid"
        code=0
        wait "$pid" || code=$?
        ((code == 128 + number)) || fail "exit code $code"
        only_files work kept.json
        [[ $(cat work/kept.json) == old ]] || fail "the output that was there is gone"
        [[ ! -s out ]] || fail "something on standard output"
    done

    # A reader that takes nothing holds the write up in the middle.
    label='kill -TERM in the middle of writing to a pipe'
    mkfifo work/pipe
    sleep 20 <work/pipe &
    local reader=$!
    "$zskel" extract cube.obj --method paper --backend ray --face-px 4 --step 0.002 --with-paths -o work/pipe >out 2>err &
    pid=$!
    sleep 2
    kill -TERM "$pid" || fail "it was already over"
    code=0
    wait "$pid" || code=$?
    kill "$reader"
    wait "$reader" 2>/dev/null
    ((code == 143)) || fail "exit code $code"
    only_files work kept.json pipe

    # Stopped at moments all over a whole run: a file is there whole, or it is not.
    label='kill -TERM at any moment'
    local i
    for i in $(seq 1 25); do
        rm -f work/a.json
        "$zskel" extract cube.obj "${fast[@]}" --with-paths -o work/a.json >out 2>err &
        pid=$!
        sleep "$(printf '0.%03d' $((i * 8)))"
        kill -TERM "$pid" 2>/dev/null
        wait "$pid"
        [[ ! -e work/a.json ]] || is_json work/a.json || fail "half a file"
        only_files work kept.json pipe $([[ -e work/a.json ]] && echo a.json)
    done
}

json_lines() {
    /usr/bin/python3 - "$@" <<'END' || fail "not one JSON object a line"
import json, sys
lines = open("err", encoding="utf-8").read().splitlines()
assert len(lines) >= int(sys.argv[1]), lines
for line in lines:
    entry = json.loads(line)
    assert {"time", "level", "message"} <= entry.keys(), entry
    assert entry["level"] in ("debug", "info", "warning", "error"), entry
END
}

case_log() {
    head -n 900 "$models/cube.obj" | grep '^v' >open.obj
    grep '^f' "$models/cube.obj" | tail -n +3 >>open.obj
    run 0 extract open.obj "${fast[@]}" -o a.json
    grep -q '^zskel: warning: open.obj: ' err || fail "an open model without a warning"
    run 0 -q extract open.obj "${fast[@]}" -o a.json
    [[ ! -s err ]] || fail "-q is not quiet"
    run 0 extract open.obj "${fast[@]}" -o a.json --quiet
    [[ ! -s err ]] || fail "--quiet after the subcommand is not quiet"
    run 3 -q check none.obj
    [[ -s err ]] || fail "-q hides errors"
    run 0 -v extract cube.obj "${fast[@]}" -o a.json
    grep -q '^zskel: info: ' err || fail "-v says nothing"
    ! grep -q $'\r' err || fail "a progress bar in a file"
    local odd=$'quote" back\\slash\nline\t\xff.obj'
    cp open.obj "$odd"
    run 0 --log-format json -vv extract "$odd" "${fast[@]}" -o a.json
    json_lines 2
    is_json a.json || fail "no JSON with an odd file name"
    run 0 check --json "$odd"
    is_json out || fail "no JSON with an odd file name"
    run 0 extract "$odd" "${fast[@]}" -o a.json
    ! grep -qv '^zskel: ' err || fail "a line that is not ours"
    run 3 --log-format json check $'no "such"\nfile.obj'
    json_lines 1
    run 2 --log-format json extract --bogus
    json_lines 1
    run 2 extract cube.obj --backend nosuch --log-format=json
    json_lines 1
    run 5 --log-format json extract cube.obj "${fast[@]}" -o none/a.json
    json_lines 1
}

case_terminal() {
    command -v script >/dev/null || {
        say "skipped: script (of bsdutils) is not installed"
        exit 77
    }
    local line
    printf -v line '%q ' "$zskel" extract cube.obj "${fast[@]}" -o a.json
    label="$line on a terminal"
    script -qec "$line" /dev/null >typescript </dev/null || fail "exit code $?"
    grep -q 'settle' typescript || fail "no progress bar"
    is_json a.json || fail "no JSON"
    printf -v line '%q ' "$zskel" -q extract cube.obj "${fast[@]}" -o a.json
    script -qec "$line" /dev/null >typescript </dev/null || fail "exit code $?"
    [[ ! -s typescript ]] || fail "-q draws a progress bar"
    printf -v line '%q ' "$zskel" --log-format json extract cube.obj "${fast[@]}" -o a.json
    script -qec "$line" /dev/null >typescript </dev/null || fail "exit code $?"
    [[ ! -s typescript ]] || fail "a progress bar between lines of JSON"
}

case_output() {
    # Moved and scaled: positions must come back in the file's coordinates. The last vertex has no face.
    awk '$1 == "v" { printf "v %.6f %.6f %.6f\n", $2 * 10 + 100, $3 * 10 - 50, $4 * 10; next } { print }' \
        "$models/capsule.obj" >moved.obj
    echo 'v 101 -51 0' >>moved.obj
    run 0 extract moved.obj "${fast[@]}" -o a.json --with-paths
    cp a.json first.json
    run 0 extract moved.obj "${fast[@]}" -o a.json --with-paths
    cp a.json second.json
    run 0 --threads 1 extract moved.obj "${fast[@]}" -o one.json --with-paths
    run 0 extract moved.obj "${fast[@]}" -o a.obj
    run 0 extract moved.obj "${fast[@]}" --format obj
    cmp -s out a.obj || fail "--format obj differs from a name in .obj"
    run 0 extract moved.obj "${fast[@]}" --format json -o named.obj
    is_json named.obj || fail "--format json does not rule over the name"
    run 0 check --json moved.obj
    label='the JSON of extract'
    /usr/bin/python3 - <<'END' || fail "not as promised"
import json, re
first, second, one = (open(f + ".json").read() for f in ("first", "second", "one"))
untimed = lambda text: re.sub(r'"seconds": ?\{[^}]*\}', "", text)
assert first != untimed(first)
assert untimed(first) == untimed(second), "the same command twice gives different bytes"
s, single, report = json.loads(first), json.loads(one), json.load(open("out"))
for key in ("nodes", "edges", "vertex_node", "seeds"):
    assert s[key] == single[key], f"{key} depend on the number of threads"
assert (s["format"], s["version"]) == ("zskel-skeleton", 1)
vertices = [tuple(map(float, l.split()[1:])) for l in open("moved.obj") if l.startswith("v ")]
low, high = (tuple(f(v[i] for v in vertices) for i in range(3)) for f in (min, max))
nodes = s["nodes"]
assert nodes
for i, node in enumerate(nodes):
    assert node["id"] == i and node["radius"] > 0 and node["solid"] == 0
    assert all(l < x < h for l, x, h in zip(low, node["position"], high)), node
assert all(e["source"] < len(nodes) and e["target"] < len(nodes) and e["source"] != e["target"] for e in s["edges"])
of_vertex = s["vertex_node"]
assert len(of_vertex) == len(vertices) == report["vertices"]
assert of_vertex[-1] == -1 and all(0 <= n < len(nodes) for n in of_vertex[:-1])
assert set(of_vertex[:-1]) == set(range(len(nodes))), "a node that no vertex belongs to"
t = s["statistics"]
assert (t["nodes"], t["edges"], t["components"], t["cycles"]) == (len(nodes), len(s["edges"]), 1, 0), t
assert t["vertices"] == len(vertices) - 1 and t["seeds"] == len(s["seeds"]) and t["solids"] == 1
assert sum(t["seed_states"].values()) == t["seeds"] and t["evaluations"] >= t["seeds"]
assert t["seconds"]["total"] > 0
assert isinstance(s["warnings"], list)
p = s["provenance"]
assert p["program"] == "zskel" and re.fullmatch(r"\d+\.\d+\.\d+", p["program_version"])
assert p["command"].startswith("zskel extract moved.obj") and p["model"] == "moved.obj"
assert p["model_xxh3"] == report["hash"] and re.fullmatch("[0-9a-f]{16}", p["model_xxh3"])
o = p["options"]
assert (o["method"], o["backend"], o["face_px"]) == ("paper", "ray", 4), o
assert o["step_world"] == 0.02, o
b = p["backend"]
assert b["name"] == "ray" and b["vendor"] and b["renderer"] and b["version"] and b["failed"] == []
assert p["world_from_model"]["scale"] > 0 and len(p["world_from_model"]["center"]) == 3
for seed in s["seeds"]:
    assert seed["path"][0] == seed["start"] and seed["path"][-1] == seed["end"]
    assert of_vertex[seed["vertex"]] == seed["node"]
lines = [l.split() for l in open("a.obj") if not l.startswith("#")]
assert [[float(x) for x in l[1:]] for l in lines if l[0] == "v"] == [n["position"] for n in nodes]
assert [[int(x) - 1 for x in l[1:]] for l in lines if l[0] == "l"] == [[e["source"], e["target"]] for e in s["edges"]]
END
}

# Names neither EGL's drivers nor OSMesa: no context can be had.
without_gl() {
    mkdir -p nothing
    printf 'not a library' | tee nothing/libOSMesa.so nothing/libOSMesa.so.6 >nothing/libOSMesa.so.8
    export __EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent LD_LIBRARY_PATH=$PWD/nothing
}

case_no_backend() {
    refused 4 '99' extract cube.obj --gpu 99 -o a.json
    without_gl
    local backend
    for backend in gl egl osmesa; do refused 4 "$backend" extract cube.obj --backend "$backend" -o a.json; done
    refused 4 'gl' compare cube.obj --backend gl
    # At once: the work that these options ask for would take hours.
    local hours=(--method paper --backend ray --face-px 64 --step 0.000001 --max-steps 1000000)
    label='a picture without GL'
    timeout 20 "$zskel" extract cube.obj "${hours[@]}" -o a.json --picture a.png >out 2>err
    (($? == 4)) || fail "not refused at once"
    timeout 20 "$zskel" extract cube.obj "${hours[@]}" -o a.json --picture-paths a.png >out 2>err
    (($? == 4)) || fail "not refused at once"
    only_files . cube.obj nothing nothing/libOSMesa.so{,.6,.8} out err
    run 0 extract cube.obj --method paper --face-px 4 --step 0.02 -o a.json
    /usr/bin/python3 - <<'END' || fail "the JSON does not say so"
import json
backend = json.load(open("a.json"))["provenance"]["backend"]
assert backend["name"] == "cpu" and backend["failed"] == []
END
    run 0 doctor --json
    /usr/bin/python3 - <<'END' || fail "doctor does not say so"
import json
found = json.load(open("out"))
assert found["auto_takes"] == "cpu" and found["gl_takes"] is None and found["candidates"]
assert found["cpu"]["instruction_set"]
assert all(not c["usable"] and c["reason"] and c["advice"] for c in found["candidates"])
END
}

case_formats() {
    local form
    for form in graphml swc obj ply vtp polylines.txt gltf glb; do
        run 0 extract cube.obj "${fast[@]}" -o "a.$form"
        [[ -s a.$form ]] || fail "nothing in a.$form"
    done
    # What does not go together is refused before any work: this would take hours.
    local hours=(--method paper --backend ray --face-px 64 --step 0.000001 --max-steps 1000000)
    refused 2 'a.txt' extract cube.obj "${hours[@]}" -o a.txt
    refused 2 '--tubes' extract cube.obj "${hours[@]}" --tubes -o a.swc
    refused 2 '--node-link' extract cube.obj "${hours[@]}" --node-link -o a.swc
    refused 2 '--with-seeds' extract cube.obj "${hours[@]}" --with-seeds -o a.swc
    refused 2 'two outputs' extract cube.obj "${hours[@]}" -o b.vtp --correspondence b.vtp
    run 0 extract cube.obj "${fast[@]}" -o a.json --correspondence a.correspondence.polylines.txt
    [[ $(grep -c '^2 ' a.correspondence.polylines.txt) == $(grep -c '^v ' cube.obj) ]] || fail "the correspondence"

    run 0 convert a.json -o odd.name --format swc
    cmp -s <(grep -v '^#' odd.name) <(grep -v '^#' a.swc) || fail "extract and convert differ"
    run 0 convert a.json --node-link
    is_json out || fail "no JSON"
    "$zskel" convert - --from swc --format graphml <a.swc >out 2>err || fail "streams: exit code $?"
    grep -q '<graphml' out || fail "no GraphML"
    run 0 convert a.swc -o b.obj
    grep -q '^zskel: warning: b.obj: the radii' err || fail "no warning that radii are lost"
    run 0 convert b.obj -o b.polylines.txt
    [[ ! -s err ]] || fail "a warning about radii that were not there"
    refused 2 '--radius' convert b.obj -o b.swc
    refused 2 '--radius' convert b.obj --tubes -o c.obj
    run 0 convert b.obj --radius 0.25 -o b.swc
    refused 2 '--radius' convert b.swc --radius 1 -o b.json
    refused 2 '--from' convert - -o b.json
    refused 2 'glb' convert a.glb -o b.json
    refused 2 'b.swc' convert b.swc -o ./b.swc
    refused 2 'a.txt' convert b.swc -o a.txt
    refused 2 'nosuch' convert b.swc --format nosuch
    refused 3 'zskel extract' convert cube.obj -o b.json
    refused 3 'none.swc' convert none.swc
    printf '1 0 0 0 0 1 -1\n2 0 0 0 x 1 1\n' >bad.swc
    echo old >kept.json
    refused 3 "bad.swc:2: coordinate z 'x'" convert bad.swc -o kept.json
    [[ $(cat kept.json) == old ]] || fail "the output that was there is gone"
    refused 5 'none/b.json' convert b.swc -o none/b.json
}

case_check_failed() {
    run 0 compare cube.obj --backend ray --against brute --face-px 4 --eyes 4
    run 0 compare cube.obj --backend ray --against brute --face-px 4 --eyes 4 --json
    grep -qE '"within_bounds": ?true' out || fail "not within bounds"
    # A needle thinner than a float can tell: rays and the plain sum over triangles cannot agree.
    printf 'OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1e-9\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n' >needle.off
    run 6 compare needle.off --backend brute --against ray --face-px 8 --eyes 8
    run 6 compare needle.off --backend brute --against ray --face-px 8 --eyes 8 --json
    grep -qE '"within_bounds": ?false' out || fail "the JSON does not say so"
    # A skeleton that fails its self-check is written all the same; --strict says so by the exit code.
    # The paper's clusters of a whole torus have their centre in its hole.
    local torus=$models/torus.obj
    run 0 extract "$torus" --backend ray --face-px 8 --strict -o sound.json
    run 0 extract "$torus" --backend ray --face-px 4 --method paper --cluster 2 -o loose.json
    run 6 extract "$torus" --backend ray --face-px 4 --method paper --cluster 2 --strict -o strict.json
    is_json strict.json
    grep -q '"is_sound":true' sound.json || fail "a sound skeleton is not called so"
    grep -q '"is_sound":false' strict.json || fail "a skeleton that leaves the solid is called sound"
}

case_gl_backends() {
    run 0 doctor --json
    local taken backend
    taken=$(/usr/bin/python3 -c 'import json; print(json.load(open("out"))["gl_takes"])')
    if [[ $taken == None ]]; then
        [[ ${ZSKEL_REQUIRE_GL:-} == 1 ]] && fail "no GL context, though ZSKEL_REQUIRE_GL=1"
        say "skipped: no GL context"
        ((failures)) && exit 1
        exit 77
    fi
    for backend in gl egl; do
        [[ $taken == osmesa && $backend == egl ]] && continue
        run 0 extract cube.obj --method paper --backend "$backend" --face-px 4 --step 0.05 -o a.json \
            --picture a.png --picture-width 64 --picture-height 48
        /usr/bin/python3 - "$taken" <<'END' || fail "the JSON is not as promised"
import json, sys
backend = json.load(open("a.json"))["provenance"]["backend"]
assert backend["name"] == sys.argv[1] and backend["renderer"] and backend["version"], backend
END
        is_png a.png 64 48 || fail "the picture is not as promised"
    done
    run 0 deform --demo hand --backend ray --face-px 6 --frames 4
    is_png hand.png 1800 480 || fail "no strip"
    grep -aq '"animations"' hand.glb || fail "no animation"
    echo '{"moves": [{"near": [0, 1, 0], "bend": 60, "axis": [0, 0, 1]}]}' >bend.json
    run 0 deform "$models/y.obj" --backend ray --face-px 6 --pose bend.json -o - --strip y.png --strip-frames 2 --view 20,10
    is_png y.png 600 480 || fail "no strip"
    ln -s /dev/full full
    refused 5 'full' extract cube.obj "${fast[@]}" -o a.json --picture full
    [[ -c full ]] || fail "the device was replaced"
    # Without EGL: OSMesa answers where it is installed, and nothing that was asked for by name is replaced.
    export __EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent
    refused 4 'egl' extract cube.obj --backend egl -o b.json
    [[ ! -e b.json ]] || fail "an output after a failure"
    local code=0
    "$zskel" extract cube.obj --method paper --backend osmesa --face-px 4 --step 0.05 -o b.json 2>err || code=$?
    if ((code == 0)); then
        grep -qE '"name": ?"osmesa"' b.json || fail "asked for osmesa, got another"
    else
        ((code == 4)) || fail "exit code $code"
    fi
}

if [[ ${1:-} == --list ]]; then
    declare -F | sed -n 's/^declare -f case_//p'
    exit 0
fi
zskel=$(realpath "$1")
models=$(realpath "$2")
here=$(dirname "$(realpath "$0")")
shift 2
scratch=$(mktemp -d)
trap 'chmod -R u+rwx "$scratch"; rm -rf "$scratch"' EXIT
for name in "$@"; do
    mkdir "$scratch/$name"
    cp "$models/cube_coarse.obj" "$scratch/$name/cube.obj"
    cd "$scratch/$name" || exit 1
    "case_$name"
done
((failures == 0)) || say "$failures failures"
exit $((failures > 0))
