#!/usr/bin/env bash
# score_test.sh SCORE ZSKEL MODELS: scores two models and one that is no model; the page and the JSON hold a row each.
set -euo pipefail
score=$1 zskel=$2 models=$3
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
echo "no mesh" >"$folder/broken.obj"

fail() {
    echo "score_test.sh: $*" >&2
    exit 1
}
run() { "$score" --program "$zskel" "$models/y.obj" "$models/torus.obj" "$@"; }

run --save "$folder/made" -o "$folder/page.html" --json "$folder/score.json" --strict -- --backend ray ||
    fail "two good models do not pass"
for name in y torus; do
    grep -q "<a href=\"#$name\">" "$folder/page.html" || fail "the page has no row $name"
    grep -q "\"model\": \"$name\"" "$folder/score.json" || fail "the JSON has no row $name"
done
grep -q '"failed": 0' "$folder/score.json" || fail "a model failed"

run --skeletons "$folder/made" --json "$folder/again.json" >/dev/null
cmp "$folder/score.json" "$folder/again.json" || fail "the same skeletons got other scores"

# Without any GL the page says so.
mkdir "$folder/nothing"
for version in so so.6 so.8; do echo "not a library" >"$folder/nothing/libOSMesa.$version"; done
__EGL_VENDOR_LIBRARY_FILENAMES=/nonexistent LD_LIBRARY_PATH=$folder/nothing run --skeletons "$folder/made" \
    -o "$folder/plain.html" >/dev/null 2>&1
grep -q "There are no pictures: " "$folder/plain.html" || fail "a page without GL does not say so"

code=0
run "$folder/broken.obj" --skeletons "$folder/made" --strict >"$folder/table" || code=$?
((code == 6)) || fail "--strict with a model that fails exits $code"
grep -q "broken .*failed:" "$folder/table" || fail "the model that failed has no row"

"$score" --compare "$folder/made/y.json" "$folder/made/y.json" "$models/y.obj" | grep -qx "hausdorff 0.000000" ||
    fail "a skeleton is apart from itself"
