"""Runs: as the command's, of dicts and arrays, stopped, spread over executors."""

from __future__ import annotations

import concurrent.futures
import json
import os
import pickle
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import ROOT, command, same

import carom

CASE: dict[str, Any] = {
    "seed": 3,
    "flow": {"kind": "uniform", "velocity": ["1 m/s", "0 m/s", "0 m/s"]},
    "forces": {"gravity": ["0 m/s2", "-9.81 m/s2", "0 m/s2"]},
    "wall": [
        {"name": "floor", "plane": {"point": [0, 0, 0], "normal": [0, 1, 0]}, "law": "plate"},
        {"name": "ceiling", "plane": {"point": [0, 0.02, 0], "normal": [0, -1, 0]}, "law": "trap"},
        {"name": "outlet", "plane": {"point": [0.2, 0, 0], "normal": [-1, 0, 0]}, "law": "escape"},
    ],
    "law": {"plate": {"surface": "silicon", "normal": "ea", "friction": 0.2}},
    "injection": [
        {
            "name": "fine",
            "material": "copper",
            "diameter": {"lognormal": {"median": "40 um", "gsd": 1.5}},
            "count": 3000,
            "position": {"box": [["0 m", "5 mm", "0 m"], ["0 m", "15 mm", "10 mm"]]},
            "velocity": ["1 m/s", "-1 m/s", "0 m/s"],
        }
    ],
    "run": {"until": "0.1 s"},
}

TEXT = ["impacts.csv", "fates.csv", "trajectories.csv", "deposition.csv", "summary.json"]


def files(folder: Path) -> dict[str, bytes]:
    return {name: (folder / name).read_bytes() for name in TEXT}


def test_as_the_command(tmp_path: Path) -> None:
    case = ROOT / "examples" / "wind-tunnel.toml"
    told = command("run", str(case), "--out", str(tmp_path / "command"), "--json")
    assert told.returncode == 0, told.stderr
    run = carom.run(case, tmp_path / "python", threads=1)
    assert files(tmp_path / "command") == files(tmp_path / "python")
    assert run.summary == json.loads(told.stdout)
    assert (tmp_path / "python" / "report.html").exists() and (tmp_path / "python" / "trajectories.svg").exists()
    assert carom.load(tmp_path / "python").summary == run.summary
    with pytest.raises(ValueError, match=r"force=True") as error:
        carom.run(case, tmp_path / "python")
    assert "--" not in str(error.value)
    carom.run(case, tmp_path / "python", force=True)
    with pytest.raises(ValueError, match="dispenser|law|wall|unknown"):
        carom.run({**CASE, "law": {}})


def test_tables() -> None:
    run = carom.run(CASE)
    assert sum(run.summary["fates"].values()) == run.summary["injected"] == 3000
    impacts, fates = run.impacts, run.fates
    assert len(fates) == 3000 and fates["particle"].tolist() == list(range(3000))
    assert impacts.units["normal_speed_in"] == "m/s" and impacts["restitution"].dtype == float
    assert (fates["fate"] == "captured").sum() == run.summary["fates"]["captured"]
    assert set(run.deposition["wall"]) <= {"floor", "ceiling", "outlet"}
    assert "floor" in run._repr_html_() and "3000 particles" in repr(run)
    assert "<table>" in impacts._repr_html_()
    folder = run.out
    assert folder.exists()
    del run
    import gc

    gc.collect()
    assert not folder.exists()
    with pytest.raises(KeyError, match="no column 'speed'"):
        impacts["speed"]
    pyarrow = pytest.importorskip("pyarrow")
    table = pyarrow.table(impacts)
    assert table.num_rows == len(impacts) and same(table["x"].to_numpy(), impacts["x"])
    polars = pytest.importorskip("polars")
    assert polars.DataFrame(fates).height == 3000
    pandas = pytest.importorskip("pandas")
    assert isinstance(fates.to_pandas(), pandas.DataFrame)


