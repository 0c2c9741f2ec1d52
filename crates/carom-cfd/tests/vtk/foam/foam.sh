#!/bin/sh
# Writes the results that foamToVTK of OpenFOAM (v1912 was used) makes of two small meshes: usage: foam.sh, in this folder, with OpenFOAM's
# programs in PATH and WM_PROJECT_DIR set. `plane` has four cells and two empty sides; `poly` is the dual mesh of eight.
set -eu
here=$PWD
there=$(mktemp -d)
header() { printf 'FoamFile { version 2.0; format ascii; class %s; object %s; }\n' "$1" "$2"; }
make() { # NAME CELLS KIND-OF-SIDES
    mkdir -p "$there/$1/system" "$there/$1/0" "$there/$1/constant"
    cd "$there/$1"
    { header dictionary controlDict
        echo 'application none; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1; writeControl timeStep; writeInterval 1; writePrecision 12;'
    } > system/controlDict
    { header dictionary fvSchemes
        echo 'ddtSchemes { default Euler; } gradSchemes { default Gauss linear; } divSchemes { default none; }'
        echo 'laplacianSchemes { default Gauss linear corrected; } interpolationSchemes { default linear; } snGradSchemes { default corrected; }'
    } > system/fvSchemes
    header dictionary fvSolution > system/fvSolution
    { header dictionary blockMeshDict
        echo 'scale 1;'
        echo 'vertices ( (0 0 0) (2 0 0) (2 1 0) (0 1 0) (0 0 1) (2 0 1) (2 1 1) (0 1 1) );'
        echo "blocks ( hex (0 1 2 3 4 5 6 7) ($2) simpleGrading (1 1 1) );"
        echo 'boundary ( inlet { type patch; faces ( (0 4 7 3) ); } outlet { type patch; faces ( (1 2 6 5) ); }'
        echo "lower { type wall; faces ( (0 1 5 4) ); } upper { type wall; faces ( (3 7 6 2) ); } sides { type $3; faces ( (0 3 2 1) (4 5 6 7) ); } );"
    } > system/blockMeshDict
    blockMesh > blockMesh.log
    sides=$3
    [ "$sides" = empty ] || sides=zeroGradient
    { header volVectorField U
        echo 'dimensions [0 1 -1 0 0 0 0];'
        [ "$1" = plane ] && echo 'internalField nonuniform List<vector> 4((1 0 0) (2 0 0) (3 0 0) (4 0 0));' || echo 'internalField uniform (1 0 0);'
        echo "boundaryField { inlet { type fixedValue; value uniform (1.5 0 0); } outlet { type zeroGradient; } \"lower|upper\" { type noSlip; } sides { type $sides; } }"
    } > 0/U
    [ "$1" = plane ] || polyDualMesh -overwrite 30 > polyDualMesh.log
    for form in ascii binary; do
        [ $form = ascii ] && foamToVTK -ascii -name $form > $form.log || foamToVTK -name $form > $form.log
        rm -rf "$here/$1-$form"
        mkdir "$here/$1-$form"
        cp -r $form/"$1"_0* "$here/$1-$form"
        rm "$here/$1-$form/$1_0/boundary.vtm"
    done
    if [ "$1" = plane ]; then
        foamToVTK -no-point-data -name cells > cells.log
        rm -rf "$here/plane-cells"
        mkdir "$here/plane-cells"
        cp -r cells/plane_0* "$here/plane-cells"
        rm "$here/plane-cells/plane_0/boundary.vtm"
    fi
    foamToVTK -legacy -no-boundary -name legacy > legacy.log
    cp legacy/"$1"_0.vtk "$here/$1.vtk"
    checkMesh -allGeometry -allTopology > checkMesh.log || true
    grep -E '^ *(points|faces|internal faces|cells|Min volume)|Total volume' checkMesh.log
}
make plane '2 2 1' empty
make poly '2 2 2' wall
# a case that the tests read as OpenFOAM's too
cp -r "$there/poly/system" "$there/system"
cp -r "$here/../../cases/block" "$there/block"
cp -r "$there/system" "$there/block"
cd "$there/block"
foamToVTK -no-point-data -time 2 -name cells > cells.log
rm -rf "$here/block"
mkdir "$here/block"
cp -r cells/block_0* "$here/block"
rm "$here/block/block_0/boundary.vtm"
rm -rf "$there"
