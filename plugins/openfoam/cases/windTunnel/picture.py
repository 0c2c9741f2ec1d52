#!/usr/bin/env python3
"""Where the shower's spheres lie: reads OpenFOAM's last time and the log of impacts, writes deposit.png.

    apt-get install -y python3-matplotlib
    python3 plugins/openfoam/cases/windTunnel/picture.py
"""

import csv
import re
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

CASE = Path(__file__).resolve().parent / "shower"
CLOUD = "kinematicCloud"


def floor_field(name):
    """The values of a field on the floor's faces at the last time."""
    times = [d for d in CASE.iterdir() if re.fullmatch(r"[0-9.]+", d.name) and (d / f"{CLOUD}:{name}").exists()]
    text = (max(times, key=lambda d: float(d.name)) / f"{CLOUD}:{name}").read_text()
    values = re.search(r"floor\s*\{[^}]*?List<scalar>\s*\d+\s*\(([^)]*)\)", text)
    return [float(v) for v in values.group(1).split()]


def captured():
    """Place, diameter and number of earlier bounces of every captured sphere. A rebound leaves with the velocity the log
    gives; what belongs to one sphere is told by its diameter, which is drawn from a continuous range."""
    bounces = {}
    with open(CASE / f"postProcessing/lagrangian/{CLOUD}/impacts/0/impacts.csv", newline="") as file:
        for row in csv.DictReader(file):
            if row["fate"] == "capture":
                yield float(row["x"]), float(row["diameter"]), bounces.get(row["diameter"], 0)
            else:
                bounces[row["diameter"]] = bounces.get(row["diameter"], 0) + 1


def main():
    x, d, n = zip(*captured())
    mass = floor_field("massCaptured")
    figure, (dots, bars) = plt.subplots(2, 1, sharex=True, figsize=(8, 6), constrained_layout=True)

    points = dots.scatter([1e3 * v for v in x], [1e6 * v for v in d], c=n, s=8, cmap="viridis")
    figure.colorbar(points, ax=dots, label="bounces before")
    dots.set_ylabel("diameter (µm)")
    dots.set_title(f"{len(x)} copper spheres captured by the glass floor of the wind tunnel")

    width = 1300 / len(mass)
    bars.bar([-100 + width * (i + 0.5) for i in range(len(mass))], [1e9 * m for m in mass], width=width, color="tab:brown")
    bars.set_ylabel("mass captured per face (µg)")
    bars.set_xlabel("distance from the dispenser (mm)")
    bars.set_xlim(0, 1100 if max(x) > 0.8 else 800)

    target = CASE.parent / "deposit.png"
    figure.savefig(target, dpi=120)
    print(f"wrote {target}")


if __name__ == "__main__":
    main()
