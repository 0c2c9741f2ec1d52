#!/usr/bin/env bash
# Compiles the UDF against the stand-in udf.h with warnings as errors, in 2-D and 3-D, with both generations of macros and both precisions,
# plays Fluent to it, once also under valgrind. Fluent itself is not needed and not tested.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
missing=()
command -v cc >/dev/null || missing+=(gcc libc6-dev)
command -v valgrind >/dev/null || missing+=(valgrind)
if [ ${#missing[@]} -gt 0 ]; then
    apt-get update -qq && apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi
"$root/crates/carom-c/install.sh" --prefix "$work/carom" >/dev/null
cp "$here/../example/walls.toml" "$work/"
printf '[law.glass]\nsphere = "coper"\nsurface = "glass"\nnormal = "ea"\nfriction = 0.2\n' >"$work/bad.toml"
printf '' >"$work/none-needed.toml"
cd "$work"
for dimension in 1 0; do
    for kind in "" -DSTANDIN_OLD -DSTANDIN_SINGLE; do
        # as Fluent does: position-independent; -Wconversion is out, since in single precision udf.h's own macros convert
        cc -std=gnu99 -g -O1 -fPIC -Wall -Wextra -Werror -pedantic -Wshadow -DRP_2D=$dimension $kind -I"$here" -I"$here/../../wall-table" \
            -Icarom/include "$here/../../wall-table/carom_walls.c" "$here/../src/carom_dpm.c" "$here/harness.c" carom/lib/libcarom.a \
            $(sed -n 's/^Libs.private: //p' carom/lib/pkgconfig/carom.pc) -o harness
        printf '%s ' "-DRP_2D=$dimension $kind"
        ./harness
    done
    valgrind --quiet --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite,indirect ./harness
done
