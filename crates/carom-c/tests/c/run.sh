#!/usr/bin/env bash
# Installs the library into a folder of its own, compiles the C and C++ tests against it with warnings as errors, shared and static, runs
# them, runs them again under valgrind, and does what docs/c.md says.
set -euo pipefail
root=$(cd "$(dirname "$0")/../../../.." && pwd)
here=$root/crates/carom-c/tests/c
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
missing=()
command -v cc >/dev/null || missing+=(gcc libc6-dev)
command -v c++ >/dev/null || missing+=(g++)
command -v pkg-config >/dev/null || missing+=(pkg-config)
command -v valgrind >/dev/null || missing+=(valgrind)
if [ ${#missing[@]} -gt 0 ]; then
    apt-get update -qq && apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi

echo "-- docs/c.md, as it stands"
export CARGO_HOME=${CARGO_HOME:-$HOME/.cargo} RUSTUP_HOME=${RUSTUP_HOME:-$HOME/.rustup}
awk '/^```sh$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$root/docs/c.md" >"$work/doc.sh"
test -s "$work/doc.sh"
(cd "$root" && HOME=$work bash -euo pipefail "$work/doc.sh") >"$work/doc.out"
# it prints what the page says it prints
awk '/^```text$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$root/docs/c.md" >"$work/said"
grep -v "^carom .* is in " "$work/doc.out" >"$work/printed"
diff "$work/said" "$work/printed"

prefix=$work/carom
export PKG_CONFIG_PATH=$prefix/lib/pkgconfig
flags="-g -O1 -Wall -Wextra -Werror -pedantic -Wshadow -Wconversion"
shared="$(pkg-config --cflags --libs carom) -Wl,-rpath,$prefix/lib"
static="$(pkg-config --cflags carom) $prefix/lib/libcarom.a $(sed -n 's/^Libs.private: //p' "$PKG_CONFIG_PATH/carom.pc")"
cc -std=c99 $flags "$here/test.c" $shared -lm -lpthread -o "$work/test-shared"
cc -std=c99 $flags "$here/test.c" $static -lm -lpthread -o "$work/test-static"
c++ -std=c++11 $flags "$here/test.cpp" $shared -o "$work/test-cpp"
cc -std=c99 $flags "$root/crates/carom-c/examples/impact.c" $shared -o "$work/impact"
for test in test-shared test-static test-cpp; do
    echo "-- $test, by itself and under valgrind"
    "$work/$test"
    valgrind --quiet --error-exitcode=9 --leak-check=full --show-leak-kinds=definite,indirect,possible \
        --errors-for-leak-kinds=definite,indirect "$work/$test"
done
readelf -d "$work/test-shared" | grep -q 'libcarom.so.0'
! readelf -d "$work/test-static" | grep -q 'libcarom'
