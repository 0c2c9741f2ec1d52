"""Particles of a case from injection to fate: here, on several threads, or wherever an executor runs it."""

from __future__ import annotations

import concurrent.futures
import json
import os
import shutil
import tempfile
import time
import weakref
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from carom import _carom
from carom._arrays import Prepared, prepared
from carom._carom import Case, Materials, Table

#: Anything that takes particles done and all of them.
Callback = Callable[[int, int], object]

#: How often a part whose worker died is tried again.
RETRIES = 3


class Run:
    """A finished run and its folder.

    Attributes
    ----------
    summary : dict
        Counts and masses by fate and by wall, as ``summary.json`` holds them.
    out : pathlib.Path
        The folder. Where none was asked for, it goes when the run is no longer used.
    """

    def __init__(self, summary: dict[str, Any], out: Path, keeps: bool) -> None:
        self.summary = summary
        self.out = out
        if not keeps:
            weakref.finalize(self, shutil.rmtree, out, True)

    def table(self, name: str) -> Table:
        """A table by its name: ``impacts``, ``fates``, ``trajectories`` or ``deposition``.

        Raises
        ------
        FileNotFoundError
            The case writes none.
        """
        return Table.of_run(self.out, name)

    @property
    def impacts(self) -> Table:
        """Every impact, ordered by particle and time; SI units in the columns' metadata."""
        return self.table("impacts")

    @property
    def fates(self) -> Table:
        """Every particle's end."""
        return self.table("fates")

    @property
    def trajectories(self) -> Table:
        """Points of the paths that were recorded."""
        return self.table("trajectories")

    @property
    def deposition(self) -> Table:
        """What each wall kept, by region and size."""
        return self.table("deposition")

    def __repr__(self) -> str:
        ended = ", ".join(f"{n} {fate}" for fate, n in self.summary["fates"].items() if n)
        title = f"{self.summary['title']}: " if self.summary.get("title") else ""
        return f"<carom.Run {title}{self.summary['injected']} particles: {ended}>"

    def _repr_html_(self) -> str:
        rows = "".join(f"<tr><th>{fate}</th><td>{n}</td></tr>" for fate, n in self.summary["fates"].items() if n)
        walls = "".join(
            f"<tr><th>{name}</th><td>{wall['impacts']} impacts, {wall['captured']} captured</td></tr>"
            for name, wall in self.summary["walls"].items()
        )
        return f"<table><caption>{self.summary.get('title', '')}</caption>{rows}{walls}</table>"


def run(
    case: str | os.PathLike[str] | Mapping[str, Any],
    out: str | os.PathLike[str] | None = None,
    *,
    threads: int = 0,
    executor: Any = None,
    shards: int | None = None,
    progress: bool | Callback = False,
    resume: bool = False,
    force: bool = False,
    materials: Materials | None = None,
) -> Run:
    """Take the particles of a case through its flow to their walls.

    Parameters
    ----------
    case : path or dict
        A case file, or its tables as a dict. A dict may hold NumPy arrays: ``flow = {"kind": "table", "columns": {"x": ..., "u": ...}}``,
        a wall's ``triangles = (vertices, faces)`` in m, an injection's ``particles`` with columns ``x, y, z`` (m), ``u, v, w`` (m/s),
        ``diameter`` (m), ``weight``, ``time`` (s).
    out : path, optional
        Folder for the results. Without one they are kept while the run is used.
    threads : int
        Threads here, or in each worker of an executor; 0 for as many as the machine has (with an executor: 1).
    executor : concurrent.futures.Executor, optional
        Where the parts of the run are made: a process pool, ``dask.distributed.Client.get_executor()``,
        ``mpi4py.futures.MPIPoolExecutor``. Workers must see the folder. The result has the bits of a run on one machine.
    shards : int, optional
        Number of parts for the executor; four for each of its workers by default.
    progress : bool or callable
        ``True`` shows a bar (in a notebook too, if tqdm is installed); a callable is given the particles done and all of them.
    resume : bool
        Go on where an interrupted run in the folder stopped.
    force : bool
        Replace a run that is in the folder.
    materials : Materials, optional
        The library; the built-in one by default.

    Returns
    -------
    Run
        Its tables are Arrow's: pandas, polars and pyarrow read them without a copy.

    Raises
    ------
    ValueError
        What is wrong in the case, with its place; a folder that holds another run.
    OSError
        What cannot be read or written.
    KeyboardInterrupt
        Ctrl-C stops the run; what is in the folder can be resumed.

    Examples
    --------
    >>> import carom
    >>> found = carom.run({
    ...     "flow": {"kind": "still"},
    ...     "forces": {"gravity": [0, -9.81, 0]},
    ...     "wall": [{"name": "floor", "plane": {"point": [0, 0, 0], "normal": [0, 1, 0]}, "law": "steel"}],
    ...     "injection": [{"material": "glass", "diameter": "100um", "position": [0, "1mm", 0], "velocity": [0, 0, 0]}],
    ...     "law": {"steel": {"sphere": "glass", "surface": "stainless-steel", "normal": "ea", "friction": 0.2}},
    ...     "run": {"until": "1 s"},
    ... })
    >>> found.summary["injected"]
    1
    """
    if executor is not None and not hasattr(executor, "submit"):
        raise TypeError(f"executor: a concurrent.futures.Executor is wanted, not {type(executor).__name__}")
    ready = prepared(case)
    read = ready.read(materials)
    folder = Path(tempfile.mkdtemp(prefix="carom-")) if out is None else Path(out)
    try:
        with _told(progress, read) as told:
            if executor is None:
                text = read.run(folder, threads, resume, force or out is None, None, told)
            else:
                text = _spread(ready, materials, read, folder, executor, shards, threads or 1, force or out is None, told)
    except BaseException:
        if out is None:
            shutil.rmtree(folder, ignore_errors=True)
        raise
    return Run(json.loads(text), folder, out is not None)


