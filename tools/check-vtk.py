"""Reads the VTK files of a run back with the vtk package (pip install vtk) and compares them with its tables.

usage: check-vtk.py OUT
"""

import csv
import pathlib
import sys

from vtkmodules.vtkIOXML import vtkXMLPolyDataReader


def read(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0, f"{path}: VTK error {reader.GetErrorCode()}"
    return reader.GetOutput()


def rows(path):
    with open(path, newline="", encoding="utf-8") as table:
        return list(csv.DictReader(table))


def same_points(data, table):
    assert data.GetNumberOfPoints() == len(table)
    for i, row in enumerate(table):
        assert list(data.GetPoint(i)) == [float(row[c]) for c in "xyz"], (i, data.GetPoint(i), row)


out = pathlib.Path(sys.argv[1])
paths = rows(out / "trajectories.csv")
data = read(out / "trajectories.vtp")
same_points(data, paths)
assert data.GetNumberOfLines() == len({row["particle"] for row in paths})
times = data.GetPointData().GetArray("time")
assert [times.GetValue(i) for i in range(len(paths))] == [float(row["time"]) for row in paths]

kept = [row for row in rows(out / "impacts.csv") if row["fate"] in ("capture", "settle", "trap")]
data = read(out / "deposit.vtp")
same_points(data, kept)
diameters = data.GetPointData().GetArray("diameter")
assert [diameters.GetValue(i) for i in range(len(kept))] == [float(row["diameter"]) for row in kept]
print(f"{len(paths)} points of trajectories and {len(kept)} deposits read back")