def test_every_law_answers_in_runs_as_it_does_alone() -> None:
    law = carom.WallLaw(sphere="copper", surface="silicon", normal="ea", friction=0.2)
    run = carom.run({**CASE, "law": {"plate": law}})
    t = run.impacts
    hit = np.isin(t["fate"], ["rebound", "capture"]) & (t["wall"] == "floor")
    out = law.impact(t["diameter"][hit], normal=t["normal_speed_in"][hit], tangential=t["tangential_speed_in"][hit])
    first = np.flatnonzero(t["spin_in"][hit] == 0)
    assert len(first) > 1000
    assert np.allclose(out.restitution[first], t["restitution"][hit][first], rtol=1e-12, atol=0)


def test_arrays_in_a_case() -> None:
    n = 200
    rng = np.random.default_rng(1)
    particles = {
        "x": rng.uniform(0.002, 0.008, n),
        "y": np.full(n, 0.009),
        "z": rng.uniform(0.002, 0.008, n),
        "u": np.zeros(n),
        "v": np.full(n, -0.5),
        "w": np.zeros(n),
        "diameter": rng.uniform(2e-5, 5e-5, n),
        "weight": np.full(n, 2.0),
    }
    corners = np.array([[x, 0.0, z] for x in (0.0, 0.01) for z in (0.0, 0.01)])
    faces = np.array([[0, 1, 3], [0, 3, 2]])
    g = np.meshgrid(np.linspace(0, 0.01, 3), np.linspace(0, 0.01, 4), np.linspace(0, 0.01, 3), indexing="ij")
    columns = {"x": g[0], "y": g[1], "z": g[2], "u": 0 * g[0], "v": -0.5, "w": 0.0}
    case = {
        "flow": {"kind": "table", "columns": columns},
        "wall": [{"name": "plate", "triangles": (corners, faces), "law": "trap"}],
        "injection": [{"density": 2000, "particles": particles}],
        "run": {"until": "0.1 s"},
    }
    run = carom.run(case)
    assert run.summary["fates"]["trapped"] == n, run.summary
    fates = run.fates
    assert same(fates["diameter"], particles["diameter"]) and (fates["weight"] == 2).all()
    assert np.abs(fates["x"] - particles["x"]).max() < 1e-12
    for change, part in [
        ({"injection": [{"density": 2000, "particles": {**particles, "size": 1.0}}]}, "no column 'size'"),
        ({"wall": [{"name": "p", "triangles": (corners, faces + 9), "law": "trap"}]}, "a vertex that is not there"),
        ({"wall": [{"name": "p", "triangles": (corners[:, :2], faces), "law": "trap"}]}, r"shape \(n, 3\)"),
        ({"injection": [{"density": 2000, "particles": {**particles, "x": np.zeros(3)}}]}, "one length"),
        ({"injection": [{"density": 2000, "particles": {**particles, "diameter": -particles["diameter"]}}]}, "diameter"),
    ]:
        with pytest.raises(ValueError, match=part):
            carom.run({**case, **change})
    with pytest.raises(TypeError, match="holds complex128"):
        carom.run({**case, "injection": [{"density": 1, "particles": {**particles, "x": particles["x"] * 1j}}]})


def test_progress_and_a_callback_that_stops(tmp_path: Path) -> None:
    heard: list[tuple[int, int]] = []
    carom.run(CASE, progress=lambda done, all_: heard.append((done, all_)))
    assert heard[-1] == (3000, 3000)

    def stop(done: int, _: int) -> None:
        if done > 0:
            raise KeyboardInterrupt

    out = tmp_path / "out"
    with pytest.raises(KeyboardInterrupt):
        carom.run(CASE, out, progress=stop, threads=1)
    run = carom.run(CASE, out, resume=True)
    assert files(out) == files(carom.run(CASE, tmp_path / "whole").out)
    assert run.summary["injected"] == 3000


def test_ctrl_c_stops(tmp_path: Path) -> None:
    script = tmp_path / "long.py"
    script.write_text(
        # whoever runs the tests in the background has the signal ignored, and children inherit that
        "import carom, signal, sys\nsignal.signal(signal.SIGINT, signal.default_int_handler)\nsys.path.insert(0, sys.argv[1])\nfrom test_run import CASE\n"
        "case = {**CASE, 'injection': [{**CASE['injection'][0], 'count': 50_000_000}]}\n"
        "def told(done, _):\n    print(done, flush=True)\n"
        "carom.run(case, sys.argv[2], progress=told, threads=2)\n"
    )
    words = [sys.executable, str(script), str(Path(__file__).parent), str(tmp_path / "out")]
    child = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    assert child.stdout is not None
    while child.stdout.readline().strip() in ("", "0"):
        assert child.poll() is None, child.communicate()
    child.send_signal(signal.SIGINT)
    _, told = child.communicate(timeout=60)
    assert "KeyboardInterrupt" in told and child.returncode != 0


