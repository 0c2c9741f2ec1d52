#!/usr/bin/env bash
# Runs OpenFOAM with the plug-in and holds it against the core, itself in parallel and itself restarted; and asks for the messages
# of runs that must not start.
#
#   plugins/openfoam/build.sh && plugins/openfoam/tests/run.sh
#   STOPS=overwrite plugins/openfoam/tests/run.sh       writes the expected messages anew
set -euo pipefail
tests=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$tests/../../.." && pwd)
. "$tests/../environment.sh"
export LC_ALL=C OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 FOAM_SIGFPE=true

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
solver=icoUncoupledKinematicParcelFoam
properties=uniform/lagrangian/kinematicCloud/kinematicCloudOutputProperties
impacts=postProcessing/lagrangian/kinematicCloud/impacts

fail() { echo "$*" >&2; exit 1; }

# quietly LOG COMMAND...: shows the log's end only if the command fails
quietly() {
    local log=$1
    shift
    "$@" >"$log" 2>&1 || { tail -30 "$log" >&2; fail "failed: $*"; }
}

# new_case NAME: a copy of the box with its mesh; enters it
new_case() {
    cp -r "$tests/box" "$work/$1"
    cd "$work/$1"
    quietly log.mesh blockMesh
}

# set_entry FILE KEY VALUE
set_entry() { foamDictionary "$1" -entry "$2" -set "$3" >/dev/null; }

# counts FILE: what the model stored, in one form for all
counts() { sed -n '/^    carom$/,/^    }$/p' "$1"; }

# --- every impact is the core's -------------------------------------------------------------------------------------

cargo build --quiet --release --locked --manifest-path "$root/Cargo.toml" -p carom-c --example check_impacts
check=${CARGO_TARGET_DIR:-$root/target}/release/examples/check_impacts

# check_impacts CASE LOGS...
check_impacts() {
    local case=$1
    shift
    sed -n '/#{/,/#}/ { /#[{}]/d; p }' "$case/constant/kinematicCloudProperties" >"$work/floor.toml"
    awk 'FNR > 1 || NR == 1' "$@" >"$work/impacts.csv"
    "$check" "$work/impacts.csv" floor="$work/floor.toml" lid="$case/constant/walls.toml:sliding" \
        side{Left,Right,Back}="$case/constant/walls.toml:steel"
}

new_case serial
quietly log "$solver"
check_impacts . $impacts/0/impacts.csv | tee "$work/agreed"
logged=$(awk '{ n += $2; m += $5 } END { print n, m }' "$work/agreed")
stored=$(awk '/nRebound|nCapture/ { for (i = 4; i < NF; i++) n[$1] += $i } END { print n["nRebound"], n["nCapture"] }' 0.2/$properties)
[[ $logged == "$stored" ]] || fail "the log has $logged rebounds and captures, the counts say $stored"

spun=$(awk -F, 'NR > 1 && ($11 != 0 || $12 != 0 || $13 != 0) { n++ } END { print n + 0 }' $impacts/0/impacts.csv)
(( spun > 100 )) || fail "only $spun impacts with spin: it was not kept"

# frames: normals lead into the box, the lid's velocity is that of 0/U, sides that stand still have none
awk -F, 'NR > 1 {
    n = $2 == "lid" ? -$15 : $2 == "floor" ? $15 : $2 == "sideLeft" ? $14 : $2 == "sideRight" ? -$14 : 1
    if (n < 1 - 1e-12 || $17 != ($2 == "lid" ? 0.5 : 0) || $18 != 0 || ($19 - ($2 == "lid" ? 0.3 : 0))^2 > 1e-24) { print "wrong frame: " $0; exit 1 } }' \
    $impacts/0/impacts.csv >&2 || fail "a normal or a wall's velocity is wrong"

# --- two ranks capture what one does --------------------------------------------------------------------------------

new_case parallel
quietly log.decompose decomposePar
quietly log mpirun --oversubscribe -np 2 "$solver" -parallel
check_impacts . $impacts/0/impacts_processor?.csv >/dev/null
for rank in processor0 processor1; do
    diff <(counts ../serial/0.2/$properties | grep -v mass) <(counts $rank/0.2/$properties | grep -v mass) ||
        fail "one rank and two do not count the same"
done
new_case parallel-restarted
quietly log.decompose decomposePar
set_entry system/controlDict endTime 0.1
quietly log.first mpirun --oversubscribe -np 2 "$solver" -parallel
set_entry system/controlDict endTime 0.2
quietly log.second mpirun --oversubscribe -np 2 "$solver" -parallel
diff <(counts ../serial/0.2/$properties | grep -v mass) <(counts processor1/0.2/$properties | grep -v mass) ||
    fail "two ranks that were restarted do not count like one"
echo "two ranks count as one, restarted or not"

new_case four
set_entry system/decomposeParDict numberOfSubdomains 4
set_entry system/decomposeParDict simpleCoeffs.n "(4 1 1)"
quietly log.decompose decomposePar
quietly log mpirun --oversubscribe -np 4 "$solver" -parallel
diff <(counts ../serial/0.2/$properties | grep -v mass) <(counts processor3/0.2/$properties | grep -v mass) ||
    fail "four ranks do not count like one"

new_case two-then-three
quietly log.decompose decomposePar
set_entry system/controlDict endTime 0.1
quietly log.first mpirun --oversubscribe -np 2 "$solver" -parallel
quietly log.reconstruct reconstructPar
rm -r processor?
set_entry system/controlDict endTime 0.2
set_entry system/decomposeParDict numberOfSubdomains 3
set_entry system/decomposeParDict simpleCoeffs.n "(3 1 1)"
quietly log.decompose3 decomposePar -time 0.1 -copyUniform
quietly log.second mpirun --oversubscribe -np 3 "$solver" -parallel
diff <(counts ../serial/0.2/$properties | grep -v mass) <(counts processor2/0.2/$properties | grep -v mass) ||
    fail "two ranks that went on as three do not count like one"
