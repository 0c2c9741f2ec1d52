"""Writes stand-ins for results of Fluent, with h5py (3.16 was used): the lists, their types, chunks and compression are those of files of Fluent 22.2 that Ansys
publishes (github.com/ansys/example-data, pyfluent/mixing_elbow), no file is copied. usage: make.py, in this folder; `make.py --full FILE` writes the
case with the lists that are not read here but by VTK's vtkFLUENTCFFReader, which finds hexahedra of 6 m³ in it; `make.py --full-flat FOLDER/` the one of two dimensions.

Three bricks of sides 1, 2, 3 in a row along x: two of the fluid, with an interior face between them, and a solid one behind a wall and its shadow.
U = (cell number, 0, 0), on the boundary (10 + number of the face, 0, 0) but for the zone `top`, which has no values.
"""

import sys

import h5py
import numpy as np

points = [(x, y, z) for z in (0, 3) for y in (0, 2) for x in (0, 1, 2, 3)]


def p(i, j, k):
    return i + 4 * (j + 2 * k) + 1


def across(i):
    """The face at x = i, seen from larger x."""
    return [p(i, 0, 0), p(i, 1, 0), p(i, 1, 1), p(i, 0, 1)]


def sides(i):
    """The faces of brick i at y = 0, y = 2, z = 0, z = 3, seen from outside."""
    return [[p(i, 0, 0), p(i + 1, 0, 0), p(i + 1, 0, 1), p(i, 0, 1)], [p(i, 1, 0), p(i, 1, 1), p(i + 1, 1, 1), p(i + 1, 1, 0)],
            [p(i, 0, 0), p(i, 1, 0), p(i + 1, 1, 0), p(i + 1, 0, 0)], [p(i, 0, 1), p(i + 1, 0, 1), p(i + 1, 1, 1), p(i, 1, 1)]]


# name, type, faces with the cells on both sides; area vectors point out of c0 here, and into it in Fluent's files
zones = [
    ("interior--air", 2, [(across(1), 1, 2)]),
    ("inlet", 10, [(across(0)[::-1], 1, 0)]),
    ("heated", 3, [(across(2), 2, 0)]),
    ("heated-shadow", 3, [(across(2)[::-1], 3, 0)]),
    ("mirror", 7, [(sides(i)[0], i + 1, 0) for i in (0, 1)]),
    ("top", 3, [(sides(i)[1], i + 1, 0) for i in (0, 1)]),
    ("ends", 5, [(sides(i)[s], i + 1, 0) for i in (0, 1) for s in (2, 3)]),
    ("outside", 3, [(across(3), 3, 0)] + [(s, 3, 0) for s in sides(2)]),
]


def put(group, name, values, kind, **attributes):
    values = np.asarray(values, kind)
    data = group.create_dataset(name, data=values, chunks=values.shape, compression="gzip", compression_opts=1)
    for key, value in attributes.items():
        data.attrs[key] = np.array([value], "u8")


def text(group, name, value):
    put(group, name, [value.encode()], f"S{len(value) + 1}")


def numbers(group, **attributes):
    for key, value in attributes.items():
        group.attrs[key] = np.array([value], "u8")


def topology(group, rows, **more):
    zone = group.create_group("zoneTopology")
    numbers(zone, nZones=len(rows))
    for key, kind, column in (("id", "i4", 0), ("minId", "u8", 1), ("maxId", "u8", 2)):
        put(zone, key, [row[column] for row in rows], kind)
    for key, values in more.items():
        put(zone, key, values, "i4")
    return zone


def put_zones(group, zones):
    rows, first = [], 1
    for i, (_, _, all) in enumerate(zones):
        rows.append((20 + i, first, first + len(all) - 1))
        first += len(all)
    zone = topology(group, rows, zoneType=[k for _, k, _ in zones], childZoneId=[0] * len(zones))
    text(zone, "name", ";".join(n for n, _, _ in zones))


def put_unread(nodes, cells, faces, dimension):
    """Lists that VTK's reader asks for."""
    for group, names in ((nodes, ["dimension"]), (cells, ["dimension"]), (faces, ["dimension", "faceType", "shadowZoneId", "flags"])):
        zone = group["zoneTopology"]
        for key in names:
            put(zone, key, [dimension if key == "dimension" else 0] * len(zone["id"]), "i4")


def case(name, turned, libver, one_more=0, full=False):
    with h5py.File(name, "w", libver=libver) as f:
        mesh = f.create_group("meshes/1")
        faces = [face for _, _, all in zones for face in all]
        numbers(mesh, nodeCount=len(points), cellCount=3 + one_more, faceCount=len(faces), nodeOffset=0, cellOffset=0, faceOffset=0)
        mesh.attrs["dimension"] = np.array([3], "i4")
        nodes = mesh.create_group("nodes")
        topology(nodes, [(9, 1, len(points))])
        put(nodes.create_group("coords"), "9", points, "f8", minId=1, maxId=len(points))
        cells = mesh.create_group("cells")
        zone = topology(cells, [(5, 1, 2), (6, 3, 3)], zoneType=[1, 17], cellType=[4, 4], childZoneId=[0, 0])
        text(zone, "name", "air;steel")
        group = mesh.create_group("faces")
        put_zones(group, zones)
        # in two sections
        section = group.create_group("nodes")
        numbers(section, nSections=2)
        for n, (a, b) in enumerate(((1, 5), (6, len(faces)))):
            s = section.create_group(str(n + 1))
            numbers(s, minId=a, maxId=b)
            some = [f[0] if turned else f[0][::-1] for f in faces[a - 1:b]]
            put(s, "nnodes", [len(f) for f in some], "i2")
            put(s, "nodes", [q for f in some for q in f], "u4")
        c0, c1 = group.create_group("c0"), group.create_group("c1")
        numbers(c0, nSections=1)
        numbers(c1, nSections=1)
        put(c0, "1", [f[1] for f in faces], "u4", minId=1, maxId=len(faces))
        put(c1, "1", [1 + 1], "u4", minId=1, maxId=1)
        f.create_group("settings")
        if full:
            put_unread(nodes, cells, group, 3)


