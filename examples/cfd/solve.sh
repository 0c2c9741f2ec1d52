# For the make.sh of each example: `. ../solve.sh`. Needs OpenFOAM 1912 (Debian: apt-get install openfoam).
set -euo pipefail
cd "$(dirname "$(realpath "$0")")"
export WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}

# run COMMAND...: its output goes to log.COMMAND, and is shown if it fails
run() { echo "${PWD##*/}: $*"; "$@" >"log.$1" 2>&1 || { tail -30 "log.$1" >&2; exit 1; }; }

# the mesh of the case folder it is called in; an example may have its own
mesh() { run blockMesh; }

# solve CASE FIELD...: mesh and flow of a case folder, of which the mesh and the last time's fields are kept, compressed
solve() (
    cd "$1"; shift
    rm -rf 0 [1-9]* constant/polyMesh log.*
    cp -r 0.orig 0
    mesh
    run checkMesh
    run simpleFoam
    time=$(printf '%s\n' [1-9]* | sort -n | tail -1)
    echo "${PWD##*/}: $time iterations"
    mkdir kept
    for field in "$@"; do mv "$time/$field" kept 2>/dev/null || mv "$time/$field.gz" kept; done
    rm -r 0 "$time"
    mv kept "$time"
    for file in constant/polyMesh/* "$time"/*; do
        case $file in */boundary) continue ;; *.gz) gunzip "$file" ;; esac
        gzip -9nf "${file%.gz}"
    done
    rm -f log.*
)
