#!/usr/bin/env bash
# Runs every cloud that the plug-in is compiled for in one of OpenFOAM's own tutorials, for a few steps, with a
# law that scatters on the walls and parcels thrown at them; every impact must be the core's. The colliding cloud is run by run.sh.
#
#   plugins/openfoam/build.sh && plugins/openfoam/tests/clouds.sh
set -euo pipefail
tests=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$tests/../../.." && pwd)
. "$tests/../environment.sh"
export LC_ALL=C FOAM_SIGFPE=true
tutorials=$(echo "${CAROM_OPENFOAM:-${XDG_CACHE_HOME:-$HOME/.cache}/carom-openfoam}"/*/openfoam-*/tutorials)

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cargo build --quiet --release --locked --manifest-path "$root/Cargo.toml" -p carom-c --example check_impacts
check=${CARGO_TARGET_DIR:-$root/target}/release/examples/check_impacts

quietly() { "$@" >log 2>&1 || { tail -30 log >&2; echo "failed: $*" >&2; exit 1; }; }
set_entry() { foamDictionary "$1" -entry "$2" -set "$3" >/dev/null; }

# cloud NAME SOLVER CLOUD TIME PATCHES [OPEN]: runs the case in the current folder until TIME with a law on PATCHES, parcels leave
# through the patches OPEN (regular expressions)
cloud() {
    local name=$1 solver=$2 cloud=$3 end=$4 patches=$5 open=${6:-}
    local properties=constant/${cloud}Properties
    cat >law.toml <<END
sphere = { density = 2500, young_modulus = "70 GPa", poisson_ratio = 0.22, surface_energy = 0.3 }
surface = "stainless-steel"
normal = "ea"
hertz_damping = 0.01
friction = 0.2
roughness_angle = "4 deg"
END
    set_entry $properties subModels/patchInteractionModel carom
    set_entry $properties subModels/caromCoeffs "{ patches { \"$patches\" { type law; file \"law.toml\"; }
        ${open:+\"$open\" { type escape; \}} } logImpacts yes; writeFields yes; }"
    set_entry system/controlDict libs '("libcaromOpenFOAM.so")'
    set_entry system/controlDict endTime "$end"
    quietly "$solver"

    local csv laws=() patch
    csv=$(echo postProcessing/lagrangian/"$cloud"/impacts/*/impacts.csv)
    for patch in $(awk -F, 'NR > 1 { print $2 }' "$csv" | sort -u); do
        laws+=("$patch=law.toml")
    done
    awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i } NR > 1 && $at["draw0"] != 0.5 { n++ } END { exit !n }' "$csv" ||
        { echo "$name: no draws for a wall that scatters" >&2; exit 1; }
    (( ${#laws[@]} )) || { echo "$name: no impact" >&2; exit 1; }
    echo "$name ($solver): $("$check" "$csv" "${laws[@]}" | tr '\n' ' ')"
}

# enter NAME TUTORIAL
enter() {
    cp -r "$tutorials/$2" "$work/$1"
    cd "$work/$1"
}

cp -r "$tests/box" "$work/kinematic"
cp -r "$tests"/kinematic/* "$work/kinematic"
cd "$work/kinematic"
quietly blockMesh
set_entry constant/kinematicCloudProperties solution/interpolationSchemes "{ rho cell; U cellPoint; thermo:mu cell; }"
cloud kinematic uncoupledKinematicParcelFoam kinematicCloud 0.05 "(floor|lid|side.*|window)"

enter mppic lagrangian/MPPICFoam/column
quietly blockMesh
set_entry constant/kinematicCloudProperties subModels/injectionModels/model1/U0 "(0.1 -0.5 0)"
cloud MPPIC MPPICFoam kinematicCloud 0.01 "(top|bottom)"

enter multiphase lagrangian/reactingParcelFoam/parcelInBox
quietly blockMesh
set_entry constant/reactingCloud1Properties subModels/injectionModels/model1/U0 "(20 20 0)"
cloud "reacting multiphase" reactingParcelFoam reactingCloud1 0.05 "(walls|inlet|outlet)"

enter thermo lagrangian/coalChemistryFoam/simplifiedSiwek
quietly blockMesh
quietly topoSet
set_entry system/controlDict functions "{}"
set_entry constant/limestoneCloud1Properties subModels/injectionModels/model1/U0 "(40 0 0)"
cloud thermo coalChemistryFoam limestoneCloud1 0.003 "(top|bottom|walls)"

enter heterogeneous lagrangian/reactingHeterogenousParcelFoam/rectangularDuct
quietly blockMesh
set_entry constant/reactingCloud1Properties subModels/injectionModels/model1/U0 "(1 40 1)"
cloud "reacting heterogeneous" reactingHeterogenousParcelFoam reactingCloud1 0.3 "walls" "(inlet|outlet)"

enter reacting combustion/fireFoam/LES/smallPoolFire2D
quietly blockMesh
quietly topoSet
quietly createPatch -overwrite
cp 0/ph_rgh.orig 0/ph_rgh
cp "$tests"/reacting/{reactingCloud1Properties,positions} constant/
set_entry constant/thermophysicalProperties liquids "{ H2O; }"
set_entry constant/thermophysicalProperties solids "{}"
cloud reacting fireFoam reactingCloud1 0.005 "(base|inlet)" "(outlet|sides)"
