#!/usr/bin/env bash
# neon_test.sh SOURCE_DIR: what the Z-buffer does by registers compiles for ARM, with NEON. Skipped (77) without the
# cross compiler.
set -euo pipefail
source=$1
compiler=aarch64-linux-gnu-g++
command -v "$compiler" >/dev/null || {
    echo "no $compiler (on Debian: apt-get install g++-aarch64-linux-gnu)" >&2
    exit 77
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# Header-only libraries; the rest of /usr/include is another machine's.
mkdir "$work/include"
ln -s /usr/include/hwy /usr/include/glm "$work/include"
for part in zbuffer_draw zbuffer_summarize; do
    "$compiler" -std=c++20 -O2 -march=armv8-a+crypto -ffp-contract=off -Wall -Wextra -Werror -I "$source/src" -isystem "$work/include" \
        -c "$source/src/zskel/visibility/$part.cpp" -o "$work/$part.o"
    aarch64-linux-gnu-nm -C "$work/$part.o" | grep -q 'zskel::N_NEON::' || {
        echo "$part.cpp holds nothing for NEON" >&2
        exit 1
    }
done
