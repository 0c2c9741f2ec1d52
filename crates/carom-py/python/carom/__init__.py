"""A small particle hits a wall: does it stick or bounce, and how does it leave?

A :class:`WallLaw` is made of the keys of a law file and answers impacts, single ones and arrays. :func:`sweep` asks it all over a
range, :func:`sticking` where values are uncertain, :func:`run` takes particles through a flow to their walls, :func:`fit` finds a law's
parameters from measurements. SI units everywhere; angles in degrees from the surface.

>>> import carom
>>> law = carom.WallLaw(sphere="copper", surface="glass", normal="ea", friction=0.2, roughness_factor=0.8)
>>> out = law.impact(diameter=90e-6, speed=2.0, angle=30.0)
>>> out.fate, round(out.restitution, 5)
('rebound', 0.92321)
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from carom._carom import (
    VALIDITY,
    Material,
    Materials,
    Outcome,
    Outcomes,
    Table,
    WallLaw,
    __version__,
    law_keys,
    sticking,
    validity_codes,
)

if TYPE_CHECKING:
    from carom import plot
    from carom._lab import Fit, Validation, fit, validate
    from carom._run import Run, load, merge, run
    from carom._sweep import sweep

Mapping.register(Materials)

#: The materials that come along, each value with its source.
materials = Materials()

__all__ = [
    "VALIDITY",
    "Fit",
    "Material",
    "Materials",
    "Outcome",
    "Outcomes",
    "Run",
    "Table",
    "Validation",
    "WallLaw",
    "__version__",
    "fit",
    "law_keys",
    "load",
    "materials",
    "merge",
    "plot",
    "run",
    "sticking",
    "sweep",
    "validate",
    "validity_codes",
]

_LATER = {
    "sweep": "_sweep",
    "run": "_run",
    "merge": "_run",
    "load": "_run",
    "Run": "_run",
    "fit": "_lab",
    "Fit": "_lab",
    "validate": "_lab",
    "Validation": "_lab",
}


def __getattr__(name: str) -> Any:
    """Load what the command does not need when it is asked for."""
    import importlib

    if name == "plot":
        return importlib.import_module("carom.plot")
    if name in _LATER:
        return getattr(importlib.import_module(f"carom.{_LATER[name]}"), name)
    raise AttributeError(f"module 'carom' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
