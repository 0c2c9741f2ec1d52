"""The Python of the README and of guides: it runs, and each line with a value after it gives that."""

from __future__ import annotations

import ast
import os
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from conftest import ROOT, command
from test_run import files

import carom

PAGES = [("README.md", 10), ("docs/fit.md", 2), ("docs/which-law.md", 3)]
PYTHON = "docs/python.md"
CLUSTER = ("dask", "mpi4py")


def _blocks(page: str) -> list[str]:
    return re.findall(r"^```python\n(.*?)^```", (ROOT / page).read_text(), re.MULTILINE | re.DOTALL)


def _holds(value: Any, told: str) -> None:
    """A number may be cut (``0.92321...``) or rounded to the digits that stand there; ``array(...)`` is any array."""
    if not re.match(r"-?\d", told):
        start, cut, end = told.partition("...")
        assert repr(value).startswith(start) and (repr(value).endswith(end) if cut else repr(value) == told)
        return
    if "..." in told:
        assert repr(float(value)).startswith(told.partition("...")[0]), (value, told)
        return
    digits = len(told.partition(".")[2])
    assert round(float(value), digits) == float(told), (value, told)


def _run(block: str, names: dict[str, Any]) -> int:
    """Runs statement by statement; what stands after an expression on its line is its value. How many were held."""
    lines = block.splitlines()
    held = 0
    for statement in ast.parse(block).body:
        assert statement.end_lineno and statement.end_col_offset is not None
        code = "\n".join(lines[statement.lineno - 1 : statement.end_lineno])
        last = lines[statement.end_lineno - 1].encode()[statement.end_col_offset :].decode()
        if isinstance(statement, ast.Expr) and "#" in last:
            _holds(eval(code[: len(code) - len(last)], names), last.strip().removeprefix("#").strip())  # noqa: S307
            held += 1
        else:
            exec(code, names)  # noqa: S102
    return held


@pytest.mark.parametrize(("page", "values"), PAGES)
def test_its_python_runs(page: str, values: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    names: dict[str, Any] = {}
    assert sum(_run(block, names) for block in _blocks(page)) >= values


@pytest.fixture
def room(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the files that the guide speaks of."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    (tmp_path / "case.toml").write_text((ROOT / "examples/wind-tunnel.toml").read_text())
    points = "".join(f"2,{angle},9e-5,{value}\n" for angle, value in [(10, 0.93), (20, 0.86), (30, 0.78), (40, 0.72)])
    (tmp_path / "points.csv").write_text("speed,angle,diameter,tangential_restitution\n" + points)
    return tmp_path


def test_the_guide(room: Path) -> None:
    for needed in ["pandas", "matplotlib"]:
        pytest.importorskip(needed)
    names: dict[str, Any] = {}
    blocks = [block for block in _blocks(PYTHON) if not any(name in block for name in CLUSTER)]
    assert sum(_run(block, names) for block in blocks) >= 8
    assert files(room / "on-processes") == files(carom.run("case.toml", "whole", threads=1).out)


def test_the_guides_table(room: Path) -> None:
    """Beside each command, the call that does the same."""
    rows = re.findall(r"(?m)^\| `carom .*? \| (.*) \|$", (ROOT / PYTHON).read_text())
    calls = [call for row in rows for call in re.findall(r"`(.*?)`", row)]
    assert len(rows) == 9 and len(calls) == 11
    for folder, shard in [("a", "1/2"), ("b", "2/2")]:
        assert command("run", "case.toml", "--out", folder, "--shard", shard).returncode == 0
    names: dict[str, Any] = {}
    _run(_blocks(PYTHON)[0] + "import numpy as np\nspeed = np.geomspace(0.1, 30, 50)\n", names)
    for call in calls:
        assert eval(call, names) is not None  # noqa: S307


@pytest.mark.cluster
def test_the_guides_clusters(room: Path) -> None:
    for needed in ["distributed", "mpi4py"]:
        pytest.importorskip(needed)
    dask, mpi = (next(block for block in _blocks(PYTHON) if name in block) for name in CLUSTER)
    _run(dask, {"carom": carom})
    Path("script.py").write_text(mpi)
    mpiexec = Path(sys.executable).parent / "mpiexec"
    words = [str(mpiexec) if mpiexec.exists() else "mpiexec", "-n", "3", sys.executable, "-m", "mpi4py.futures", "script.py"]
    told = subprocess.run(words, capture_output=True, text=True, env=dict(os.environ))
    assert told.returncode == 0, told.stderr
    whole = files(carom.run("case.toml", "whole", threads=1).out)
    assert files(room / "on-dask") == files(room / "on-ranks") == whole


def test_the_case_files_of_the_examples_are_there() -> None:
    """Their runs take from seconds to many minutes: only the paths are looked at."""
    pages = sorted((ROOT / "docs/examples").glob("*.md"))
    named = [name for page in pages for name in re.findall(r'carom\.run\("(.*?)"', page.read_text())]
    assert len(named) >= 12
    assert all((ROOT / name).is_file() for name in named), named