def data(name, kind, libver, broken=False):
    with h5py.File(name, "w", libver=libver) as f:
        phase = f.create_group("results/1/phase-1")
        faces = [n for n, _, all in zones for _ in all]
        for field, cells, at in (("SV_U", [1, 2], lambda i: 10.0 + i), ("SV_V", [0, 0], lambda i: 0.0), ("SV_W", [0, 0], lambda i: 0.0),
                                 ("SV_T", [300, 310, 400], None), ("SV_P", [1, np.nan if broken else 2], None), ("SV_MU_T", [0, 0], None)):
            group = phase.create_group(f"cells/{field}")
            numbers(group, nSections=1)
            put(group, "1", cells, kind, minId=1, maxId=len(cells))
            if at is None:
                continue
            # all but `top`
            runs = [(2, faces.index("top")), (faces.index("ends") + 1, faces.index("outside"))]
            group = phase.create_group(f"faces/{field}")
            numbers(group, nSections=len(runs))
            for n, (a, b) in enumerate(runs):
                put(group, str(n + 1), [at(i) for i in range(a, b + 1)], kind, minId=a, maxId=b)


def flat(folder, full=False):
    """Two squares and a triangle in a row along the axis of a case of two dimensions, a hole in none of them; U = cell number, V = −U/10, swirl = 100 + cell number."""
    places = [(0, 0), (1, 0), (2, 0), (3, 0), (0, 1), (1, 1), (2, 1)]
    # name, type, lines with the cells on both sides; c0 lies on their right, as in Fluent's files
    lines = [
        ("interior--air", 2, [((6, 2), 1, 2), ((3, 7), 3, 2)]),
        ("inlet", 10, [((1, 5), 1, 0)]),
        ("axis", 37, [((2, 1), 1, 0), ((3, 2), 2, 0), ((4, 3), 3, 0)]),
        ("pipe", 3, [((5, 6), 1, 0), ((6, 7), 2, 0), ((7, 4), 3, 0)]),
    ]
    with h5py.File(f"{folder}flat.cas.h5", "w", libver="earliest") as f:
        mesh = f.create_group("meshes/1")
        faces = [face for _, _, all in lines for face in all]
        numbers(mesh, nodeCount=len(places), cellCount=3, faceCount=len(faces), nodeOffset=0, cellOffset=0, faceOffset=0)
        mesh.attrs["dimension"] = np.array([2], "i4")
        nodes = mesh.create_group("nodes")
        topology(nodes, [(9, 1, len(places))])
        put(nodes.create_group("coords"), "9", places, "f8", minId=1, maxId=len(places))
        cells = mesh.create_group("cells")
        zone = topology(cells, [(5, 1, 3)], zoneType=[1], cellType=[0], childZoneId=[0])
        text(zone, "name", "air")
        group = mesh.create_group("faces")
        put_zones(group, lines)
        section = group.create_group("nodes")
        numbers(section, nSections=1)
        s = section.create_group("1")
        numbers(s, minId=1, maxId=len(faces))
        put(s, "nnodes", [2] * len(faces), "i2")
        put(s, "nodes", [q for f in faces for q in f[0]], "u4")
        for name, which in (("c0", 1), ("c1", 2)):
            side = group.create_group(name)
            numbers(side, nSections=1)
            # of c1 what lies between cells alone
            some = [f[which] for f in faces][: len(faces) if name == "c0" else 2]
            put(side, "1", some, "u4", minId=1, maxId=len(some))
        f.create_group("settings")
        if full:
            put_unread(nodes, cells, group, 2)
            kinds = cells.create_group("ctype")
            numbers(kinds, nSections=1)
            put(kinds.create_group("1"), "cell-types", [3, 3, 1], "i2")
            kinds["1"].attrs["minId"], kinds["1"].attrs["maxId"], kinds["1"].attrs["elementType"] = 1, 3, 0
            return
    with h5py.File(f"{folder}flat.dat.h5", "w", libver="earliest") as f:
        phase = f.create_group("results/1/phase-1")
        for field, cells, at in (("SV_U", [1, 2, 3], 10), ("SV_V", [-0.1, -0.2, -0.3], 0), ("SV_W", [101, 102, 103], 0), ("SV_P", [1, 2, 3], 5)):
            group = phase.create_group(f"cells/{field}")
            numbers(group, nSections=1)
            put(group, "1", cells, "f8", minId=1, maxId=3)
            group = phase.create_group(f"faces/{field}")
            numbers(group, nSections=1)
            put(group, "1", [at + i for i in range(3, 10)], "f8", minId=3, maxId=9)


if sys.argv[1:2] == ["--full"]:
    case(sys.argv[2], False, "earliest", full=True)
    sys.exit()
if sys.argv[1:2] == ["--full-flat"]:
    flat(sys.argv[2], full=True)
    sys.exit()
flat("")
case("row.cas.h5", False, "earliest")
data("row.dat.h5", "f8", "earliest")
case("turned.cas.h5", True, "latest")
data("turned.dat.h5", "f4", "latest")
data("broken.dat.h5", "f4", "latest", broken=True)
case("many.cas.h5", False, "latest", one_more=4_000_000_000)
