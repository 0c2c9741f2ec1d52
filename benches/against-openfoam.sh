#!/usr/bin/env bash
# carom and OpenFOAM in turn on one case, on one core: 200 000 spheres in a closed box of still air for 50 ms.
#
#   benches/against-openfoam.sh            five runs of each; asks apt for OpenFOAM 1912 where it is missing (Debian 12, root)
#   RUNS=9 CORE=0 CELLS=10 benches/against-openfoam.sh
#
# OpenFOAM runs twice: on a mesh of 20 cells along each edge (CELLS) with the settings its tutorials come with, and as fast
# as it can be made on this case: one cell, no sub-steps. Both then read the same stored vortex on the mesh. carom's command is built first; CAROM names another one.
set -euo pipefail
cd "$(dirname "$0")/.."

runs=${RUNS:-5} core=${CORE:-1} cells=${CELLS:-20}
solver=icoUncoupledKinematicParcelFoam
export WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam} LC_ALL=C
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for number in "$runs" "$cells"; do
    [[ $number =~ ^[1-9][0-9]*$ ]] || { echo "RUNS and CELLS are whole numbers from 1: '$number'" >&2; exit 2; }
done
taskset -c "$core" true || { echo "CORE=$core: no such core here" >&2; exit 2; }
if ! command -v "$solver" >/dev/null; then
    apt-get install -y --no-install-recommends openfoam >"$work/apt.log" 2>&1 || { tail -5 "$work/apt.log" >&2; exit 1; }
fi
carom=${CAROM:-}
if [[ -z $carom ]]; then
    cargo build --release --quiet -p carom-cli
    carom=${CARGO_TARGET_DIR:-target}/release/carom
fi

# --- the case, from carom's own file -------------------------------------------------------------------------------

case=benches/closed-box.toml
edge=0.022 particles=200000 steps=50

# carom's spheres where they start, one row each: the first points of their paths
sed -e 's/^until = .*/until = "1 ns"/' -e "s/^trajectories = .*/trajectories = $particles/" "$case" >"$work/start.toml"
"$carom" run "$work/start.toml" --out "$work/start" >/dev/null 2>&1
awk -F, 'NR > 1 && $2 == 0' "$work/start/trajectories.csv" >"$work/start.csv"
[[ $(wc -l <"$work/start.csv") -eq $particles ]] || { echo "the start of all $particles spheres was not written" >&2; exit 1; }
rm -r "$work/start"

# dictionary CLASS NAME: what every file of OpenFOAM starts with
dictionary() { echo "FoamFile { version 2.0; format ascii; class $1; object $2; }"; }

# the air's velocities in the cells: at rest, or a vortex that fills the box, at 2 m/s at most
air() {
    if [[ $1 == still ]]; then echo "uniform (0 0 0);"; return; fi
    awk -v n="$2" 'BEGIN { pi = atan2(0, -1); printf "nonuniform List<vector> %d (\n", n * n * n
        for (k = 0; k < n; k++) for (j = 0; j < n; j++) for (i = 0; i < n; i++) {
            x = pi * (i + 0.5) / n; y = pi * (j + 0.5) / n
            printf "(%.17g %.17g 0)\n", 2 * sin(x) * cos(y), -2 * cos(x) * sin(y) }
        print ");" }'
}

