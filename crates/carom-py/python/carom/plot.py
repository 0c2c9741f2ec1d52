"""Figures with matplotlib, if it is installed; meshes in space with pyvista, if that is."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from carom._carom import WallLaw
from carom._sweep import UNITS
from carom._sweep import sweep as _sweep

if TYPE_CHECKING:
    from carom._run import Run

_LABELS = {
    "restitution": "restitution $e$",
    "normal": "normal speed after",
    "tangential": "tangential speed after",
    "spin_out": "spin after",
    "impulse_ratio": "impulse ratio",
}


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    try:
        from matplotlib import pyplot
    except ImportError:
        raise ImportError("carom.plot draws with matplotlib: pip install matplotlib") from None
    return pyplot.subplots(layout="constrained")[1]


def _label(name: str) -> str:
    unit = UNITS.get(name, "")
    return f"{_LABELS.get(name, name.replace('_', ' '))} ({unit})" if unit else _LABELS.get(name, name.replace("_", " "))


def sweep(law: WallLaw, *, of: str = "restitution", ax: Any = None, **over: Any) -> Any:
    """Draw a figure of impacts over one range, or a map over two.

    Parameters
    ----------
    law : WallLaw
        The wall.
    of : str
        What is drawn: ``"restitution"``, ``"normal"``, ``"impulse_ratio"``, ...
    ax : matplotlib.axes.Axes, optional
        Where; a new figure by default.
    **over
        As for :func:`carom.sweep`: the first axis lies along x; the second is y of a map where both are numbers of an impact, else a
        curve for each of its values.

    Returns
    -------
    matplotlib.axes.Axes

    Raises
    ------
    ImportError
        matplotlib is not installed.
    ValueError
        No range, or more than two.
    """
    found = _sweep(law, dataset=False, **over)
    axes = [name for name in over if name in found and np.ndim(found[name]) == 1 and len(np.atleast_1d(found[name])) > 0]
    if not 1 <= len(axes) <= 2:
        raise ValueError(f"a figure has one range or two, not {len(axes)}")
    ax = _axes(ax)
    x, values = found[axes[0]], found[of]
    if len(axes) == 1:
        ax.plot(x, values)
    elif axes[1] in ("speed", "diameter", "angle", "spin"):
        mesh = ax.pcolormesh(x, found[axes[1]], values.T, shading="nearest")
        ax.figure.colorbar(mesh, ax=ax, label=_label(of))
        ax.set_ylabel(_label(axes[1]))
        _log(ax.set_yscale, found[axes[1]])
    else:
        for i, value in enumerate(found[axes[1]]):
            ax.plot(x, values[:, i], label=f"{axes[1]} = {value}")
        ax.legend()
    ax.set_xlabel(_label(axes[0]))
    _log(ax.set_xscale, x)
    if len(axes) == 1 or axes[1] not in ("speed", "diameter", "angle", "spin"):
        ax.set_ylabel(_label(of))
    return ax


def _log(scale: Any, values: Any) -> None:
    """Logarithmic where values span more than a decade in even ratios."""
    values = np.asarray(values, dtype=float)
    if len(values) > 2 and values.min() > 0 and values.max() / values.min() > 10:
        ratios = values[1:] / values[:-1]
        if np.ptp(ratios) < 0.2 * ratios.mean():
            scale("log")


def trajectories(run: Run, *, plane: str = "xy", ax: Any = None, most: int = 200) -> Any:
    """Draw the recorded paths of a run.

    Parameters
    ----------
    run : Run
        A finished run.
    plane : str
        Two of ``x``, ``y`` and ``z``.
    ax : matplotlib.axes.Axes, optional
        Where; a new figure by default.
    most : int
        Paths drawn at most.

    Returns
    -------
    matplotlib.axes.Axes
    """
    if len(plane) != 2 or any(c not in "xyz" for c in plane):
        raise ValueError(f"plane={plane!r}; two of x, y and z are wanted")
    ax = _axes(ax)
    table = run.trajectories
    particle = table["particle"]
    a, b = table[plane[0]], table[plane[1]]
    edges = np.flatnonzero(np.diff(particle)) + 1
    for piece in np.split(np.arange(len(particle)), edges)[:most]:
        ax.plot(a[piece], b[piece], linewidth=0.8)
    ax.set_xlabel(f"{plane[0]} (m)")
    ax.set_ylabel(f"{plane[1]} (m)")
    ax.set_title(run.summary.get("title") or "")
    return ax


def deposit(run: Run, *, along: str = "x", bins: int = 50, wall: str | None = None, ax: Any = None) -> Any:
    """Draw where particles were captured or settled.

    Parameters
    ----------
    run : Run
        A finished run.
    along : {"x", "y", "z"}
        Along which axis they are counted.
    bins : int
        How finely.
    wall : str, optional
        Of one wall alone.
    ax : matplotlib.axes.Axes, optional
        Where; a new figure by default.

    Returns
    -------
    matplotlib.axes.Axes
    """
    ax = _axes(ax)
    table = run.fates
    kept = np.isin(table["fate"], ["captured", "settled", "trapped"])
    if wall is not None:
        kept &= table["wall"] == wall
    ax.hist(table[along][kept], bins=bins, weights=table["weight"][kept])
    ax.set_xlabel(f"{along} (m)")
    ax.set_ylabel("particles kept")
    ax.set_title(run.summary.get("title") or "")
    return ax


def mesh(run: Run, *, scalars: str | None = None, plotter: Any = None) -> Any:
    """Show the deposit of a run in space, with pyvista.

    Parameters
    ----------
    run : Run
        A finished run, with ``deposit.vtp`` in its folder.
    scalars : str, optional
        Which of its arrays colours it.
    plotter : pyvista.Plotter, optional
        Where; a new one by default.

    Returns
    -------
    pyvista.Plotter

    Raises
    ------
    ImportError
        pyvista is not installed.
    FileNotFoundError
        The run wrote no ``deposit.vtp``.
    """
    try:
        import pyvista
    except ImportError:
        raise ImportError("carom.plot.mesh draws with pyvista: pip install pyvista") from None
    file = run.out / "deposit.vtp"
    if not file.exists():
        raise FileNotFoundError(f"{file}: the case has vtk = false")
    plotter = plotter or pyvista.Plotter()
    plotter.add_mesh(pyvista.read(file), scalars=scalars)
    return plotter
