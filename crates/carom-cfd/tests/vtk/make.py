"""Writes the meshes that the tests of VTK read, with the vtk package (pip install vtk; 9.7.2 was used).

usage: make.py, in this folder. U = (1 + 2x + 3y - z, x/4, -z) and p = x - y in the middles of cells and at points, k of points alone, T of cells
alone; `foam` is made by foam.sh.
"""

import os
import re

from vtkmodules.vtkCommonCore import (vtkDoubleArray, vtkFloatArray, vtkIdList, vtkIntArray, vtkPoints, vtkStringArray,
                                      vtkUnsignedCharArray)
from vtkmodules.vtkCommonDataModel import *
from vtkmodules.vtkIOLegacy import vtkUnstructuredGridWriter
from vtkmodules.vtkIOParallelXML import vtkXMLPartitionedDataSetCollectionWriter
from vtkmodules.vtkIOXML import vtkXMLMultiBlockDataWriter, vtkXMLUnstructuredGridWriter


class Mesh:
    """Points by their coordinates, cells by their points."""

    def __init__(self):
        self.ids, self.points, self.cells = {}, [], []

    def point(self, p):
        p = tuple(map(float, p))
        if p not in self.ids:
            self.ids[p] = len(self.points)
            self.points.append(p)
        return self.ids[p]

    def cell(self, kind, corners):
        self.cells.append((kind, [self.point(p) for p in corners]))

    def polyhedron(self, faces):
        self.cells.append((VTK_POLYHEDRON, [[self.point(p) for p in f] for f in faces]))

    def grid(self, which=None):
        grid, points = vtkUnstructuredGrid(), vtkPoints()
        points.SetDataTypeToDouble()
        cells = self.cells if which is None else [self.cells[i] for i in which]
        used = sorted({p for _, c in cells for f in c for p in (f if isinstance(f, list) else [f])})
        new = {p: i for i, p in enumerate(used)}
        for p in used:
            points.InsertNextPoint(self.points[p])
        grid.SetPoints(points)
        middles = []
        for kind, corners in cells:
            if kind == VTK_POLYHEDRON:
                ids = vtkIdList()
                ids.InsertNextId(len(corners))
                for f in corners:
                    ids.InsertNextId(len(f))
                    for p in f:
                        ids.InsertNextId(new[p])
                grid.InsertNextCell(kind, ids)
                flat = sorted({p for f in corners for p in f})
            else:
                grid.InsertNextCell(kind, len(corners), [new[p] for p in corners])
                flat = corners
            middles.append([sum(self.points[p][c] for p in flat) / len(flat) for c in range(3)])
        places = [self.points[p] for p in used]
        for data, at in ((grid.GetPointData(), places), (grid.GetCellData(), middles)):
            data.AddArray(array(vtkDoubleArray, "U", [(1 + 2 * x + 3 * y - z, x / 4, -z) for x, y, z in at]))
            data.AddArray(array(vtkFloatArray, "p", [(x - y,) for x, y, z in at]))
        grid.GetPointData().AddArray(array(vtkFloatArray, "k", [(8 + x,) for x, y, z in places]))
        grid.GetCellData().AddArray(array(vtkDoubleArray, "T", [(300 + y,) for x, y, z in middles]))
        return grid


def array(kind, name, rows):
    a = kind()
    a.SetName(name)
    a.SetNumberOfComponents(len(rows[0]))
    for row in rows:
        a.InsertNextTuple(row)
    return a


def box(x0, x1, y0, y1, z0, z1):
    return [(x0, y0, z0), (x1, y0, z0), (x1, y1, z0), (x0, y1, z0), (x0, y0, z1), (x1, y0, z1), (x1, y1, z1), (x0, y1, z1)]


def write(grid, name, mode="ascii", comp=None, encode=True, header=32, big=False, block=None):
    w = vtkXMLUnstructuredGridWriter()
    w.SetInputData(grid)
    w.SetFileName(name)
    {"ascii": w.SetDataModeToAscii, "binary": w.SetDataModeToBinary, "appended": w.SetDataModeToAppended}[mode]()
    {None: w.SetCompressorTypeToNone, "zlib": w.SetCompressorTypeToZLib, "lz4": w.SetCompressorTypeToLZ4}[comp]()
    w.SetEncodeAppendedData(encode)
    (w.SetHeaderTypeToUInt64 if header == 64 else w.SetHeaderTypeToUInt32)()
    if big:
        w.SetByteOrderToBigEndian()
    if block:
        w.SetBlockSize(block)
    assert w.Write() == 1


def legacy(grid, name, binary, version):
    w = vtkUnstructuredGridWriter()
    w.SetInputData(grid)
    w.SetFileName(name)
    w.SetFileVersion(version)
    if binary:
        w.SetFileTypeToBinary()
    assert w.Write() == 1


