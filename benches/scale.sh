#!/usr/bin/env bash
# Threads and memory of carom's command, on the closed box of closed-box.toml.
#
#   benches/scale.sh threads       one thread against two, in turn, by the clock: wants two quiet cores
#   benches/scale.sh memory [N...] peak memory of 2 and 20 million spheres (or N) for 2 ms, every impact written to disk:
#                                  150 bytes of file a sphere
#
# RUNS: how many of each, threads only (5). WORK: the folder for the memory runs' files (/tmp). CAROM: another command.
set -euo pipefail
cd "$(dirname "$0")/.."
export LC_ALL=C

carom=${CAROM:-}
if [[ -z $carom ]]; then
    cargo build --release --quiet -p carom-cli
    carom=${CARGO_TARGET_DIR:-target}/release/carom
fi
work=$(mktemp -d -p "${WORK:-/tmp}")
trap 'rm -rf "$work"' EXIT
load() { cut -d' ' -f1-3 /proc/loadavg; }

threads() {
    local runs=${RUNS:-5} case=$work/case.toml one two
    # a second or so of work: 2 million spheres
    sed 's/^count = .*/count = 250000/' benches/closed-box.toml >"$case"
    # seconds by the clock and of processors, of a run with that many threads
    seconds() {
        local TIMEFORMAT='%R %U %S'
        { time "$carom" run "$case" --threads "$1" >/dev/null 2>"$work/err"; } 2>&1 | awk '{ print $1, $2 + $3 }'
    }
    echo "load before: $(load)"
    for ((run = 1; run <= runs; run++)); do
        one=$(seconds 1) two=$(seconds 2)
        echo "$one $two" | tee -a "$work/times" |
            awk '{ printf "1 thread %s s (processor %s s), 2 threads %s s (%s s): %.2f\n", $1, $2, $3, $4, $1 / $3 }'
    done
    median() { cut -d' ' -f"$1" "$work/times" | sort -n | awk '{ x[NR] = $1 } END { print (x[int((NR + 1) / 2)] + x[int(NR / 2) + 1]) / 2 }'; }
    awk -v a="$(median 1)" -v b="$(median 3)" -v c="$(median 2)" -v d="$(median 4)" -v n="$runs" 'BEGIN {
        printf "medians of %d: %.2f times as fast by the clock, for %.2f times the processor time\n", n, a / b, d / c }'
    echo "load after: $(load)"
}

memory() {
    local spheres each
    for spheres in "$@"; do
        # the case has eight injections
        each=$((spheres / 8))
        sed -e "s/^count = .*/count = $each/" -e 's/^until = .*/until = "2 ms"/' -e 's/^impacts = .*/impacts = true/' \
            benches/closed-box.toml >"$work/case.toml"
        "$carom" run "$work/case.toml" --out "$work/out" >"$work/summary" 2>&1 &
        # the largest resident set the kernel has seen, read until the command is gone
        local pid=$! peak=0 now
        while now=$(awk '/^VmHWM/ { print $2 }' "/proc/$pid/status" 2>/dev/null) && [[ -n $now ]]; do
            peak=$now
            sleep 0.05
        done
        wait "$pid" || { cat "$work/summary" >&2; return 1; }
        printf '%d spheres: %d KiB at most, %s bytes of impacts\n' "$((8 * each))" "$peak" \
            "$(stat -c %s "$work/out/impacts.csv")"
        rm -r "$work/out"
    done
}

case ${1:-} in
    threads) threads ;;
    memory)
        shift
        if (($# == 0)); then set -- 2000000 20000000; fi
        memory "$@"
        ;;
    *) sed -n '2,9s/^# \{0,1\}//p' "$0" >&2; exit 2 ;;
esac
