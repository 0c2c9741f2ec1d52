#!/usr/bin/env bash
# code_saturne with carom on Debian 12: installs what is missing (as root), builds, runs the channel on one process and on two, checks
# every impact against the C interface, checks that mistakes stop the run, draws the deposit.
# Usage: plugins/code_saturne/run.sh [FOLDER]   (default: a temporary one, removed at the end)
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
if [ $# -gt 0 ]; then
    mkdir -p "$1"
    work=$(cd "$1" && pwd)
else
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
fi
missing=()
command -v code_saturne >/dev/null || missing+=(code-saturne)
command -v gfortran >/dev/null || missing+=(gfortran)
command -v cc >/dev/null || missing+=(gcc libc6-dev)
command -v mpirun >/dev/null || missing+=(openmpi-bin)
if [ ${#missing[@]} -gt 0 ]; then
    apt-get update -qq && apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi
code_saturne info --version 2>/dev/null | head -1 || true

export CAROM=$work/carom USER=${USER:-root} OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMP_NUM_THREADS=1
"$root/crates/carom-c/install.sh" --prefix "$CAROM" >/dev/null
private=$(sed -n 's/^Libs.private: //p' "$CAROM/lib/pkgconfig/carom.pc")
cc -std=c99 -O2 -Wall -Wextra -Werror -pedantic "$here/check.c" -I"$CAROM/include" "$CAROM/lib/libcarom.a" $private -o "$work/check"

rm -rf "$work/channel"
case=$work/channel/case
mkdir -p "$work/channel/MESH" "$case/SRC" "$case/DATA" "$case/RESU"
"$here/case/mesh.sh" >"$work/channel/MESH/channel.msh"
cp "$here"/case/SRC/* "$here"/src/* "$here"/../wall-table/* "$case/SRC/"
cp "$here"/case/DATA/* "$case/DATA/"

run() { # id, options
    (cd "$case" && code_saturne run --id "$1" "${@:2}" >"$work/$1.log" 2>&1)
}
checked() { # id
    local result=$case/RESU/$1
    if grep -n "warning" "$result/compile.log"; then
        echo "the plug-in compiles with warnings" >&2
        return 1
    fi
    grep -A4 "^carom .*: impacts by zone" "$result/listing"
    (cd "$result" && "$work/check" walls.toml:glass impacts*.csv) | tee "$work/$1.check"
    # the field of the deposit, integrated over the floor's faces of one size (EnSight Gold: floats after 244 bytes), is the captured mass
    od -An -v -tf4 -w4 -j244 "$result"/postprocessing/results_boundary.deposit_*.00001 | awk -v log_="$(
        awk '$1 == "floor" { print $4 }' <(grep -A4 "^carom .*: impacts by zone" "$result/listing"))" '
        { sum += $1 } END { mass = sum * 0.4 * 0.02 / 240; d = mass / log_ - 1; exit !(d < 1e-4 && d > -1e-4) }'
    # the log's counts are the record's
    awk '$1 == "floor" || $1 == "ceiling" { r += $2; c += $3 } END { printf "rebounds %d, captures %d,", r, c }' \
        <(grep -A4 "^carom .*: impacts by zone" "$result/listing") | grep -qFf - "$work/$1.check"
}
for n in 1 2; do
    echo "-- $n process(es)"
    run "on-$n" -n $n || { tail -5 "$work/on-$n.log"; cat "$case/RESU/on-$n/error"* 2>/dev/null; exit 1; }
    checked "on-$n"
done

echo "-- a wall that scatters: each impact with its own draws"
cp "$case/DATA/walls.toml" "$work/smooth.toml"
printf 'roughness_angle = "4 deg"\n' >>"$case/DATA/walls.toml"
run scatter -n 2 || { tail -5 "$work/scatter.log"; exit 1; }
(cd "$case/RESU/scatter" && "$work/check" walls.toml:glass impacts*.csv)
# four uniform numbers an impact: none of them twice, their mean within five standard errors, 1/sqrt(12 n), of a half
cat "$case"/RESU/scatter/impacts*.csv | awk -F, '
    $1 == "zone" { next }
    { n++; for (i = NF - 3; i <= NF; i++) { twice += seen[$i]++; sum += $i; wrong += $i < 0 || $i >= 1 } }
    END { d = (sum / (4 * n) - 0.5) * sqrt(48 * n); printf "%d impacts, draws in all %d, twice %d, mean off by %.1f standard errors\n", n, 4 * n, twice, d
          exit !(n > 1000 && twice == 0 && wrong == 0 && d < 5 && d > -5) }'
cp "$work/smooth.toml" "$case/DATA/walls.toml"

echo "-- without loss, particles end where code_saturne's own rebound leads them"
table=$case/DATA/carom-walls.txt
printf '[law.mirror]\nnormal = "constant"\nrestitution = 1\ntangential_restitution = 1\n' >>"$case/DATA/walls.toml"
printf 'zone floor walls.toml:mirror\nrecord impacts\n' >"$table"
run mirror
printf 'zone ceiling walls.toml:mirror\nrecord impacts\n' >"$table"
run own
test "$(wc -l <"$case/RESU/mirror/impacts.csv")" -gt 1000
test "$(wc -l <"$case/RESU/own/impacts.csv")" -eq 1
paste <(od -An -v -tf4 -w4 "$case/RESU/mirror/postprocessing/particles.geo.00001") \
    <(od -An -v -tf4 -w4 "$case/RESU/own/postprocessing/particles.geo.00001") | awk '
    $1 != $2 { d = $1 - $2; d = d < 0 ? -d : d; if (d > most) most = d }
    END { printf "%d numbers, greatest difference of a coordinate %.1g m\n", NR, most; exit !(NR > 1000 && most < 1e-6) }'
cp "$here"/case/DATA/* "$case/DATA/"

echo "-- mistakes stop the run and are named"
stops() { # id, text wanted
    if run "$1"; then
        echo "'$1' did not stop" >&2
        return 1
    fi
    grep -h -m1 -F "$2" "$case/RESU/$1/error"* || { cat "$case/RESU/$1/error"*; return 1; }
}
sed -i 's/:glass/:glas/' "$table"
stops unknown-law "carom: carom-walls.txt:2: zone floor: walls.toml: no law 'glas'; did you mean glass?"
sed -i 's/:glas$/:glass/; s/^zone floor/zone flor/' "$table"
stops unknown-zone "carom: carom-walls.txt:2: zone flor is no boundary zone of this case; known are"
cp "$here/case/DATA/carom-walls.txt" "$table"
sed -i 's/"copper"/"coper"/' "$case/DATA/walls.toml"
stops unknown-material "walls.toml:2:10: unknown material 'coper'; did you mean copper?"
cp "$here/case/DATA/walls.toml" "$case/DATA/walls.toml"
ln -s /dev/full "$work/full.csv"
sed -i "s|^record .*|record $work/full|" "$table"
stops full-disk "carom: the record of impacts $work/full.csv cannot be written: No space left on device"
cp "$here/case/DATA/carom-walls.txt" "$table"
rm "$CAROM/lib/libcarom.a"
if run no-library; then
    echo "a missing library did not stop the run" >&2
    exit 1
fi
grep -h -m1 "libcarom.a" "$case/RESU/no-library/compile.log"

"$here/draw.sh" "$case/RESU/on-1"/impacts.csv >"$work/deposit.svg"
test "$(grep -c '<circle' "$work/deposit.svg")" -gt 100
echo "the picture: $work/deposit.svg; for ParaView: $case/RESU/on-1/postprocessing/RESULTS_BOUNDARY.case"
