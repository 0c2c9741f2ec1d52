"""Fits and validation, as the command's."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from conftest import ROOT, command

import carom

SPEED = [0.1, 0.3, 1, 3, 10, 20]
RESTITUTION = [0.805, 0.926, 0.970, 0.978, 0.964, 0.934]


def law() -> carom.WallLaw:
    return carom.WallLaw(sphere="stainless-steel", surface="silicon", normal="ea", friction=0)


def test_fit_as_the_command(tmp_path: Path) -> None:
    points = {"speed": np.array(SPEED), "restitution": np.array(RESTITUTION)}
    free = ["roughness_factor", "hertz_damping"]
    found = carom.fit(points, law(), free, diameter="70 um", resamples=50)
    # made with C_R = 0.15 and C_H = 0.007 s/m
    assert abs(found.values["roughness_factor"] - 0.15) < 0.01 and abs(found.values["hertz_damping"] - 0.007) < 3e-4
    file = tmp_path / "points.csv"
    file.write_text("speed,restitution\n" + "".join(f"{v},{e}\n" for v, e in zip(SPEED, RESTITUTION, strict=True)))
    words = ["--sphere", "stainless-steel", "--surface", "silicon", "--friction", "0", "--diameter", "70um"]
    told = command("fit", str(file), *words, "--free", ",".join(free), "--bootstrap", "50", "--json")
    assert told.returncode == 0, told.stderr
    want = json.loads(told.stdout)
    want = want.get("fit", want)
    assert [p["value"] for p in want["parameters"]] == [p["value"] for p in found.parameters]
    assert carom.fit(file, law(), free, diameter=70e-6, resamples=0).values == found.values
    assert found.law.to_dict()["roughness_factor"] == found.values["roughness_factor"]
    assert "roughness_factor = " in repr(found)


def test_fit_refuses() -> None:
    points = {"speed": SPEED, "restitution": RESTITUTION}
    with pytest.raises(ValueError, match="unknown parameter 'roughnes_factor'"):
        carom.fit(points, law(), ["roughnes_factor"], diameter=7e-5)
    with pytest.raises(ValueError, match="it is not free"):
        carom.fit(points, law(), ["roughness_factor"], bounds={"friction": (0.1, 0.2)}, diameter=7e-5)
    with pytest.raises(ValueError, match="no column that is read"):
        carom.fit({"v": SPEED}, law(), ["roughness_factor"], diameter=7e-5)
    with pytest.raises(ValueError, match="columns of one length"):
        carom.fit({"speed": SPEED[:2], "restitution": RESTITUTION}, law(), ["roughness_factor"], diameter=7e-5)


def test_validation(tmp_path: Path) -> None:
    found = carom.validate(out=tmp_path)
    assert len(found.summary) > 20 and (tmp_path / "report.html").exists()
    assert found.found["comparisons"] == json.loads((tmp_path / "report.json").read_text())["comparisons"]


def test_the_wheel_brings_the_command() -> None:
    script = Path(sys.executable).parent / "carom"
    assert script.exists()
    told = subprocess.run([script, "--version"], capture_output=True, text=True, check=True)
    assert told.stdout.strip() == f"carom {carom.__version__}"
    wrong = command("impact", "--sphere", "coper")
    assert wrong.returncode == 2 and wrong.stdout == ""
    assert command("sweep").returncode == 2


def test_settings_are_the_roots() -> None:
    """A workspace of its own cannot share them."""
    tomllib = pytest.importorskip("tomllib")
    root, own = (tomllib.loads((ROOT / p / "Cargo.toml").read_text()) for p in (".", "crates/carom-py"))
    assert own["profile"]["release"] == root["profile"]["release"]
    package = root["workspace"]["package"]
    for key in ("version", "edition", "rust-version", "license", "authors"):
        assert own["package"][key] == package[key], key


def test_figures_are_drawn() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    copper = carom.WallLaw(sphere="copper", surface="glass", normal="ea", friction=0.2)
    ax = carom.plot.sweep(copper, diameter="90 um", speed=np.geomspace(0.1, 10, 9))
    assert ax.get_xlabel() == "speed (m/s)" and ax.get_ylabel() == "restitution $e$" and ax.get_xscale() == "log"
    carom.plot.sweep(copper, diameter=np.geomspace(1e-6, 1e-4, 5), speed=np.geomspace(0.1, 10, 9), of="normal")
    carom.plot.sweep(copper, diameter="90 um", speed=[0.1, 1.0, 2.0], friction=[0.1, 0.2], angle=40, of="tangential")
    with pytest.raises(ValueError, match="one range or two"):
        carom.plot.sweep(copper, diameter="90 um", speed=1.0)
    run = carom.run(ROOT / "examples" / "wind-tunnel.toml")
    carom.plot.trajectories(run)
    carom.plot.deposit(run)
