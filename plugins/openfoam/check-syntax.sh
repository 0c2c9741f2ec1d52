#!/usr/bin/env bash
# Compiles the plug-in's sources, syntax only, against the headers of an unpacked OpenFOAM, which need not be built or installed:
# ESI releases (with META-INFO/api-info) and those of the Foundation. Nothing is written but a temporary folder of links.
#
#   plugins/openfoam/check-syntax.sh FOLDER            the folder that holds src
#   CXX=clang++ ...                                    another compiler
#   CXXFLAGS='-DX -IFOLDER' ...                        what a fork needs besides
#   ONLY='FILES' ...                                   these sources only
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
tree=${1:?the folder of OpenFOAM sources}
[[ -d $tree/src/OpenFOAM ]] || { echo "$tree holds no src/OpenFOAM" >&2; exit 2; }
tree=$(cd "$tree" && pwd)

links=$(mktemp -d)
trap 'rm -rf "$links"' EXIT

# Folders of src/ whose headers Make/options asks for, and the two that wmake adds
mapfile -t folders < <(
    echo OpenFOAM
    echo OSspecific/POSIX
    grep -oE 'LIB_SRC\)/[A-Za-z/]+' "$here/src/Make/options" | sed -e 's|LIB_SRC)/||' -e 's|/lnInclude$||' | sort -u
)

includes=()
for folder in "${folders[@]}"; do
    [[ -d $tree/src/$folder ]] || continue
    to=$links/$folder/lnInclude
    mkdir -p "$to"
    find "$tree/src/$folder" \( -name lnInclude -o -name Make -o -name noLink \) -prune -o \
        \( -name '*.H' -o -name '*.C' -o -name '*.h' -o -name '*.hpp' -o -name '*.hxx' -o -name '*.txx' \) -print | sort >"$links/files"
    # of two files of the same name the first counts, as in wmakeLnInclude
    awk -F/ '!seen[$NF]++' "$links/files" | xargs -r -d '\n' ln -s -t "$to"
    includes+=(-I"$to" -I"$tree/src/$folder")
done

release=()
api=$(sed -n 's/^api=//p' "$tree/META-INFO/api-info" 2>/dev/null || true)
name=Foundation
if [[ -n $api ]]; then
    release=(-DOPENFOAM="$api")
    name="ESI v$api"
fi

failed=0
mapfile -t sources < <(sed -n "s|.*\.C$|$here/src/&|p" "$here/src/Make/files")
[[ -z ${ONLY:-} ]] || read -ra sources <<<"$ONLY"
for source in "${sources[@]}"; do
    nice "${CXX:-g++}" -fsyntax-only -std=c++17 -m64 -fPIC "${release[@]}" -DWM_DP -DWM_LABEL_SIZE=32 -DWM_ARCH_OPTION=64 -Dlinux64 \
        -DNoRepository -ftemplate-depth-200 -Wall -Wextra -Wno-unused-parameter -Wno-deprecated-copy -Wno-deprecated-declarations \
        -Wno-attributes -Wno-cast-function-type -I"$here/src/law" -I"$here/src/record" -I"$here/src/release" -I"$here/src/interaction" ${CXXFLAGS:-} \
        -I"$root/crates/carom-c/include" "${includes[@]/#-I/-isystem}" "$source" || { echo "failed: $source" >&2; failed=1; }
done
(( failed == 0 )) || exit 1
echo "$name: ${#sources[@]} sources compile against $tree"