# every linear solid, six of them face to face; volumes 1, 1, 1, 1/4, 1/3, 1/6 + 1/12, then 5/2 and 3
mixed = Mesh()
mixed.cell(VTK_HEXAHEDRON, box(0, 1, 0, 1, 0, 1))
b = box(1, 2, 0, 1, 0, 1)
mixed.cell(VTK_VOXEL, [b[0], b[1], b[3], b[2], b[4], b[5], b[7], b[6]])
a = box(-1, 0, 0, 1, 0, 1)
# one side in two triangles, and faces turned as they come
mixed.polyhedron([[a[0], a[3], a[7]], [a[0], a[4], a[7]], [a[1], a[2], a[6], a[5]], [a[0], a[1], a[5], a[4]], [a[3], a[2], a[6], a[7]],
                  [a[0], a[1], a[2], a[3]], [a[4], a[5], a[6], a[7]]])
mixed.cell(VTK_WEDGE, [(0, 1, 0), (0.5, 1.5, 0), (1, 1, 0), (0, 1, 1), (0.5, 1.5, 1), (1, 1, 1)])
tip = (0.5, 0.5, 2)
mixed.cell(VTK_PYRAMID, [(0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1), tip])
mixed.cell(VTK_TETRA, [(1, 0, 1), (1, 1, 1), tip, (2, 0.5, 2)])
five = [(0, 0), (2, 0), (2, 1), (1, 1.5), (0, 1)]
six = [(0, 0), (1, -0.5), (2, 0), (2, 1), (1, 1.5), (0, 1)]
for kind, base, z in ((VTK_PENTAGONAL_PRISM, five, -3), (VTK_HEXAGONAL_PRISM, six, -5)):
    mixed.cell(kind, [(x, y, z) for x, y in base] + [(x, y, z + 1) for x, y in base])
grid = mixed.grid()
write(grid, "ascii.vtu")
write(grid, "inline.vtu", "binary")
write(grid, "inline-zlib.vtu", "binary", "zlib", header=64)
write(grid, "raw.vtu", "appended", encode=False, header=64)
write(grid, "raw-zlib-blocks.vtu", "appended", "zlib", encode=False, block=64)
write(grid, "base64.vtu", "appended")
write(grid, "base64-zlib-big.vtu", "appended", "zlib", big=True, block=64)
write(grid, "lz4.vtu", "appended", "lz4", header=64)
for version in (42, 51):
    legacy(grid, f"ascii-{version}.vtk", False, version)
    legacy(grid, f"binary-{version}.vtk", True, version)

# the same with the faces of polyhedra in a stream, as VTK before 9.4 has them
text = open("ascii.vtu").read()
faces = next(c for k, c in mixed.cells if k == VTK_POLYHEDRON)
stream = " ".join(map(str, [len(faces)] + [n for f in faces for n in [len(f)] + f]))
ends = " ".join(str(len(stream.split())) if k == VTK_POLYHEDRON else "-1" for k, _ in mixed.cells)
start = text.index('<DataArray type="Int64" Name="face_connectivity"')
end = text.index("</Cells>")
old = f'<DataArray type="Int64" Name="faces" format="ascii">{stream}</DataArray>\n' \
      f'<DataArray type="Int64" Name="faceoffsets" format="ascii">{ends}</DataArray>\n'
open("old-polyhedra.vtu", "w").write(text[:start] + old + text[end:])

# solids of higher order, apart from each other, as VTK's own cells in parametric coordinates: volumes 1, 1/6, 1/2 or 1/3
curved = Mesh()
kinds = [vtkQuadraticTetra, vtkQuadraticHexahedron, vtkQuadraticWedge, vtkQuadraticPyramid, vtkTriQuadraticHexahedron,
         vtkBiQuadraticQuadraticHexahedron, vtkQuadraticLinearWedge, vtkBiQuadraticQuadraticWedge, vtkTriQuadraticPyramid]
for n, kind in enumerate(kinds):
    c = kind()
    at = c.GetParametricCoords()
    curved.cell(c.GetCellType(), [(at[3 * i] + 2 * n, at[3 * i + 1], at[3 * i + 2]) for i in range(c.GetNumberOfPoints())])
# Lagrange's and Bezier's list corners first, then points on edges, sides and inside
second = {VTK_LAGRANGE_TETRAHEDRON: vtkQuadraticTetra, VTK_LAGRANGE_HEXAHEDRON: vtkTriQuadraticHexahedron,
          VTK_LAGRANGE_WEDGE: vtkBiQuadraticQuadraticWedge, VTK_BEZIER_TETRAHEDRON: vtkQuadraticTetra,
          VTK_BEZIER_HEXAHEDRON: vtkTriQuadraticHexahedron}
for n, (kind, like) in enumerate(second.items()):
    at = like().GetParametricCoords()
    points = [(at[3 * i] + 2 * n, at[3 * i + 1] + 2, at[3 * i + 2]) for i in range(like().GetNumberOfPoints())]
    curved.cell(kind, points)