echo "four ranks count as one, and two that go on as three"

# --- walls that scatter draw the same on any number of ranks ------------------------------------------------------

# patch, diameter, draws and fate of each impact: what scattering looks at, in an order of its own
drawn() { awk -F, 'FNR > 1 { print $2, $6, $20, $21, $22, $23, $24 }' "$@" | sort; }

# the parcels are injected on one rank, so that each has its number for life, and are then divided
new_case scatter
sed -i -e 's/^\( *\)surface = .*/&\n\1roughness_angle = "4 deg"/' constant/kinematicCloudProperties constant/walls.toml
set_entry system/controlDict writeInterval 5
set_entry system/controlDict endTime 0.005
quietly log.first "$solver"
cp -r . ../scatter-two
set_entry system/controlDict endTime 0.2
quietly log "$solver"
cd ../scatter-two
set_entry system/controlDict endTime 0.2
quietly log.decompose decomposePar -time 0.005 -copyUniform
quietly log mpirun --oversubscribe -np 2 "$solver" -parallel
drawn ../scatter/$impacts/0.005/impacts.csv >"$work/drawn.one"
drawn $impacts/0.005/impacts_processor?.csv >"$work/drawn.two"
awk '{ n++; for (i = 3; i <= 6; i++) { twice += seen[$i]++; sum += $i } }
     END { d = (sum / (4 * n) - 0.5) * sqrt(48 * n); exit !(n > 500 && twice == 0 && d < 5 && d > -5) }' "$work/drawn.one" ||
    fail "draws come twice or are not uniform"
diff -q "$work/drawn.one" "$work/drawn.two" >/dev/null ||
    fail "two ranks draw otherwise than one: $(comm -3 "$work/drawn.one" "$work/drawn.two" | wc -l) impacts"
echo "$(wc -l <"$work/drawn.one") impacts on walls that scatter have the same draws and fates on one rank and on two"

# --- a record that cannot be written ends the run -------------------------------------------------------------------

new_case full
mkdir -p $impacts/0
ln -s /dev/full $impacts/0/impacts.csv
if "$solver" >log 2>&1; then fail "a full disk did not end the run"; fi
grep -q "Cannot write .*/impacts.csv.* (logImpacts)" log || { tail -20 log >&2; fail "a full disk is not named"; }
echo "a record on a full disk ends the run"

# --- a run that was stopped goes on ---------------------------------------------------------------------------------

new_case restarted
set_entry system/controlDict endTime 0.1
quietly log.first "$solver"
set_entry system/controlDict endTime 0.2
quietly log.second "$solver"
diff <(counts ../serial/0.2/$properties) <(counts 0.2/$properties) || fail "the restarted run does not count like the whole one"
for field in massCaptured impacts impactSpeed impactAngle; do
    cmp ../serial/0.2/kinematicCloud:$field 0.2/kinematicCloud:$field || fail "the restarted run has another field $field"
done
echo "a stopped and restarted run ends as the whole one"

# --- what must not start --------------------------------------------------------------------------------------------

# message LOG: warnings and the error, without what depends on the machine or the source's lines
message() {
    awk '/^--> FOAM (Warning|FATAL)/ { on = 1 } /^Create mesh|^FOAM (exiting|aborting)/ { on = 0 }
         on && !/^ +(From function|in file) / { print }' "$1" |
        sed -E -e "s|$work/stop|CASE|g" -e 's/(unknown key .*) known are .*/\1/' -e 's/[[:space:]]+$//' | cat -s
}

# stop NAME COMMAND: the run with the case changed so must end before its first step, with the message in stops/NAME.txt
stop() {
    local name=$1 expected=$tests/stops/$1.txt
    rm -rf "$work/stop"
    new_case stop
    eval "$2"
    if { "$solver" >log 2>&1; } 2>/dev/null; then fail "$name: the run was not stopped"; fi
    if grep -q '^Time = ' log; then fail "$name: the run was stopped too late"; fi
    message log >got
    if [[ ${STOPS:-} == overwrite ]]; then
        cp got "$expected"
    fi
    diff "$expected" got || fail "$name: another message than $expected"
    echo "stopped: $name"
}

cloud=constant/kinematicCloudProperties
stop bad-law "sed -i 's/surface = \"glass\"/surface = \"galss\"/' $cloud"
stop bad-law-file "sed -i 's/^friction = 0.3/frictoin = 0.3/' constant/walls.toml"
stop no-law-of-that-name "sed -i 's/name sliding/name slidin/' $cloud"
stop no-law-file "sed -i 's|constant/walls.toml|constant/wals.toml|' $cloud"
stop neither-law-nor-file "sed -i 's|file \"constant/walls.toml\"; name sliding;||' $cloud"
stop unknown-patch "sed -i 's/\"side.\*\"/\"sied.*\"/' $cloud"
stop no-entry-for-a-patch "sed -i '/openings/d' $cloud"
stop unknown-type "sed -i 's/type escape/type escpae/' $cloud"
stop unknown-keyword "sed -i 's/name sliding/name sliding; e 0.9/' $cloud"
stop no-materials "sed -i 's|writeFields yes;|materials \"constant/materials.toml\";|' $cloud"
stop missing-library "sed -i 's/libcaromOpenFOAM/libcaromOpnFOAM/' system/controlDict"
echo "all is as it must be"