# write_case FOLDER CELLS MAXCO INTERPOLATION AIR [FUNCTIONS]: a case on a mesh of that many cells along each edge
write_case() {
    local foam=$1 cells=$2 maxco=$3 interpolation=$4 air=$5 functions=${6:-} write=1000 cloud=$1/0/lagrangian/kinematicCloud state=$1/0/uniform/lagrangian/kinematicCloud
    if [[ -n $functions ]]; then write=$steps; fi
    mkdir -p "$cloud" "$state" "$foam/constant" "$foam/system"
    { dictionary dictionary blockMeshDict; cat <<END
scale $edge;
vertices ((0 0 0) (1 0 0) (1 1 0) (0 1 0) (0 0 1) (1 0 1) (1 1 1) (0 1 1));
blocks (hex (0 1 2 3 4 5 6 7) ($cells $cells $cells) simpleGrading (1 1 1));
edges ();
boundary (walls { type wall; faces ((0 4 7 3) (1 2 6 5) (0 1 5 4) (3 7 6 2) (0 3 2 1) (4 5 6 7)); });
END
    } >"$foam/system/blockMeshDict"
    { dictionary dictionary controlDict; cat <<END
application $solver;
startFrom startTime; startTime 0; stopAt endTime; endTime 0.05; deltaT 1e-3;
writeControl timeStep; writeInterval $write; writeFormat ascii; writePrecision 8; runTimeModifiable no;
END
    } >"$foam/system/controlDict"
    { dictionary dictionary fvSchemes
      echo "ddtSchemes { default none; } gradSchemes { default none; } divSchemes { default none; }"
      echo "laplacianSchemes { default none; } interpolationSchemes { default linear; }"; } >"$foam/system/fvSchemes"
    { dictionary dictionary fvSolution; echo "solvers {}"; } >"$foam/system/fvSolution"
    { dictionary uniformDimensionedVectorField g
      echo "dimensions [0 1 -2 0 0 0 0]; value (0 -9.81 0);"; } >"$foam/constant/g"
    { dictionary dictionary transportProperties
      echo "rhoInf 1.2; transportModel Newtonian; nu 1.5e-5;"; } >"$foam/constant/transportProperties"
    { dictionary dictionary turbulenceProperties; echo "simulationType laminar;"; } >"$foam/constant/turbulenceProperties"
    { dictionary volVectorField U
      echo "dimensions [0 1 -1 0 0 0 0]; internalField $(air "$air" "$cells")"
      echo "boundaryField { walls { type fixedValue; value uniform (0 0 0); } }"; } >"$foam/0/U"
    { dictionary dictionary kinematicCloudProperties; cat <<END
solution
{
    active true; coupled false; transient yes; cellValueSourceCorrection off; maxCo $maxco;
    sourceTerms { schemes {} }
    interpolationSchemes { rho cell; U $interpolation; mu cell; }
    integrationSchemes { U Euler; }
}
constantProperties { rho0 2500; youngsModulus 1e9; poissonsRatio 0.3; }
subModels
{
    particleForces { sphereDrag; gravity; }
    injectionModels {}
    dispersionModel none;
    patchInteractionModel localInteraction;
    localInteractionCoeffs { patches (walls { type rebound; e 0.95; mu 0.05; }); }
    surfaceFilmModel none; stochasticCollisionModel none; collisionModel none;
}
cloudFunctions { $functions }
END
    } >"$foam/constant/kinematicCloudProperties"
    { dictionary dictionary cloudProperties
      echo "geometry positions; processor0 { particleCount $particles; }"; } >"$state/cloudProperties"
    write_cloud "$cloud" "$cells"
    blockMesh -case "$foam" >"$foam/log.mesh" 2>&1 || { tail "$foam/log.mesh" >&2; return 1; }
}

