#!/usr/bin/env bash
# What the plug-in costs beside OpenFOAM's own localInteraction: parcels in a closed box of still air (22 mm, 20 cells along
# each edge, drag, gravity, steps of 1 ms), the colliding cloud without collisions.
#
#   plugins/openfoam/build.sh
#   plugins/openfoam/bench/cost.sh instructions    instructions of one correct(), counted by callgrind (needs valgrind)
#   plugins/openfoam/bench/cost.sh time            whole runs in turn, 200 000 parcels, 50 steps; RUNS=9 CORE=1
#
# callgrind counts what its virtual machine runs: AVX2 and FMA, never AVX-512.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../environment.sh"
export LC_ALL=C
mode=${1:-time} runs=${RUNS:-5} core=${CORE:-1}
solver=icoUncoupledKinematicParcelFoam
case $mode in
    instructions) per_injector=1000 steps=20 ;;
    time) per_injector=25000 steps=50 ;;
    *) echo "'$mode': instructions or time" >&2; exit 2 ;;
esac
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

quietly() { "$@" >"$work/log" 2>&1 || { tail -30 "$work/log" >&2; echo "failed: $*" >&2; exit 1; }; }

# --- the case -------------------------------------------------------------------------------------------------------

# The same pseudo-random positions for every model.
positions() {
    echo "FoamFile { version 2.0; format ascii; class vectorField; object positions; }"
    awk -v n="$per_injector" 'BEGIN {
        srand(1); print "("
        for (i = 0; i < n; i++) printf "(%.9f %.9f %.9f)\n", 0.001 + 0.02*rand(), 0.001 + 0.02*rand(), 0.001 + 0.02*rand()
        print ")" }'
}

# The eight injectors of benches/closed-box.toml: diameter and velocity.
injectors() {
    local n=0 d u
    while read -r d u; do
        echo "injector$((n++)) { type manualInjection; massTotal 0; parcelBasisType fixed; nParticle 1; SOI 0;
            positionsFile \"positions\"; U0 ($u);
            sizeDistribution { type fixedValue; fixedValueDistribution { value ${d}e-6; } } }"
    done <<END
60 3.6 2.4 -1.2
68 -2.0 3.2 3.9
77 1.0 -3.0 2.6
85 -3.4 -1.4 -2.8
94 2.9 0.6 3.3
103 -0.5 -2.2 1.7
111 1.6 3.8 -0.4
120 -2.5 1.1 -3.7
END
}

glass='density = 2500
young_modulus = "70 GPa"
poisson_ratio = 0.22
surface_energy = 0.3'
model() {
    local sphere="sphere = { ${glass//$'\n'/, }, yield_strength = \"3 GPa\" }"
    case $1 in
        localInteraction)
            echo "patchInteractionModel localInteraction;
                localInteractionCoeffs { patches (\".*\" { type rebound; e 0.95; mu 0.05; }); }" ;;
        rebound) echo "patchInteractionModel rebound; reboundCoeffs { UFactor 0.95; }" ;;
        constant) law 'normal = "constant"
            restitution = 0.95
            tangential = "constant"
            tangential_restitution = 0.95' ;;
        ea) law "$sphere
            surface = \"stainless-steel\"
            normal = \"ea\"
            hertz_damping = 0.02
            friction = 0.2" ;;
        eap) law "$sphere
            surface = \"stainless-steel\"
            normal = \"eap\"
            friction = 0.2" ;;
    esac
}
law() { echo "patchInteractionModel carom; caromCoeffs { patches { \".*\" { type law; law #{ $1"$'\n'"#}; } } }"; }

