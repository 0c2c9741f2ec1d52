#!/usr/bin/env python3
"""Processor time for a sphere and millisecond of flight, OpenFOAM's tracker and `carom run` in turn on one core.

    CAROM=carom taskset -c 0 ./speed.py FOLDER [TIMES]
"""
import csv
import os
import resource
import shutil
import subprocess
import sys
from pathlib import Path

import reference


def carom(folder, tolerance):
    text = (reference.HERE / "pitz-daily.toml").read_text()
    text = text.replace('case = "case"', f'case = "{reference.HERE / "case"}"').replace('stop = "20 ms"\n', "")
    text = text.replace("trajectories = 60", "trajectories = 0\nimpacts = false")
    text = text.replace('until = "100 ms"', f'until = "100 ms"\ntolerance = {tolerance}')
    (folder / "speed.toml").write_text(text)
    out = folder / "speed"
    shutil.rmtree(out, ignore_errors=True)
    command = os.environ.get("CAROM", "carom").split()
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([*command, "run", folder / "speed.toml", "--out", out, "--threads", "1", "--no-report"], check=True, capture_output=True)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    with open(out / "fates.csv") as file:
        flown = sum(float(r["time"]) for r in csv.DictReader(file)) * 1e3
    return seconds, flown


def main():
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for _ in range(int(sys.argv[2]) if len(sys.argv) > 2 else 3):
        seconds = reference.run(folder, "stick", "0.3", spheres="starts", hits="all")
        case = folder / "stick-0.3"
        end = reference.ends(case)
        flown = 1e3 * (sum(e[1] for e in end.values()) + sum(a[0] for a in reference.airborne(case).values()))
        print(f"OpenFOAM, maxCo 0.3: {seconds:.1f} s, {1e9 * seconds / flown:.0f} ns a sphere and millisecond", flush=True)
        for tolerance in ("1e-5", "1e-3"):
            seconds, flown = carom(folder, tolerance)
            print(f"carom, tolerance {tolerance}: {seconds:.1f} s, {1e9 * seconds / flown:.0f} ns a sphere and millisecond", flush=True)


if __name__ == "__main__":
    main()