# The cloud as if an earlier run had left it: the same starts, digit for digit, as carom's.
write_cloud() {
    local cloud=$1 cells=$2 diameters
    diameters=$(awk -F'"' '/^diameter/ { printf "%s ", $2 + 0 }' "$case")
    { dictionary "Cloud<basicKinematicCollidingParcel>" positions; echo "$particles ("
      awk -F, -v n="$cells" -v edge="$edge" '{
          printf "(%s %s %s) %d\n", $3, $4, $5, int($3 / edge * n) + n * (int($4 / edge * n) + n * int($5 / edge * n)) }' \
          "$work/start.csv"; echo ")"; } >"$cloud/positions"
    { dictionary vectorField U; echo "$particles ("
      awk -F, '{ printf "(%s %s %s)\n", $6, $7, $8 }' "$work/start.csv"; echo ")"; } >"$cloud/U"
    # the injections follow each other, with as many spheres each
    { dictionary scalarField d; echo "$particles ("
      awk -F, -v all="$particles" -v list="$diameters" 'BEGIN { n = split(list, d, " ") }
          { print d[int($1 * n / all) + 1] * 1e-6 }' "$work/start.csv"; echo ")"; } >"$cloud/d"
    { dictionary labelField origId; echo "$particles ("; cut -d, -f1 "$work/start.csv"; echo ")"; } >"$cloud/origId"
    local field value
    while read -r class field value; do
        { dictionary "$class" "$field"; echo "$particles{$value}"; } >"$cloud/$field"
    done <<END
labelField origProcId 0
labelField active 1
labelField typeId -1
scalarField nParticle 1
scalarField dTarget 0
scalarField rho 2500
scalarField age 0
scalarField tTurb 0
vectorField UTurb (0 0 0)
vectorField f (0 0 0)
vectorField angularMomentum (0 0 0)
vectorField torque (0 0 0)
labelFieldField collisionRecordsPairAccessed 0()
labelFieldField collisionRecordsPairOrigProcOfOther 0()
labelFieldField collisionRecordsPairOrigIdOfOther 0()
vectorFieldField collisionRecordsPairData 0()
labelFieldField collisionRecordsWallAccessed 0()
vectorFieldField collisionRecordsWallPRel 0()
vectorFieldField collisionRecordsWallData 0()
END
}

# --- hits, counted in runs that are not timed ----------------------------------------------------------------------

# The settings of OpenFOAM: cells along an edge, maxCo, interpolation of the air's velocity, the air.
tutorial=("$cells" 0.3 cellPoint still)
fastest=(1 1 cell still)
vortex=("$cells" 0.3 cellPoint vortex)

per_step() { awk -v n="$1" -v all="$((particles * steps))" 'BEGIN { printf "%.4f", n / all }'; }

hits_foam() {
    local foam=$work/hits
    write_case "$foam" "$@" "hits { type patchPostProcessing; maxStoredParcels 100000000; patches (walls); }"
    "$solver" -case "$foam" >"$foam/log" 2>&1 || { tail "$foam/log" >&2; return 1; }
    find "$foam/postProcessing" -name 'walls.post' -exec cat {} + | grep -vc '^#'
    rm -r "$foam"
}

hits_carom() { "$carom" run "$1" --json | awk -F'[:,]' '/"impacts"/ { n += $2 } END { print n }'; }

# the vortex for both, and carom's case that reads it: the same spheres, the walls a patch of the mesh
write_case "$work/vortex" "${vortex[@]}"
sed -e "s|^kind = \"still\"|kind = \"openfoam\"\ncase = \"$work/vortex\"\ntime = 0|" -e 's/^box = .*/patch = "walls"/' -e '/^name = "box"/d' \
    "$case" >"$work/vortex.toml"

hits=$(hits_carom "$case")
hits_vortex=$(hits_carom "$work/vortex.toml")
hits_foam_vortex=$(hits_foam "${vortex[@]}")
hits_tutorial=$(hits_foam "${tutorial[@]}")
hits_fastest=$(hits_foam "${fastest[@]}")

# --- timed, in turn ------------------------------------------------------------------------------------------------

# Processor time of the steps 2 to 50 of OpenFOAM, ns per parcel-step: reading and writing are not in it.
time_foam() {
    local foam=$1
    taskset -c "$core" "$solver" -case "$foam" >"$foam/log" 2>&1 || { tail "$foam/log" >&2; return 1; }
    awk -v n="$particles" '/^ExecutionTime/ { t[++k] = $3 }
        END { printf "%.1f\n", (t[k] - t[1]) / (k - 1) / n * 1e9 }' "$foam/log"
}

# Processor time of all of carom's command, ns per particle and millisecond.
time_carom() {
    local TIMEFORMAT='%U %S'
    { time taskset -c "$core" "$carom" run "$@" --threads 1 >/dev/null 2>"$work/carom.err"; } 2>"$work/time" ||
        { cat "$work/carom.err" >&2; return 1; }
    awk -v all="$((particles * steps))" '{ printf "%.1f\n", ($1 + $2) / all * 1e9 }' "$work/time"
}

median() { sort -n | awk '{ x[NR] = $1 } END { m = int((NR + 1) / 2); print NR % 2 ? x[m] : (x[m] + x[m + 1]) / 2 }'; }

write_case "$work/tutorial" "${tutorial[@]}"
write_case "$work/fastest" "${fastest[@]}"
sed 's/^impacts = .*/impacts = true/' "$case" >"$work/impacts.toml"

load() { cut -d' ' -f1-3 /proc/loadavg; }
declare -A ns=([tutorial]="" [fastest]="" [carom]="" [written]="" [vortex]="" [meshed]="")
echo "machine: $(lscpu | sed -n 's/^Model name: *//p'), $(nproc) cores; load before: $(load)"
row='%-5s %18s %18s %10s %22s %18s %14s\n'
printf "$row" "" "OpenFOAM, tutorial" "OpenFOAM, fastest" carom "carom, impacts written" "OpenFOAM, vortex" "carom, vortex"
for ((run = 1; run <= runs; run++)); do
    a=$(time_foam "$work/tutorial") b=$(time_carom "$case") c=$(time_foam "$work/fastest")
    d=$(time_carom "$work/impacts.toml" --out "$work/out")
    rm -r "$work/out"
    e=$(time_foam "$work/vortex") f=$(time_carom "$work/vortex.toml")
    ns[tutorial]+="$a " ns[carom]+="$b " ns[fastest]+="$c " ns[written]+="$d " ns[vortex]+="$e " ns[meshed]+="$f "
    printf "$row" "$run" "$a ns" "$c ns" "$b ns" "$d ns" "$e ns" "$f ns"
done

# median NUMBERS
median() { tr ' ' '\n' <<<"$1" | sed '/^$/d' | sort -n | awk '{ x[NR] = $1 } END { print (x[int((NR + 1) / 2)] + x[int(NR / 2) + 1]) / 2 }'; }
for name in "${!ns[@]}"; do ns[$name]=$(median "${ns[$name]}"); done
ratio() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.1f", a / b }'; }

# line NAME NS HITS
line() {
    printf '  %-28s %8s ns %10s %10s %14s\n' "$1" "$2" "$(ratio "$2" "${ns[carom]}")" "$(ratio "$2" "${ns[written]}")" \
        "$(per_step "$3")"
}

cat <<END

Medians of $runs, processor time per sphere and millisecond on core $core; load after: $(load)
                                            over carom  with impacts  hits per step
$(line "OpenFOAM, as in tutorials" "${ns[tutorial]}" "$hits_tutorial")
$(line "OpenFOAM, one cell" "${ns[fastest]}" "$hits_fastest")
$(line "carom" "${ns[carom]}" "$hits")
$(line "carom, impacts written" "${ns[written]}" "$hits")

A vortex of at most 2 m/s, stored on $cells^3 cells, read by both: OpenFOAM over carom $(ratio "${ns[vortex]}" "${ns[meshed]}")
$(line "OpenFOAM, as in tutorials" "${ns[vortex]}" "$hits_foam_vortex")
$(line "carom" "${ns[meshed]}" "$hits_vortex")

The same: the spheres' sizes, starts and velocities, digit for digit; the air, gravity and buoyancy; walls met by
centres; e = 0.95 and a tangential loss of 5 %; one core.
Different:
- OpenFOAM walks a mesh, here $cells cells along each edge, as it must where the flow is one. carom's box and still air
  are formulas. The one-cell run shows what is left without the walk.
- OpenFOAM takes steps of 1 ms, divided at cells and walls and where maxCo (0.3 in its tutorials, 1 in the one-cell run)
  says so, with an implicit Euler step of the velocity. carom chooses its steps for a relative error of 1e-5 in the time
  and speed of a first impact: a few steps for all 50 ms, besides the hits.
- Drag: OpenFOAM's sphereDrag has 1 + Re^(2/3)/6, carom Schiller and Naumann's 1 + 0.15 Re^0.687.
- OpenFOAM's time is that of its steps 2 to $steps, without reading or writing. carom's is its whole command: reading the
  case, making the spheres, tracking and the summary, and in the last line writing every impact to disk as well.
END
