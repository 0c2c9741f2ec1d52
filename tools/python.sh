#!/usr/bin/env bash
# The Python module: its wheel, types and tests, and what examples/notebooks holds. `tools/python.sh full` does what takes longer
# besides: executors on a cluster, other versions of Python, the benchmark.
set -euo pipefail
cd "$(dirname "$0")/.."
root=$PWD
export CARGO_TERM_COLOR=never MPLBACKEND=agg
# the dependencies that the command was built of are the module's too
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$root/target}
crate=$root/crates/carom-py
venv=$CARGO_TARGET_DIR/python
wheels=$CARGO_TARGET_DIR/wheels

say() { printf '\n-- %s\n' "$*"; }

if ! python3 -m venv --help >/dev/null 2>&1 || ! python3 -c 'import ensurepip' 2>/dev/null; then
    apt-get update -qq && apt-get install -y -qq python3-venv python3-pip >/dev/null
fi
[[ -x $venv/bin/python ]] || python3 -m venv "$venv"
py=$venv/bin/python
"$py" -m pip install -q maturin pytest hypothesis mypy typing_extensions numpy pyarrow pandas polars xarray pint matplotlib nbclient \
    ipykernel fluids particula

say "formatting and lints of crates/carom-py"
(cd "$crate" && cargo metadata --format-version 1 --locked >/dev/null 2>&1) ||
    echo "note: crates/carom-py/Cargo.lock lacks what the crates have come to need: commit it as cargo writes it now"
(cd "$crate" && cargo fmt --check && cargo clippy --all-targets -- -D warnings)

say "the wheel"
rm -rf "$wheels"
(cd "$crate" && "$venv/bin/maturin" build --release -i "$py" -o "$wheels")
"$py" -m pip install -q --force-reinstall --no-deps "$wheels"/carom-*.whl
"$venv/bin/carom" --version

say "types"
(cd "$crate" && MYPYPATH=python "$py" -m mypy python/carom tests/typed.py)
(cd "$crate" && "$py" tests/typed.py)

say "tests"
(cd "$crate" && "$py" -m pytest)

if compgen -G "$root/examples/notebooks/*.ipynb" >/dev/null; then
    say "notebooks"
    "$py" tools/notebooks.py
fi

[[ ${1:-} == full ]] || exit 0

say "executors: a Dask cluster of two workers, two ranks of MPI"
"$py" -m pip install -q "dask[distributed]" mpi4py mpich tqdm
(cd "$crate" && "$py" -m pytest -m cluster)

say "other versions of Python"
# on the path, or as pyenv keeps them
of_version() {
    local candidate
    for candidate in "python$1" "${PYENV_ROOT:-$HOME/.pyenv}/versions/$1".*/bin/python3; do
        if "$candidate" -c "import sys; assert '%d.%d' % sys.version_info[:2] == '$1'" 2>/dev/null; then
            echo "$candidate"
            return 0
        fi
    done
    return 1
}
for version in 3.10 3.12 3.13; do
    other=$(of_version $version) || { echo "Python $version: not on this machine, not tried"; continue; }
    "$other" -m venv "$CARGO_TARGET_DIR/python$version"
    "$CARGO_TARGET_DIR/python$version/bin/pip" install -q pytest hypothesis numpy "$wheels"/carom-*.whl
    echo "Python $version"
    (cd "$crate" && "$CARGO_TARGET_DIR/python$version/bin/python" -m pytest)
done

say "benchmark"
"$py" -m pip install -q scipy
"$py" "$crate/benches/bench.py"
