#!/usr/bin/env python3
"""`carom run` held against OpenFOAM's own tracker, sphere by sphere; ./reference.py FOLDER MAXCO... comes first.

    CAROM=carom ./compare.py FOLDER [TOLERANCE]

For each wall (stick, rebound) and each of OpenFOAM's steps: how many spheres end elsewhere, and of those that leave through the same
patch after as many hits, by how much age and place there differ.
"""
import csv
import os
import shutil
import statistics
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
LAWS = {"stick": 'law = "trap"', "rebound": 'law = "reflect"\nrestitution = 1\ntangential_restitution = 1'}


def carom(folder, wall, tolerance):
    """{number: (fate, age, x, y, hits)} by `carom run`."""
    head = f"""[fluid]
density = 1.2
viscosity = 1.2e-5
[flow]
kind = "openfoam"
case = "{HERE / 'case'}"
[forces]
gravity = [0, 0, 0]
drag = "putnam"                # OpenFOAM's sphereDrag
slip = "none"
[[wall]]
patch = "(upper|lower)Wall"
contact_at = "center"          # OpenFOAM's parcels are points
{LAWS[wall]}
[[wall]]
patch = "inlet|outlet"
contact_at = "center"
law = "escape"
[run]
until = "100 ms"
tolerance = {tolerance}
[output]
trajectories = 0
impacts = false
"""
    with open(folder / "starts.csv") as file:
        starts = [
            f'[[injection]]\ndensity = 2000\ndiameter = 20e-6\nposition = [{s["x"]}, {s["y"]}, {s["z"]}]\nvelocity = [10, 0, 0]\n'
            for s in csv.DictReader(file)
        ]
    case = folder / f"carom-{wall}.toml"
    case.write_text(head + "".join(starts))
    out = folder / f"carom-{wall}"
    shutil.rmtree(out, ignore_errors=True)
    command = os.environ.get("CAROM", "carom").split()
    subprocess.run([*command, "run", case, "--out", out, "--no-report"], check=True, stdout=subprocess.DEVNULL)
    with open(out / "fates.csv") as file:
        return {
            int(r["particle"]): (
                r["wall"] if r["fate"] in ("escaped", "trapped") else r["fate"],
                float(r["time"]), float(r["x"]), float(r["y"]),
                int(r["impacts"]) - (r["fate"] == "escaped"),
            )
            for r in csv.DictReader(file)
        }


def main():
    folder = Path(sys.argv[1])
    tolerance = sys.argv[2] if len(sys.argv) > 2 else "1e-5"
    for wall in LAWS:
        ours = carom(folder, wall, tolerance)
        files = sorted(folder.glob(f"{wall}-*.csv"), key=lambda p: -float(p.stem.split("-")[1]))
        for file in files:
            with open(file) as rows:
                theirs = {
                    int(r["sphere"]): (r["fate"], float(r["age"]), float(r["x"]), float(r["y"]), int(r["hits"]))
                    for r in csv.DictReader(rows)
                }
            assert theirs.keys() == ours.keys()
            elsewhere = [n for n in ours if ours[n][0] != theirs[n][0]]
            alike = [n for n in ours if ours[n][0] == theirs[n][0] == "outlet" and ours[n][4] == theirs[n][4]]
            ages = sorted(abs(ours[n][1] - theirs[n][1]) * 1e6 for n in alike)
            places = sorted(abs(ours[n][3] - theirs[n][3]) * 1e6 for n in alike)
            quantiles = [f"{v[len(v) // 2]:.3g}, {v[int(0.9 * len(v))]:.3g}, {v[-1]:.3g}" for v in (places, ages)]
            stuck = [abs(ours[n][2] - theirs[n][2]) * 1e6 for n in ours if ours[n][0] == theirs[n][0] in ("upperWall", "lowerWall")]
            more = f"; stuck {len(stuck)}, median |dx| {statistics.median(stuck):.3g} um" if stuck else ""
            print(
                f"{wall}, maxCo {file.stem.split('-')[1]}: {len(elsewhere)} of {len(ours)} end elsewhere; {len(alike)} leave alike: "
                f"median, 90 %, most of |dy|: {quantiles[0]} um, of |dt|: {quantiles[1]} us{more}",
                flush=True,
            )


if __name__ == "__main__":
    main()
