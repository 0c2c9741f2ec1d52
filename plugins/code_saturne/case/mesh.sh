#!/usr/bin/env bash
# A channel 0.4 m long, 20 mm high and 20 mm wide, of NX x NY x NZ hexahedra, as a Gmsh file (format 2.2). Faces: 1 inlet (x = 0), 2 outlet, 3
# floor (y = 0), 4 ceiling, 5 sides.
# Usage: mesh.sh [NX NY NZ] > channel.msh
exec awk -v nx="${1:-40}" -v ny="${2:-10}" -v nz="${3:-6}" '
function node(i, j, k) { return 1 + i + (nx + 1) * (j + (ny + 1) * k) }
function face(group, a, b, c, d) { lines[++n] = sprintf("3 2 %d %d %d %d %d %d", group, group, a, b, c, d) }
BEGIN {
    print "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes"
    print (nx + 1) * (ny + 1) * (nz + 1)
    for (k = 0; k <= nz; k++) for (j = 0; j <= ny; j++) for (i = 0; i <= nx; i++)
        printf "%d %.12g %.12g %.12g\n", node(i, j, k), 0.4 * i / nx, 0.02 * j / ny, 0.02 * k / nz
    print "$EndNodes\n$Elements"
    for (k = 0; k < nz; k++) for (j = 0; j < ny; j++) {
        face(1, node(0, j, k), node(0, j + 1, k), node(0, j + 1, k + 1), node(0, j, k + 1))
        face(2, node(nx, j, k), node(nx, j + 1, k), node(nx, j + 1, k + 1), node(nx, j, k + 1))
    }
    for (k = 0; k < nz; k++) for (i = 0; i < nx; i++) {
        face(3, node(i, 0, k), node(i + 1, 0, k), node(i + 1, 0, k + 1), node(i, 0, k + 1))
        face(4, node(i, ny, k), node(i + 1, ny, k), node(i + 1, ny, k + 1), node(i, ny, k + 1))
    }
    for (j = 0; j < ny; j++) for (i = 0; i < nx; i++) {
        face(5, node(i, j, 0), node(i + 1, j, 0), node(i + 1, j + 1, 0), node(i, j + 1, 0))
        face(5, node(i, j, nz), node(i + 1, j, nz), node(i + 1, j + 1, nz), node(i, j + 1, nz))
    }
    for (k = 0; k < nz; k++) for (j = 0; j < ny; j++) for (i = 0; i < nx; i++)
        lines[++n] = sprintf("5 2 6 6 %d %d %d %d %d %d %d %d", node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k),
            node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1))
    print n
    for (i = 1; i <= n; i++) print i, lines[i]
    print "$EndElements"
}'
