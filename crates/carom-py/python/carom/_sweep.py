"""Impacts all over a range."""

from __future__ import annotations

import importlib.util
from collections.abc import Iterable
from typing import Any

import numpy as np
import numpy.typing as npt

from carom._carom import Outcome, WallLaw, law_keys

#: Units of what an impact takes and gives, for labels.
UNITS = {
    "diameter": "m",
    "speed": "m/s",
    "angle": "deg",
    "spin": "rad/s",
    "normal": "m/s",
    "tangential": "m/s",
    "spin_out": "rad/s",
    "density": "kg/m3",
}

_MOTION = ("diameter", "speed", "angle", "spin", "density")
_GIVEN = ("restitution", "normal", "tangential", "impulse_ratio", "tangential_restitution")


def sweep(law: WallLaw, *, dataset: bool | None = None, energy: bool = False, **over: Any) -> Any:
    """Impacts at every combination of the values given.

    Parameters
    ----------
    law : WallLaw
        The wall.
    diameter, speed, angle, spin, density : number, str or array_like
        The sphere and its motion, as :meth:`WallLaw.impact` takes them: m, m/s, degrees from the surface, rad/s, kg/m3. Each that is an
        array or a list is an axis of the result, in the order in which it is given.
    dataset : bool, optional
        ``True`` for an ``xarray.Dataset``, ``False`` for a dict of arrays; by default a dataset where xarray is installed.
    energy : bool
        Whether the shares of the energy are filled in too (slower).
    **over
        Keys of the law may be varied besides, each a list of values: ``friction=[0.1, 0.2]``.

    Returns
    -------
    xarray.Dataset or dict of str to numpy.ndarray
        ``fate``, ``restitution``, ``normal``, ``tangential`` and ``spin_out`` after the impact, ``impulse_ratio``,
        ``tangential_restitution``, ``validity`` (bits, :data:`carom.VALIDITY`) and, if asked for, the energy's shares. A dict also
        holds the values of each axis under its name. Impacts that are none are NaN.

    Raises
    ------
    ValueError, TypeError
        A value that the law or the impact does not take.

    Examples
    --------
    >>> import carom
    >>> law = carom.WallLaw(sphere="copper", surface="glass", normal="ea")
    >>> found = carom.sweep(law, speed=[0.1, 1.0, 10.0], diameter=["10 um", "90 um"], dataset=False)
    >>> found["restitution"].shape
    (3, 2)
    """
    for name in ("diameter", "speed"):
        if name not in over:
            raise TypeError(f"sweep() needs {name}=")
    axes = {name: value for name, value in over.items() if _is_axis(value)}
    fixed = {name: value for name, value in over.items() if name not in axes}
    law = law.replace(**{k: v for k, v in fixed.items() if k not in _MOTION})
    keys = [name for name in axes if name not in _MOTION]
    moved = [name for name in axes if name in _MOTION]
    shape = {name: len(axes[name]) for name in axes}
    motion = {k: v for k, v in fixed.items() if k in _MOTION}
    for place, name in enumerate(moved):
        axis = np.asarray(axes[name])
        motion[name] = _at(axes[name], axis, len(moved), place)
    answers = {}
    for index in np.ndindex(*(shape[k] for k in keys)):
        one = law.replace(**{k: axes[k][i] for k, i in zip(keys, index, strict=True)}) if keys else law
        answers[index] = _columns(one, motion, energy)
    columns = {}
    lengths = [shape[k] for k in keys] + [shape[k] for k in moved]
    for name in next(iter(answers.values())):
        stacked = np.stack([np.asarray(a[name]) for a in answers.values()]) if keys else answers[()][name]
        whole = np.reshape(stacked, lengths)
        # in the order in which the axes were given
        order = [(*keys, *moved).index(name) for name in axes]
        columns[name] = np.transpose(whole, order)
    values = {name: _values(name, axes[name]) for name in axes}
    if dataset is None:
        dataset = importlib.util.find_spec("xarray") is not None
    return _dataset(law, values, columns) if dataset else {**values, **columns}


def _is_axis(value: Any) -> bool:
    if isinstance(value, (str, bytes, dict)):
        return False
    if not isinstance(value, Iterable):
        return False
    inner: Any = getattr(value, "magnitude", value)
    if np.ndim(inner) > 1:
        raise ValueError("an axis of a sweep has one dimension")
    return bool(np.ndim(inner) == 1)


def _at(given: Any, axis: npt.NDArray[Any], axes: int, place: int) -> Any:
    shape = [1] * axes
    shape[place] = -1
    if hasattr(given, "magnitude"):
        return given.reshape(shape)
    return axis.reshape(shape)


def _columns(law: WallLaw, motion: dict[str, Any], energy: bool) -> dict[str, Any]:
    out = law.impact(**motion, errors="nan")
    columns: dict[str, Any] = {"fate": out.fate}
    for name in _GIVEN:
        columns[name] = getattr(out, name)
    columns["spin_out"] = out.spin
    if isinstance(out, Outcome):
        from carom._carom import VALIDITY

        columns["validity"] = sum(VALIDITY[code][0] for code in out.validity)
    else:
        columns["validity"] = out.validity
    if energy:
        columns.update(out.energy)
    return columns


def _values(name: str, given: Any) -> npt.NDArray[Any]:
    """An axis in SI units; texts of a law's keys stay texts."""
    from carom._carom import _si

    if name in _MOTION:
        return np.asarray(_si(name, given))
    return np.asarray(given)


def _dataset(law: WallLaw, values: dict[str, Any], columns: dict[str, Any]) -> Any:
    import xarray

    units = {**{name: about["unit"] for name, about in law_keys().items()}, **UNITS}
    found = xarray.Dataset(
        {name: (tuple(values), column) for name, column in columns.items()},
        coords=values,
        attrs={"law": str(law)},
    )
    for name, column in found.variables.items():
        unit = units.get(str(name))
        if unit:
            column.attrs["units"] = unit
    return found
