#!/usr/bin/env python3
"""The same spheres by OpenFOAM's own tracker, icoUncoupledKinematicParcelFoam, on the stored flow.

    ./reference.py FOLDER MAXCO...      # e.g. out 0.3 0.1 0.03 0.01

writes FOLDER/starts.csv (20 000 starts, uniform over the height 0.1 mm behind the inlet) and, for each step MAXCO and wall,
FOLDER/stick-MAXCO.csv and FOLDER/rebound-MAXCO.csv: number of the sphere, where it ended (outlet, inlet, lowerWall, upperWall, or
`airborne` after 100 ms), its age then, x, y, and how often it met a wall. `stick` ends at the first wall; `rebound` is elastic.
"""
import os
import random
import re
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
NUMBER = 20_000
ENVIRONMENT = {"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ}


def starts():
    draw = random.Random(1)
    return [(-20.5e-3, round(draw.uniform(0.05e-3, 25.35e-3), 9), 0.0) for _ in range(NUMBER)]


def run(folder, wall, step, spheres="starts", hits="all"):
    """Copy the case, run it, return the seconds of processor time that OpenFOAM says it took."""
    case = folder / f"{wall}-{step}"
    shutil.rmtree(case, ignore_errors=True)
    shutil.copytree(HERE / "parcels", case)
    shutil.copytree(HERE / "case/constant/polyMesh", case / "constant/polyMesh")
    time = max((p for p in (HERE / "case").iterdir() if p.name.isdigit()), key=lambda p: int(p.name))
    (case / "0").mkdir()
    shutil.copy(time / "U.gz", case / "0")
    constant = case / "constant"
    (constant / "step").write_text(f"maxCo {step};\n")
    shutil.copy(constant / f"spheres.{spheres}", constant / "spheres")
    shutil.copy(constant / f"walls.{wall}", constant / "walls")
    shutil.copy(constant / f"hits.{hits}", constant / "hits")
    points = "\n".join(f"({x!r} {y!r} {z!r})" for x, y, z in starts())
    head = "FoamFile { version 2.0; format ascii; class vectorField; object starts; }\n"
    (constant / "starts").write_text(f"{head}{NUMBER}\n(\n{points}\n)\n")
    log = case / "log"
    with log.open("w") as out:
        subprocess.run(["icoUncoupledKinematicParcelFoam"], cwd=case, env=ENVIRONMENT, stdout=out, stderr=out, check=True)
    return float(re.findall(r"ExecutionTime = ([\d.]+)", log.read_text())[-1])


def values(path):
    """A lagrangian field of numbers."""
    body = path.read_text().split("// * *")[-1]
    uniform = re.search(r"(\d+)\{(.*)\}", body)
    if uniform:
        return [uniform[2]] * int(uniform[1])
    count, numbers = re.search(r"(\d+)\s*\(([^)]*)\)", body).groups()
    assert len(numbers.split()) == int(count), path
    return numbers.split()


def ends(case):
    """{number: [fate, age, x, y, hits]} of a finished case."""
    end = {}
    for file in case.glob("postProcessing/lagrangian/kinematicCloud/hits/*/*.post"):
        lines = file.read_text().splitlines()
        names = re.sub(r"\([^)]*\)", lambda m: m[0].replace(" ", ","), lines[0].lstrip("# ")).split()
        for line in lines[1:]:
            fields = dict(zip(names, re.findall(r"\([^)]*\)|\S+", line)))
            number = int(fields["origId"])
            place = next(v for k, v in fields.items() if "position" in k).strip("()").split()
            age = float(fields["age"])
            before = end.get(number)
            hits = (before[4] if before else 0) + (file.stem.endswith("Wall"))
            if before is None or age >= before[1]:
                end[number] = [file.stem, age, float(place[0]), float(place[1]), hits]
            else:
                before[4] = hits
    return end


def last_time(case):
    return max((p for p in case.iterdir() if re.fullmatch(r"0\.\d+", p.name)), key=lambda p: float(p.name))


def airborne(case):
    """Numbers, ages and places of the parcels that still fly at the end."""
    cloud = last_time(case) / "lagrangian/kinematicCloud"
    text = (cloud / "positions").read_text()
    places = re.findall(r"\(([^()]*)\) \d+", text)
    numbers, active, ages = (values(cloud / n) for n in ("origId", "active", "age"))
    return {int(n): (float(a), *map(float, p.split()[:2])) for n, f, a, p in zip(numbers, active, ages, places) if f == "1"}


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    rows = "".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in starts())
    (folder / "starts.csv").write_text("x,y,z\n" + rows)
    for step in sys.argv[2:]:
        for wall in ("stick", "rebound"):
            seconds = run(folder, wall, step)
            case = folder / f"{wall}-{step}"
            end = ends(case)
            for number, (age, x, y) in airborne(case).items():
                end[number] = ["airborne", age, x, y, end[number][4] if number in end else 0]
            assert len(end) == NUMBER, len(end)
            lines = [f"{n},{f},{age!r},{x!r},{y!r},{h}\n" for n, (f, age, x, y, h) in sorted(end.items())]
            (folder / f"{wall}-{step}.csv").write_text("sphere,fate,age,x,y,hits\n" + "".join(lines))
            flown = sum(e[1] for e in end.values()) * 1e3
            print(f"{wall}, maxCo {step}: {seconds:.1f} s, {flown:.0f} spheres and milliseconds", flush=True)
            shutil.rmtree(case)


if __name__ == "__main__":
    main()
