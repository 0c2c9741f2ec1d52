#!/bin/bash
# A run in N parts by GNU parallel, then the merging:
#
#   gnu-parallel.sh CASE.toml OUT N [options of parallel, such as --sshloginfile nodes.txt]
#
# Start it again to go on with what was interrupted.
set -euo pipefail

usage="usage: gnu-parallel.sh CASE.toml OUT N [options of parallel]"
case_file=$(realpath "${1:?$usage}")
out=$(realpath --canonicalize-missing "${2:?$usage}")
parts=${3:?$usage}
shift 3

# one thread for each part, as many parts at a time as there are cores
seq "$parts" | parallel --halt soon,fail=1 --quote "$@" \
    carom run "$case_file" --out "$out/parts/{}-of-$parts" --shard "{}/$parts" --threads 1 --resume >/dev/null

mapfile -t folders < <(seq --format "$out/parts/%g-of-$parts" "$parts")
carom merge "${folders[@]}" --out "$out"