write(curved.grid(), "curved.vtu", "appended", "zlib")

# four hexahedra in a row in three pieces with ghosts; the first cell of the second is the last of the first
row = Mesh()
for i in range(4):
    row.cell(VTK_HEXAHEDRON, box(i, i + 1, 0, 1, 0, 1))
write(row.grid(), "row.vtu")
pieces = [([0, 1, 2], [0, 0, 1]), ([1, 2], [1, 0]), ([3], [0])]
for i, (which, ghosts) in enumerate(pieces):
    grid = row.grid(which)
    grid.GetCellData().AddArray(array(vtkUnsignedCharArray, "vtkGhostType", [(g,) for g in ghosts]))
    write(grid, f"pieces_{i}.vtu", "appended", "zlib")
open("pieces.pvtu", "w").write(
    '<?xml version="1.0"?>\n<VTKFile type="PUnstructuredGrid" version="0.1" byte_order="LittleEndian" header_type="UInt32">\n'
    '  <PUnstructuredGrid GhostLevel="1">\n' + "".join(f'    <Piece Source="pieces_{i}.vtu"/>\n' for i in range(3)) +
    "  </PUnstructuredGrid>\n</VTKFile>\n")

# polygons beside solids, and a line
sides = Mesh()
sides.cell(VTK_HEXAHEDRON, box(0, 1, 0, 1, 0, 1))
c = box(0, 1, 0, 1, 0, 1)
sides.cell(VTK_QUAD, [c[0], c[3], c[7], c[4]])
sides.cell(VTK_PIXEL, [c[1], c[2], c[5], c[6]])
sides.cell(VTK_LINE, [c[0], c[1]])
sides.cell(VTK_POLYGON, [c[0], c[1], c[5], c[4]])
sides.cell(VTK_HEXAHEDRON, box(1, 2, 0, 1, 0, 1))
sides.cell(VTK_QUADRATIC_QUAD, [(2, 0, 0), (2, 1, 0), (2, 1, 1), (2, 0, 1), (2, .5, 0), (2, 1, .5), (2, .5, 1), (2, 0, .5)])
grid = sides.grid()
grid.GetCellData().AddArray(array(vtkIntArray, "zone", [(n,) for n in (0, 3, 7, 0, 4, 0, 7)]))
names = vtkStringArray()
names.SetName("names")
for name in ("gas", "inlet", "inside", "edge", "lower wall", "gas", "outlet"):
    names.InsertNextValue(name)
grid.GetCellData().AddArray(names)
write(grid, "sides.vtu")
write(grid, "sides-zlib.vtu", "appended", "zlib")

# blocks, as ParaView saves them
volume = row.grid()
inlet, lower = vtkPolyData(), vtkPolyData()
for data, quads in ((inlet, [box(0, 0, 0, 1, 0, 1)]), (lower, [box(i, i + 1, 0, 0, 0, 1) for i in range(4)])):
    points, cells = vtkPoints(), vtkCellArray()
    points.SetDataTypeToDouble()
    for q in quads:
        corners = sorted(set(q))
        corners = [corners[0], corners[1], corners[3], corners[2]]
        cells.InsertNextCell(4)
        for p in corners:
            cells.InsertCellPoint(points.InsertNextPoint(p))
    data.SetPoints(points)
    data.SetPolys(cells)
    data.GetCellData().AddArray(array(vtkDoubleArray, "U", [(5.0 + i, 0.0, 0.0) for i in range(len(quads))]))
volume.GetPointData().RemoveArray("U")
blocks = vtkMultiBlockDataSet()
blocks.SetBlock(0, volume)
blocks.GetMetaData(0).Set(vtkCompositeDataSet.NAME(), "internal")
patches = vtkMultiBlockDataSet()
for i, (name, data) in enumerate((("inlet", inlet), ("lower", lower), ("nothing", None))):
    patches.SetBlock(i, data)
    patches.GetMetaData(i).Set(vtkCompositeDataSet.NAME(), name)
blocks.SetBlock(1, patches)
blocks.GetMetaData(1).Set(vtkCompositeDataSet.NAME(), "Patches")
w = vtkXMLMultiBlockDataWriter()
w.SetInputData(blocks)
w.SetFileName("blocks.vtm")
w.SetDataModeToAscii()
assert w.Write() == 1
parts = vtkPartitionedDataSetCollection()
for i, (name, data) in enumerate((("internal", volume), ("inlet", inlet), ("lower", lower))):
    parts.SetPartition(i, 0, data)
    parts.GetMetaData(i).Set(vtkCompositeDataSet.NAME(), name)
w = vtkXMLPartitionedDataSetCollectionWriter()
w.SetInputData(parts)
w.SetFileName("parts.vtpc")
assert w.Write() == 1