def merge(
    shards: Sequence[str | os.PathLike[str]], out: str | os.PathLike[str], *, force: bool = False
) -> Run:
    """Put the shards of a run together.

    Parameters
    ----------
    shards : sequence of paths
        The folders of all shards, in any order.
    out : path
        Folder for the whole.
    force : bool
        Replace a run that is in the folder.

    Returns
    -------
    Run
        To the bit what the whole run would have been.

    Raises
    ------
    ValueError
        A shard that is missing, unfinished, damaged or of another run.
    """
    return Run(json.loads(_carom.merge(list(shards), out, force)), Path(out), True)


def load(out: str | os.PathLike[str]) -> Run:
    """A run that was made before, by its folder.

    Raises
    ------
    FileNotFoundError
        There is none.
    """
    folder = Path(out)
    return Run(json.loads((folder / "summary.json").read_text(encoding="utf-8")), folder, True)


@dataclass(frozen=True)
class _Part:
    """One shard, as it is sent to a worker."""

    ready: Prepared
    materials: Materials | None
    folder: str
    index: int
    of: int
    threads: int

    def __call__(self) -> int:
        # what a dead worker had done is taken up; one that has never begun begins
        self.ready.read(self.materials).run(
            self.folder, self.threads, os.path.isdir(self.folder), False, (self.index, self.of), None
        )
        return self.index


def _workers(executor: Any) -> int:
    for name in ("_max_workers", "num_workers"):
        found = getattr(executor, name, None)
        if isinstance(found, int) and found > 0:
            return found
    client = getattr(executor, "_client", None)
    if client is not None:
        return max(1, len(client.scheduler_info()["workers"]))
    return os.cpu_count() or 1


def _renewed(executor: Any) -> Any:
    """A process pool in place of one that lost a worker, which takes no more work; ``None`` where the executor goes on."""
    if isinstance(executor, concurrent.futures.ProcessPoolExecutor):
        return concurrent.futures.ProcessPoolExecutor(
            max_workers=_workers(executor),
            mp_context=getattr(executor, "_mp_context", None),
        )
    return None


def _spread(
    ready: Prepared,
    materials: Materials | None,
    read: Case,
    out: Path,
    executor: Any,
    shards: int | None,
    threads: int,
    force: bool,
    told: Callback | None,
) -> str:
    """Shards by an executor, merged here."""
    number = shards if shards is not None else 4 * _workers(executor)
    if number < 1:
        raise ValueError(f"shards={number}; 1 or more are wanted")
    if out.is_dir() and any(out.iterdir()) and not force and (out / "checkpoint.json").exists():
        raise ValueError(f"{out}: holds a run: replace it with force=True, or name another folder")
    out.parent.mkdir(parents=True, exist_ok=True)
    room = Path(tempfile.mkdtemp(prefix=".carom-shards-", dir=out.parent))
    parts = [
        _Part(ready, materials, str(room / f"{index}"), index, number, threads) for index in range(1, number + 1)
    ]
    own: list[Any] = []
    try:
        _all_done(executor, parts, own, lambda done: told(read.count * done // number, read.count) if told else None)
        return _carom.merge([part.folder for part in parts], out, force)
    finally:
        for pool in own:
            pool.shutdown()
        shutil.rmtree(room, ignore_errors=True)


def _all_done(executor: Any, parts: list[_Part], own: list[Any], told: Callable[[int], object]) -> None:
    """Every part done, those of workers that died once more."""
    waiting = {part: 0 for part in parts}
    done = 0
    while waiting:
        futures: dict[Any, _Part] = {}
        broken = False
        failed: dict[_Part, BaseException] = {}
        try:
            for part in waiting:
                futures[executor.submit(part)] = part
        except concurrent.futures.BrokenExecutor:
            broken = True
        try:
            for future, part in futures.items():
                try:
                    future.result()
                except (ValueError, TypeError, KeyboardInterrupt):
                    # a mistake in the case is one on every worker
                    raise
                except concurrent.futures.BrokenExecutor as error:
                    broken, failed[part] = True, error
                except Exception as error:
                    failed[part] = error
                else:
                    del waiting[part]
                    done += 1
                    told(done)
        except BaseException:
            for future in futures:
                future.cancel()
            raise
        for part, reason in failed.items():
            waiting[part] += 1
            if waiting[part] > RETRIES:
                raise RuntimeError(f"part {part.index} of {part.of} failed {waiting[part]} times") from reason
        if broken:
            fresh = _renewed(executor)
            if fresh is None:
                raise concurrent.futures.BrokenExecutor("the executor takes no more work")
            own.append(fresh)
            executor = fresh


class _told:
    """The callback of a run, or a bar."""

    def __init__(self, progress: bool | Callback, case: Case) -> None:
        self._progress = progress
        self._case = case
        self._bar: Any = None

    def __enter__(self) -> Callback | None:
        if callable(self._progress):
            return self._progress
        if not self._progress:
            return None
        try:
            from tqdm.auto import tqdm
        except ImportError:
            return self._line
        self._bar = tqdm(total=self._case.count, unit=" particles")
        return self._move

    def _move(self, done: int, _: int) -> None:
        self._bar.update(done - self._bar.n)

    def _line(self, done: int, count: int) -> None:
        now = time.monotonic()
        if done == count or now - (self._bar or 0.0) > 0.5:
            self._bar = now
            print(f"\r{done} of {count} particles", end="\n" if done == count else "", flush=True)

    def __exit__(self, *_: object) -> None:
        if hasattr(self._bar, "close"):
            self._bar.close()
