"""Laws of every kind, the command, and the Rust library's own answers."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import settings

import carom

ROOT = Path(__file__).resolve().parents[3]

# the same examples every time, and no deadline on a busy machine
settings.register_profile("carom", derandomize=True, deadline=None, max_examples=60)
settings.load_profile("carom")

STEEL = {"sphere": "stainless-steel", "surface": "silicon", "roughness_factor": 0.15}
ALUMINA = {"sphere": "aluminium-oxide", "surface": "aluminium-gorham-kharaz"}
STICKY = {**ALUMINA, "work_of_adhesion": 0.5}
BARE = {"sphere": "rho=1100,E=5MPa,nu=0.48", "surface": "E=3MPa,nu=0.49"}

NORMAL = [
    {**STEEL, "normal": "ea"},
    {**STEEL, "normal": "ea", "adhesion_damping": 1.3, "hertz_damping": 0.007},
    {**STEEL, "normal": "ea", "surface_curvature": "1 mm"},
    {**STEEL, "normal": ["adhesion-damping", "hertz-damping"], "adhesion_damping": 1.3, "hertz_damping": 0.01},
    {**STICKY, "normal": "eap"},
    {**STICKY, "normal": "eap", "hertz_damping": 0.001, "surface_curvature": "-20 mm"},
    {**ALUMINA, "normal": ["plastic-kadomtsev"]},
    {**STICKY, "normal": "thornton-ning"},
    {**ALUMINA, "normal": "tabor", "yield_velocity": 0.09, "meyer_index": 2.29},
    {**STICKY, "normal": ["plastic-tabor", "adhesion-jkr"], "yield_velocity": 0.09, "meyer_index": 2.29},
    {**STICKY, "normal": ["plastic-bons", "adhesion-work"]},
    {**BARE, "normal": "constant", "restitution": 0.7},
    {**BARE, "normal": "by-angle", "restitution": "grant-tabakoff"},
    {**BARE, "normal": "by-angle", "restitution": {"angle_deg": [10, 45, 90], "value": [0.9, 0.7, 0.6]}},
    {**STEEL, "normal": "resolved"},
    {**STEEL, "normal": "resolved", "adhesion": "reversible", "adhesion_damping": 1.3, "hertz_damping": 0.007},
    {**BARE, "normal": "dahneke", "restitution": 0.95, "well_depth": "1e-16 J", "well_depth_out": "3e-16 J"},
]
TANGENTIAL = [
    {"friction": 0.2},
    {"tangential": "walton", "friction": 0.2, "walton_beta": 0.4},
    {"tangential": "micro-slip", "friction": 0.3},
    {"tangential": "constant", "tangential_restitution": 0.8},
    {},
]


def _laws() -> list[dict[str, object]]:
    return [{**normal, **TANGENTIAL[i % 5]} for i, normal in enumerate(NORMAL)] + [
        {**normal, **TANGENTIAL[(i + 2) % 5]} for i, normal in enumerate(NORMAL)
    ]


LAWS = _laws()


@pytest.fixture(params=range(len(LAWS)), ids=lambda i: f"law{i}")
def law(request: pytest.FixtureRequest) -> carom.WallLaw:
    """A law of each kind."""
    return carom.WallLaw(**LAWS[request.param])  # type: ignore[arg-type]


@pytest.fixture
def copper() -> carom.WallLaw:
    return carom.WallLaw(sphere="copper", surface="glass", normal="ea", friction=0.2, roughness_factor=0.8)


def command(*words: str, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    """The command that the wheel brings."""
    return subprocess.run([sys.executable, "-m", "carom", *words], capture_output=True, text=True, cwd=cwd, check=False)


@pytest.fixture(scope="session")
def answers() -> Path:
    """The Rust library's answers as a program."""
    words = ["cargo", "build", "-q", "--locked", "-p", "carom", "--example", "answers"]
    subprocess.run(words, cwd=ROOT, check=True)
    import json

    told = subprocess.run(["cargo", "metadata", "--format-version=1", "--no-deps"], cwd=ROOT, capture_output=True, check=True)
    return Path(json.loads(told.stdout)["target_directory"]) / "debug" / "examples" / "answers"


def rows(seed: int, count: int) -> np.ndarray:
    """Random impacts: diameter, normal and tangential speed, spin. Some are captures, some grazing, some spin hard."""
    rng = np.random.default_rng(seed)
    diameter = 10 ** rng.uniform(-6, -3, count)
    normal = 10 ** rng.uniform(-3, 1.5, count)
    tangential = rng.uniform(-30, 30, count) * rng.integers(0, 2, count)
    spin = rng.normal(0, 1, count) * normal / diameter * rng.integers(0, 2, count)
    return np.stack([diameter, normal, tangential, spin], axis=1)


def same(a: np.ndarray, b: np.ndarray) -> bool:
    """The same bits; NaN is NaN."""
    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    bits = a.view(np.uint64) == b.view(np.uint64)
    return bool(np.all(bits | (np.isnan(a) & np.isnan(b))))
