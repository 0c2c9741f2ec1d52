"""Parameters from measurements; the models held against experiments."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from carom import _carom
from carom._carom import Materials, Table, WallLaw

_COLUMNS = ("speed", "restitution", "diameter", "angle", "tangential_restitution", "sigma")


@dataclass(frozen=True)
class Fit:
    """What a fit found.

    Attributes
    ----------
    law : WallLaw
        The law with the values found.
    values : dict of str to float
        The least-squares value of each parameter, SI units.
    parameters : list of dict
        Each with value, standard error, 95 % interval, bootstrap interval and bounds.
    correlation : list of list of float
        Between each two parameters, in their order.
    goodness : dict
        How the law meets the data.
    warnings : list of str
        What to mind, with what would help.
    residuals : list of dict
        Every value measured, beside the law's.
    left_out : list of str
        Columns that nothing reads.
    """

    law: WallLaw
    values: dict[str, float]
    parameters: list[dict[str, Any]]
    correlation: list[list[float]]
    goodness: dict[str, Any]
    warnings: list[str]
    residuals: list[dict[str, Any]]
    left_out: list[str] = field(default_factory=list)

    def __repr__(self) -> str:
        lines = []
        for one in self.parameters:
            interval = one.get("bootstrap") or one.get("interval")
            ends = f", 95 % {interval[0]:.4g} to {interval[1]:.4g}" if interval else ""
            lines.append(f"{one['parameter']} = {one['value']:.5g} {one['unit']}".rstrip() + ends)
        return "\n".join(lines + [f"warning: {text}" for text in self.warnings])


def fit(
    points: Any,
    law: WallLaw,
    free: Sequence[str],
    *,
    bounds: Mapping[str, tuple[float, float]] | None = None,
    diameter: Any = None,
    resamples: int = 1000,
    seed: int = 1,
    resample: str = "residuals",
) -> Fit:
    """Find parameters of a law from measured restitution, with their uncertainty.

    Parameters
    ----------
    points : path, dict of arrays, or a table of pandas or polars
        Columns ``speed`` (m/s), ``restitution`` (0 for a sphere that stayed) and, where known, ``diameter`` (m), ``angle`` (degrees from
        the surface), ``tangential_restitution``, ``sigma`` (standard uncertainty of both). A path names a CSV file of that form.
    law : WallLaw
        The law whose parameters are looked for.
    free : sequence of str
        Which: ``"adhesion_damping"``, ``"hertz_damping"``, ``"roughness_factor"``, ``"work_of_adhesion"``, ``"plastic_constant"``,
        ``"friction"``.
    bounds : dict of str to (float, float), optional
        Where each may lie, SI units.
    diameter : number or str, optional
        The spheres' diameter where the points have no column for it, m.
    resamples : int
        Fits to data drawn again, 0 for none.
    seed : int
        Of the draws.
    resample : {"residuals", "pairs"}
        What is drawn again.

    Returns
    -------
    Fit
        Same bits as ``carom fit`` gives.

    Raises
    ------
    ValueError, TypeError
        Points that cannot be read, a parameter that does nothing in the law, data that cannot tell.
    """
    if isinstance(points, (str, os.PathLike)):
        name, csv = os.fspath(points), Path(points).read_text(encoding="utf-8")
    else:
        name, csv = "points", _csv(points)
    size = None if diameter is None else float(_carom._si("diameter", diameter))
    limits = [(key, float(low), float(high)) for key, (low, high) in (bounds or {}).items()]
    free = [free] if isinstance(free, str) else list(free)
    found = _carom.fit(name, csv, law, free, limits, size, resamples, seed, resample)
    told = found["fit"]
    return Fit(
        law=found["law"],
        values={one["parameter"]: one["value"] for one in told["parameters"]},
        parameters=told["parameters"],
        correlation=told["correlation"],
        goodness=told["goodness"],
        warnings=told["warnings"],
        residuals=told["residuals"],
        left_out=found["left_out"],
    )


def _csv(points: Any) -> str:
    """Columns as a text whose numbers have the same bits."""
    names = list(points.columns) if hasattr(points, "columns") else list(points)
    columns = {str(name): np.asarray(points[name], dtype=float) for name in names if name in _COLUMNS}
    if not columns:
        raise ValueError(f"points: no column that is read; known are {', '.join(_COLUMNS)}")
    lengths = {name: column.shape for name, column in columns.items()}
    if len(set(lengths.values())) != 1 or len(next(iter(lengths.values()))) != 1:
        raise ValueError(f"points: columns of one length are wanted, not of {lengths}")
    rows = [",".join(columns)]
    for row in zip(*columns.values(), strict=True):
        rows.append(",".join("" if np.isnan(value) else repr(float(value)) for value in row))
    return "\n".join(rows) + "\n"


@dataclass(frozen=True)
class Validation:
    """The models held against the experiments.

    Attributes
    ----------
    summary : Table
        One row for each model that meets values.
    found : dict
        Everything, as ``report.json`` holds it.
    """

    summary: Table
    found: dict[str, Any]

    def __repr__(self) -> str:
        return f"<carom.Validation: {len(self.summary)} comparisons>"

    def _repr_html_(self) -> str:
        return self.summary._repr_html_()


def validate(
    folder: str | os.PathLike[str] | None = None,
    *,
    out: str | os.PathLike[str] | None = None,
    materials: Materials | None = None,
) -> Validation:
    """Hold the models against measured and stated values.

    Parameters
    ----------
    folder : path, optional
        Experiments of one's own; those that come along by default.
    out : path, optional
        Folder for ``report.html`` and ``report.json``.
    materials : Materials, optional
        The library; the built-in one by default.

    Returns
    -------
    Validation
        As ``carom validate`` finds it.

    Raises
    ------
    ValueError
        What is wrong in an experiment's file, with its place.
    OSError
        What cannot be read or written.
    """
    found = _carom.validate(folder, out, materials)
    return Validation(summary=found["summary"], found=found["found"])
