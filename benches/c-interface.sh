#!/usr/bin/env bash
# Instructions (by valgrind's callgrind) and ns of processor time per impact, from Rust and through the C interface, on the same impacts.
# Usage: benches/c-interface.sh [ROUNDS of 512 impacts, default 20000]
set -euo pipefail
cd "$(dirname "$0")/.."
rounds=${1:-20000}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cargo build --release --locked -p carom-c --example cost
crates/carom-c/install.sh --prefix "$work" >/dev/null
cc -O2 crates/carom-c/examples/cost.c -I"$work/include" -L"$work/lib" -lcarom -Wl,-rpath,"$work/lib" -o "$work/cost"
rust=${CARGO_TARGET_DIR:-target}/release/examples/cost
instructions() { # of N and of 2N rounds; the difference is that of N rounds alone
    local n counts=()
    for n in 32 64; do
        counts+=("$(valgrind --tool=callgrind --callgrind-out-file=/dev/null "${@:2}" 2>&1 | sed -n 's/.*Collected : *//p')")
        set -- "$1" "$2" 64 "${@:4}"
    done
    echo "$1: $(((counts[1] - counts[0]) / 32 / 512)) instructions per impact"
}
instructions Rust "$rust" 32
instructions C "$work/cost" 32
instructions "C, batch" "$work/cost" 32 batch
instructions "C, columns (AVX2)" "$work/cost" 32 columns
TIMEFORMAT=%U # processor time: others may use the machine
for _ in 1 2 3 4 5 6 7; do
    for kind in "Rust:$rust" "C:$work/cost" "C, batch:$work/cost batch" "C, columns:$work/cost columns"; do
        read -r program option <<<"${kind#*:}"
        seconds=$({ time "$program" "$rounds" $option >/dev/null; } 2>&1)
        echo "${kind%%:*}: $(awk -v s="$seconds" -v n="$rounds" 'BEGIN { printf "%.1f", s * 1e9 / n / 512 }') ns per impact"
    done
done
