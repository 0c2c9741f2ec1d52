#!/usr/bin/env python3
"""Half a pipe with a 90 degree bend, as blockMesh's dictionary, and the bending itself.

    ./mesh.py dictionary CORE RING BEFORE ROUND AFTER [MM [GRADE]] > system/blockMeshDict # numbers of cells, straight length before the bend
    ./mesh.py bend constant/polyMesh/points                                               # of the mesh that blockMesh made of it

GRADE is how many times wider the ring's innermost cells are than those at the wall.

blockMesh makes the straight pipe along z, x >= 0, a core and a ring round it; then the points are carried round the bend, so that
every section is a true circle. The bend turns from +z towards +y; its symmetry plane is x = 0.
"""
import math
import sys
from pathlib import Path

RADIUS = 5e-3
BEND = 5.7 * RADIUS
LENGTH = math.pi / 2 * BEND
STRAIGHT = 20                   # before and after, mm


def dictionary(core, ring, before, round, after, straight=STRAIGHT, grade=4):
    along = (before, round, after)
    stations = [-1e-3 * straight, 0.0, LENGTH, LENGTH + 1e-3 * STRAIGHT]
    c, h = RADIUS / math.sqrt(2), 0.44 * RADIUS
    section = [(0, -RADIUS), (c, -c), (c, c), (0, RADIUS), (0, -h), (h, -h), (h, h), (0, h)]
    vertices = "\n".join(f"    ({x:.12g} {y:.12g} {z:.12g})" for z in stations for x, y in section)
    # each face of the section: its corners in turn, cells along the first and the second side, grading towards the wall
    faces = [((4, 5, 6, 7), core, 2 * core, 1), ((0, 1, 5, 4), core, ring, grade),
             ((5, 1, 2, 6), ring, 2 * core, 1 / grade), ((7, 6, 2, 3), core, ring, 1 / grade)]
    blocks, arcs, walls, mirror = [], [], [], []
    for part, cells in enumerate(along):
        near, far = 8 * part, 8 * part + 8
        for number, (corners, first, second, grading) in enumerate(faces):
            hex = " ".join([*(str(near + v) for v in corners), *(str(far + v) for v in corners)])
            grades = f"{grading} 1 1" if number == 2 else f"1 {grading} 1"
            blocks.append(f"    hex ({hex}) ({first} {second} {cells}) simpleGrading ({grades})")
        walls.append(" ".join(f"({near + a} {near + b} {far + b} {far + a})" for a, b in ((0, 1), (1, 2), (2, 3))))
        mirror += [f"({near + a} {near + b} {far + b} {far + a})" for a, b in ((0, 4), (4, 7), (7, 3))]
    for station, z in enumerate(stations):
        for a, b, degrees in ((0, 1, -67.5), (1, 2, 0), (2, 3, 67.5)):
            x, y = RADIUS * math.cos(math.radians(degrees)), RADIUS * math.sin(math.radians(degrees))
            arcs.append(f"    arc {8 * station + a} {8 * station + b} ({x:.12g} {y:.12g} {z:.12g})")
    ends = [" ".join("(" + " ".join(str(8 * s + v) for v in f[0]) + ")" for f in faces) for s in (0, 3)]
    line = "\n"
    print(f"""FoamFile {{ version 2.0; format ascii; class dictionary; object blockMeshDict; }}

// made by mesh.py
vertices
(
{vertices}
);

blocks
(
{line.join(blocks)}
);

edges
(
{line.join(arcs)}
);

boundary
(
    inlet   {{ type patch; faces ({ends[0]}); }}
    outlet  {{ type patch; faces ({ends[1]}); }}
    before  {{ type wall; faces ({walls[0]}); }}
    bend    {{ type wall; faces ({walls[1]}); }}
    after   {{ type wall; faces ({walls[2]}); }}
    middle  {{ type symmetryPlane; faces ({" ".join(mirror)}); }}
);""")


def bend(path):
    """Points of the straight pipe carried round the bend."""
    def carried(line):
        x, y, z = map(float, line.strip("()").split())
        turn = min(max(z, 0.0), LENGTH) / BEND
        along = z - turn * BEND
        # the centre of the bend's axis is (y, z) = (BEND, 0)
        r = BEND - y
        return f"({x:.9g} {BEND - r * math.cos(turn) + along * math.sin(turn):.9g} {r * math.sin(turn) + along * math.cos(turn):.9g})"

    lines = path.read_text().splitlines()
    begin = lines.index("(")
    end = lines.index(")")
    lines[begin + 1:end] = map(carried, lines[begin + 1:end])
    path.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    if sys.argv[1] == "dictionary":
        dictionary(*map(int, sys.argv[2:]))
    else:
        bend(Path(sys.argv[2]))