# write_case MODEL
write_case() {
    local case=$work/$1
    cp -r "$here/../tests/box" "$case"
    cd "$case"
    sed -i -e 's/(8 8 8)/(20 20 20)/' -e 's/type patch/type wall/' system/blockMeshDict
    sed -i -e "s/^endTime .*/endTime ${steps}e-3;/" -e 's/^writeInterval .*/writeInterval 1000;/' system/controlDict
    sed -i '/lid\|window/d' 0/U
    positions >constant/positions
    awk '/^subModels/ { exit } { print }' constant/kinematicCloudProperties >head
    { cat head
      echo "subModels { particleForces { sphereDrag; gravity; } injectionModels {"; injectors
      echo "} dispersionModel none;"; model "$1"
      echo "surfaceFilmModel none; stochasticCollisionModel none; collisionModel none; }"
      echo "cloudFunctions {}"; } >constant/kinematicCloudProperties
    sed -i 's/rho0 8930/rho0 2500/' constant/kinematicCloudProperties
    quietly blockMesh
}

models=(localInteraction rebound constant ea eap)
for name in "${models[@]}"; do write_case "$name"; done

# --- instructions ---------------------------------------------------------------------------------------------------

# count MODEL: calls of correct() and instructions in each, with what it calls
count() {
    cd "$work/$1"
    quietly valgrind --tool=callgrind --callgrind-out-file=callgrind.out --compress-strings=no --compress-pos=no "$solver"
    # a call is three lines: cfn=NAME, calls=COUNT POSITION, POSITION INCLUSIVE-COST
    awk '/^cfn=/ { hit = /(LocalInteraction|CaromInteraction|Rebound)<.*::correct\(/ }
         /^calls=/ { split($1, a, "="); n = a[2]; getline; if (hit) { calls += n; cost += $2 } hit = 0 }
         END { printf "%d %.0f\n", calls, cost / calls }' callgrind.out
}

if [[ $mode == instructions ]]; then
    command -v valgrind >/dev/null || { echo "valgrind is missing" >&2; exit 1; }
    printf '%-28s %10s %14s %22s\n' "" calls instructions "over localInteraction"
    for name in "${models[@]}"; do
        read -r calls cost < <(count "$name")
        base=${base:-$cost}
        title=$name
        case $name in constant | ea | eap) title="carom, $name" ;; esac
        printf '%-28s %10d %14d %22s\n' "$title" "$calls" "$cost" "$(awk -v a="$cost" -v b="$base" 'BEGIN { printf "%.2f", a / b }')"
    done
    exit
fi

# --- time -----------------------------------------------------------------------------------------------------------

# Processor time of the steps 2 to the last, ns per parcel and step: reading and injecting are not in it.
run_time() {
    cd "$work/$1"
    quietly taskset -c "$core" "$solver"
    awk -v n="$((8 * per_injector))" '/^ExecutionTime/ { t[++k] = $3 } END { printf "%.1f\n", (t[k] - t[1]) / (k - 1) / n * 1e9 }' \
        "$work/log"
}

load() { cut -d' ' -f1-3 /proc/loadavg; }
declare -A seen
models=(localInteraction constant ea)   # with constant, parcels fly as with localInteraction; ea captures some, and they rest
echo "machine: $(lscpu | sed -n 's/^Model name: *//p'), $(nproc) cores; load before: $(load)"
printf '%-5s %18s %18s %14s   ns per parcel and step\n' run localInteraction "carom, constant" "carom, ea"
for ((run = 1; run <= runs; run++)); do
    row=()
    for name in "${models[@]}"; do
        t=$(run_time "$name")
        seen[$name]+="$t "
        row+=("$t")
    done
    printf '%-5s %18s %18s %14s\n' "$run" "${row[@]}"
done
for name in "${models[@]}"; do
    tr ' ' '\n' <<<"${seen[$name]}" | sed '/^$/d' | sort -n | awk -v name="$name" '{ x[NR] = $1 } END {
        printf "%-18s median %.1f, from %.1f to %.1f\n", name, (x[int((NR + 1) / 2)] + x[int(NR / 2) + 1]) / 2, x[1], x[NR] }'
done
echo "load after: $(load)"
