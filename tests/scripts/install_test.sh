#!/usr/bin/env bash
# install_test.sh BUILD_DIR CONSUMER_DIR CMAKE: installs into an empty folder, then builds and runs a project that
# knows nothing but that folder.
set -euo pipefail
build=$1 consumer=$2 cmake=$3
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

"$cmake" --install "$build" --prefix "$scratch/prefix" >"$scratch/log" || {
    cat "$scratch/log"
    exit 1
}
for private in gl/api.h gl/program.h visibility/embree_scene.h mesh/formats.h mesh/text_cursor.h; do
    [[ ! -e $scratch/prefix/include/zskel/$private ]] || {
        echo "a private header is installed: $private"
        exit 1
    }
done
grep -rlF -e "$build" -e "$(dirname "$(dirname "$consumer")")" "$scratch/prefix/lib/"*/cmake "$scratch/prefix/lib/cmake" 2>/dev/null && {
    echo "the package names folders of the build"
    exit 1
}
"$cmake" -S "$consumer" -B "$scratch/build" -G Ninja -DCMAKE_BUILD_TYPE=Debug \
    -DCMAKE_PREFIX_PATH="$scratch/prefix" -Wno-dev
"$cmake" --build "$scratch/build"
"$scratch/build/consumer"
"$scratch/prefix/bin/zskel" --version