def _die(marker: str) -> None:
    """Ends its worker, once."""
    try:
        os.close(os.open(marker, os.O_CREAT | os.O_EXCL))
    except FileExistsError:
        return
    os.kill(os.getpid(), signal.SIGKILL)


class Mortal(concurrent.futures.ProcessPoolExecutor):
    """A pool of which a worker dies at its first work."""

    marker = ""

    def submit(self, fn: Any, /, *args: Any, **kwargs: Any) -> concurrent.futures.Future[Any]:
        return super().submit(_then, self.marker, fn)


def _then(marker: str, part: Any) -> Any:
    _die(marker)
    return part()


def test_a_pool_gives_the_same_bits(tmp_path: Path) -> None:
    whole = carom.run(CASE, tmp_path / "whole", threads=1)
    with concurrent.futures.ProcessPoolExecutor(2) as pool:
        parts = carom.run(CASE, tmp_path / "parts", executor=pool, shards=3)
        assert parts.summary == whole.summary and files(whole.out) == files(parts.out)
        with pytest.raises(ValueError, match="force=True"):
            carom.run(CASE, tmp_path / "parts", executor=pool)
        with pytest.raises(ValueError, match="unknown key"):
            carom.run({**CASE, "walls": []}, tmp_path / "no", executor=pool)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["parts", "whole"]


def test_a_worker_that_dies_is_replaced(tmp_path: Path) -> None:
    whole = carom.run(CASE, tmp_path / "whole", threads=1)
    with Mortal(2) as pool:
        pool.marker = str(tmp_path / "died")
        parts = carom.run(CASE, tmp_path / "parts", executor=pool, shards=3)
    assert (tmp_path / "died").exists() and files(whole.out) == files(parts.out)


def test_shards_by_hand(tmp_path: Path) -> None:
    from carom._arrays import prepared

    ready = pickle.loads(pickle.dumps(prepared(CASE)))
    for i in (1, 2):
        ready.read(None).run(tmp_path / f"{i}", 1, False, False, (i, 2), None)
    run = carom.merge([tmp_path / "2", tmp_path / "1"], tmp_path / "whole")
    assert files(run.out) == files(carom.run(CASE, tmp_path / "one").out)
    with pytest.raises(ValueError, match="shard 2/2 is missing"):
        carom.merge([tmp_path / "1"], tmp_path / "half")


@pytest.mark.cluster
def test_dask(tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    whole = carom.run(CASE, tmp_path / "whole", threads=1)
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            parts = carom.run(CASE, tmp_path / "parts", executor=client.get_executor(), shards=4)
    assert files(whole.out) == files(parts.out)


@pytest.mark.cluster
def test_mpi(tmp_path: Path) -> None:
    pytest.importorskip("mpi4py")
    script = tmp_path / "script.py"
    script.write_text(
        "import sys\nimport carom\nfrom mpi4py.futures import MPIPoolExecutor\nfrom test_run import CASE\n"
        "if __name__ == '__main__':\n    with MPIPoolExecutor() as pool:\n"
        "        carom.run(CASE, sys.argv[1], executor=pool, shards=4)\n"
    )
    mpiexec = Path(sys.executable).parent / "mpiexec"
    words = [str(mpiexec) if mpiexec.exists() else "mpiexec", "-n", "3", sys.executable, "-m", "mpi4py.futures"]
    path = {**os.environ, "PYTHONPATH": str(Path(__file__).parent)}
    told = subprocess.run([*words, str(script), str(tmp_path / "parts")], capture_output=True, text=True, env=path)
    assert told.returncode == 0, told.stderr
    assert files(carom.run(CASE, tmp_path / "whole", threads=1).out) == files(tmp_path / "parts")
