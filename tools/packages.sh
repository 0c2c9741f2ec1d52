#!/usr/bin/env bash
# The packages as they would go out hold what they need: unpacked side by side, they are checked against each other. `tools/packages.sh full` lets
# cargo build each against those before it, as from a registry: minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
export CARGO_TERM_COLOR=never

# from a clean tree in CI; by hand from the tree as it is
dirty=(--allow-dirty)
[[ -z ${CI:-} ]] || dirty=()
if [[ ${1:-} == full ]]; then
    # cargo keeps what it unpacked and built of the same versions before, and would build against that instead of today's
    rm -rf target/verified "${CARGO_HOME:-$HOME/.cargo}"/registry/{src,cache}/*/carom-{[0-9],cfd-,cli-,c-,lab-,report-,table-,track-,web-}*
    exec cargo package --workspace --locked --target-dir target/verified "${dirty[@]}"
fi
unpacked=target/unpacked
rm -rf target/package "$unpacked"
mkdir -p "$unpacked"
cargo package --workspace --locked --no-verify "${dirty[@]}"
# with today's times (-m), not those in the package, by which cargo would take it for what it has checked before
for crate in target/package/*.crate; do tar -xzmf "$crate" -C "$unpacked"; done
cp Cargo.lock "$unpacked"
{
    printf '[workspace]\nresolver = "3"\nmembers = ["*"]\n[patch.crates-io]\n'
    for folder in "$unpacked"/*/; do
        folder=$(basename "$folder")
        printf '%s = { path = "%s" }\n' "${folder%-[0-9]*}" "$folder"
    done
    # so that what the lints have checked of others' crates holds here too
    sed -n '/^\[profile.dev\]/,/^$/p' Cargo.toml
} >"$unpacked/Cargo.toml"
cargo check --workspace --locked --manifest-path "$unpacked/Cargo.toml" --target-dir target
