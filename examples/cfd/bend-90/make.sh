#!/usr/bin/env bash
# The flow in the bend, with a parabolic profile at the inlet (U) and with a flat one (UPlug), 20 s each.
#
#   ./make.sh                        # the stored mesh: 21 600 cells in half the pipe
#   ./make.sh 3 5 7 23 8 20 FOLDER   # another: cells of the core, the ring, before, round and after the bend, mm straight before it
#   ./make.sh 6 16 14 45 16 20 FOLDER 40 # innermost cells of the ring 40 times as wide as those at the wall (4): 11 to 16 um there
. "$(dirname "$0")/../solve.sh"
cells=(${1:-6} ${2:-9} ${3:-14} ${4:-45} ${5:-16} ${6:-20} ${8:-4})
case=${7:-case}
[[ $case = case ]] || { mkdir -p "$case"; cp -r case/{0.orig,constant,system} "$case"; }
mesh() {
    "$here/mesh.py" dictionary "${cells[@]}" >system/blockMeshDict
    run blockMesh
    "$here/mesh.py" bend constant/polyMesh/points
}
here=$PWD
cp "$case/0.orig/inlet.plug" "$case/0.orig/inlet"
solve "$case" U
plug=$(mktemp)
mv "$case"/[1-9]*/U.gz "$plug"
cp "$case/0.orig/inlet.parabola" "$case/0.orig/inlet"
solve "$case" U
gunzip -c "$plug" | sed 's/object      U;/object      UPlug;/' | gzip -9n >"$(echo "$case"/[1-9]*)/UPlug.gz"
rm "$plug" "$case/0.orig/inlet"
