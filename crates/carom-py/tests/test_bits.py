"""The same bits as the command, as Rust, as a row, on any number of threads."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import LAWS, command, rows, same

import carom

COLUMNS = ["normal", "tangential", "spin", "restitution", "impulse_ratio"]
SHARES = ["adhesion", "adhesion_damping", "hertz_damping", "plastic", "other", "friction", "captured", "kept"]


@pytest.mark.parametrize("keys", LAWS, ids=range(len(LAWS)))
def test_as_rust(keys: dict[str, Any], answers: Path, tmp_path: Path) -> None:
    given = rows(1, 400)
    file = tmp_path / "law.toml"
    law = carom.WallLaw(**keys)
    file.write_text(law.to_toml("x"))
    text = "\n".join(" ".join(map(repr, row)) for row in given.tolist())
    told = subprocess.run([str(answers), str(file)], input=text, capture_output=True, text=True, check=True)
    d, n, t, w = given.T
    out = law.impact(d, normal=n, tangential=t, spin=w)
    got = np.stack([getattr(out, c) for c in COLUMNS] + [out.energy[s] for s in SHARES], axis=1)
    met = 0
    for row, line in zip(got, told.stdout.splitlines(), strict=True):
        if line == "-":
            assert np.isnan(row).all()
            continue
        met += 1
        # a zero has no sign in Python
        want = np.array([int(word, 16) for word in line.split()], dtype=np.uint64).view(float) + 0.0
        assert same(row, want), (row, want)
    assert met > 0


def test_as_a_row(law: carom.WallLaw) -> None:
    given = rows(2, 60)
    d, n, t, w = given.T
    out = law.impact(d, normal=n, tangential=t, spin=w)
    by_angle = law.impact(d, speed=np.hypot(n, t), angle=np.degrees(np.arctan2(n, t)), spin=w)
    for i, row in enumerate(given.tolist()):
        one = law.impact(row[0], normal=row[1], tangential=row[2], spin=row[3], errors="nan")
        for name in [*COLUMNS, "tangential_restitution"]:
            assert same(getattr(out, name)[i], getattr(one, name)), name
        assert out.fate[i] == one.fate and out.contact[i] == one.contact
        assert carom.validity_codes(int(out.validity[i])) == one.validity
        assert out.captured[i] == one.captured
        for share in SHARES:
            assert same(out.energy[share][i], one.energy[share])
        speed, angle = float(np.hypot(row[1], row[2])), float(np.degrees(np.arctan2(row[1], row[2])))
        one = law.impact(row[0], speed, angle, row[3], errors="nan")
        for name in COLUMNS:
            assert same(getattr(by_angle, name)[i], getattr(one, name)), name


def test_energies_sum_to_one(law: carom.WallLaw) -> None:
    d, n, t, w = rows(3, 300).T
    out = law.impact(d, normal=n, tangential=t, spin=w)
    met = ~np.isnan(out.restitution)
    assert np.abs(sum(out.energy.values())[met] - 1).max() < 1e-12


def test_as_the_command(law: carom.WallLaw, tmp_path: Path) -> None:
    file = tmp_path / "laws.toml"
    file.write_text(law.to_toml("x"))
    for row in rows(4, 3).tolist():
        diameter, speed, spin = row[0], row[1], row[3]
        angle = 90.0 if "friction" not in law.to_dict() else 10 + 70 * (speed % 1)
        spin = 0.0 if angle == 90.0 else spin
        words = ["--diameter", repr(diameter), "--speed", repr(speed), "--angle", repr(angle), f"--spin={spin!r}"]
        told = command("impact", "--wall-law", f"{file}:x", *words, "--json")
        if told.returncode:
            assert law.impact(diameter, speed, angle, spin, errors="nan").fate not in ("rebound", "capture"), told.stderr
            continue
        want, out = json.loads(told.stdout), law.impact(diameter, speed, angle, spin)
        assert out.fate == want["fate"] and out.contact == want["contact"]
        assert list(out.validity) == want["validity"]
        assert [out.normal, out.tangential, out.spin] == [want["rebound"][k] for k in ("normal", "tangential", "spin")]
        assert out.restitution == want["restitution"]
        assert out.energy == want["energy"]
        for name in ("impulse_ratio", "tangential_restitution"):
            got = getattr(out, name)
            assert (None if np.isnan(got) else got) == want[name]
        window = law.capture_velocity(diameter)
        assert (window if np.isfinite(window) else None) == want["capture_velocity"]


def test_sweep_as_the_command(copper: carom.WallLaw, tmp_path: Path) -> None:
    words = ["--sphere", "copper", "--surface", "glass", "--friction", "0.2", "--roughness-factor", "0.8", "--angle", "33"]
    file = tmp_path / "sweep.json"
    told = command("sweep", *words, "--diameter", "90um", "--over", "speed=0.05..30", "--points", "50", "--out", str(file))
    assert told.returncode == 0, told.stderr
    table = json.loads(file.read_text())
    rows_ = table["rows"] if isinstance(table, dict) and "rows" in table else table
    columns = {k: [row[k] for row in rows_] for k in rows_[0]} if isinstance(rows_, list) else rows_
    speed = np.array(columns["speed"], dtype=float)
    out = copper.impact("90um", speed, 33.0)
    assert same(out.restitution, np.array(columns["restitution"], dtype=float))
    assert out.fate.tolist() == columns["fate"]


def test_threads_change_nothing(copper: carom.WallLaw) -> None:
    d, n, t, w = rows(5, 30_001).T
    one, four = (copper.impact(d, normal=n, tangential=t, spin=w, threads=k) for k in (1, 4))
    for name in COLUMNS:
        assert same(getattr(one, name), getattr(four, name))


def test_sticking_as_the_command(tmp_path: Path) -> None:
    law = carom.WallLaw(sphere="copper", surface="glass", normal="ea")
    file = tmp_path / "s.json"
    words = ["--sphere", "copper", "--surface", "glass", "--diameter", "lognormal(10um, 1.5)"]
    words += ["--roughness-factor", "normal(0.8, 0.05)", "--over", "speed=0.1..3", "--points", "5", "--samples", "200"]
    told = command("sweep", *words, "--seed", "7", "--out", str(file))
    assert told.returncode == 0, told.stderr
    table = json.loads(file.read_text())
    rows_ = table["rows"] if isinstance(table, dict) and "rows" in table else table
    columns = {k: [row[k] for row in rows_] for k in rows_[0]} if isinstance(rows_, list) else rows_
    found = carom.sticking(
        law,
        "lognormal(10um, 1.5)",
        np.array(columns["speed"], dtype=float),
        samples=200,
        seed=7,
        roughness_factor="normal(0.8, 0.05)",
    )
    for name in ("sticking_probability", "sticking_low", "sticking_high", "restitution_median", "rebound_speed_p95"):
        want = np.array([np.nan if v is None else v for v in columns[name]], dtype=float)
        assert same(found[name], want), name
    assert 0 < found["sticking_probability"].mean() < 1
