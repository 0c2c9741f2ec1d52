#!/usr/bin/env bash
# Builds lib/libcaromOpenFOAM.so on Debian 12: OpenFOAM 1912 and a compiler from Debian's archive, its headers from Debian's
# source package, carom's C library with cargo, the plug-in with wmake. What is there already is left alone.
#
#   plugins/openfoam/build.sh
#   CAROM_OPENFOAM=FOLDER plugins/openfoam/build.sh      where the source package goes (260 MB; ~/.cache/carom-openfoam)
#
# Where an OpenFOAM with wmake is set up in the shell (its etc/bashrc was sourced), that one is used instead of Debian's.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
export CAROM_LIBBIN=${CAROM_LIBBIN:-$here/lib}

fail() { echo "$*" >&2; exit 1; }

as_root() {
    if [[ $(id -u) -eq 0 ]]; then "$@"; elif command -v sudo >/dev/null; then sudo "$@"; else fail "as root, please: $*"; fi
}

# What is missing on this machine, from Debian's archive.
install_packages() {
    local wanted=()
    command -v icoUncoupledKinematicParcelFoam >/dev/null || wanted+=(openfoam)
    command -v g++ >/dev/null || wanted+=(g++)
    command -v make >/dev/null || wanted+=(make)
    command -v bzip2 >/dev/null || wanted+=(bzip2)
    if (( ${#wanted[@]} )); then
        as_root apt-get update -qq
        as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${wanted[@]}" >/dev/null
    fi
}

# The machine's own Debian entries, read as source entries: apt checks signatures as ever, nothing of the system changes.
source_entries() {
    local files=(/etc/apt/sources.list /etc/apt/sources.list.d/*.list) file
    for file in "${files[@]}"; do
        if [[ -f $file ]]; then sed -n -E '\|/debian/? |s/^deb /deb-src /p' "$file"; fi
    done >"$1.list"
    for file in /etc/apt/sources.list.d/*.sources; do
        if [[ -f $file ]]; then
            awk 'BEGIN { RS = ""; ORS = "\n\n" } /(^|\n)URIs:[^\n]*\/debian\/?[ \n]/ && /(^|\n)Types:[^\n]*deb/ {
                sub(/Types:[^\n]*/, "Types: deb-src"); print }' "$file"
        fi
    done >"$1.sources"
}

# fetch_source FOLDER VERSION
fetch_source() {
    local apt=$1/apt
    mkdir -p "$apt/sources.list.d" "$apt/state/lists/partial" "$apt/cache/archives/partial"
    source_entries "$apt/sources.list.d/debian"
    (
        cd "$1"
        local options=(-qq -o "Dir::Etc::sourcelist=/dev/null" -o "Dir::Etc::sourceparts=$apt/sources.list.d"
            -o "Dir::State=$apt/state" -o "Dir::State::status=/var/lib/dpkg/status" -o "Dir::Cache=$apt/cache"
            -o "APT::Sandbox::User=$(id -un)")
        apt-get "${options[@]}" update
        apt-get "${options[@]}" source --download-only "openfoam=$2"
        tar xf openfoam_*.orig.tar.*
    )
    rm -r "$apt"
}

# Header folders that the clouds need, below src/
headers=(OpenFOAM OSspecific/POSIX finiteVolume fileFormats surfMesh meshTools lagrangian/basic lagrangian/intermediate
    lagrangian/distributionModels transportModels/compressible thermophysicalModels/specie thermophysicalModels/basic
    thermophysicalModels/thermophysicalProperties thermophysicalModels/reactionThermo thermophysicalModels/SLGThermo
    thermophysicalModels/radiation regionModels/regionModel regionModels/surfaceFilmModels dynamicMesh dynamicFvMesh)

# Sets the shell up for wmake with the headers of Debian's source package.
debian_openfoam() {
    local cache=${CAROM_OPENFOAM:-${XDG_CACHE_HOME:-$HOME/.cache}/carom-openfoam} version source folder
    install_packages
    version=$(dpkg-query -W -f '${source:Version}' openfoam 2>/dev/null) || fail "OpenFOAM is here, but not as Debian's package"
    cache=$cache/$version
    if [[ ! -e $cache/ready ]]; then
        mkdir -p "$cache"
        echo "fetching the source package of openfoam $version into $cache"
        fetch_source "$cache" "$version"
    fi
    source=$(echo "$cache"/*/wmake)
    export WM_DIR=$source WM_PROJECT_DIR=${source%/wmake} WM_PROJECT=OpenFOAM WM_OPTIONS=linux64GccDPInt32Opt WM_ARCH=linux64 \
        WM_OSTYPE=POSIX WM_COMPILER=Gcc WM_COMPILER_TYPE=system WM_PRECISION_OPTION=DP WM_LABEL_SIZE=32 WM_COMPILE_OPTION=Opt \
        FOAM_SRC=${source%/wmake}/src FOAM_LIBBIN=/usr/lib FOAM_EXT_LIBBIN=/usr/lib PATH=$source:$PATH
    if [[ ! -e $cache/ready ]]; then
        for folder in "${headers[@]}"; do
            wmakeLnInclude -s "$FOAM_SRC/$folder" >/dev/null 2>&1
        done
        make -s -C "$WM_DIR/src" >/dev/null
        touch "$cache/ready"
    fi
}

if [[ -z ${WM_DIR:-} ]]; then
    debian_openfoam
fi
command -v cargo >/dev/null || fail "cargo is missing: install Rust (rustup)"

cargo build --release --locked --manifest-path "$root/Cargo.toml" -p carom-c
export CAROM_DIR=$root CAROM_LIB=${CARGO_TARGET_DIR:-$root/target}/release/libcarom_c.a WM_QUIET=true
library=$CAROM_LIBBIN/libcaromOpenFOAM.so
mkdir -p "$CAROM_LIBBIN"
if [[ $CAROM_LIB -nt $library ]]; then
    rm -f "$library"   # wmake does not know that it is linked into it
fi
wmake -j "$(nproc)" libso "$here/src"
echo "built $library"
