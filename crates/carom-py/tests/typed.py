"""What mypy --strict makes of the stubs: it is checked, and run."""

from __future__ import annotations

from typing import Any

from typing_extensions import assert_type

import numpy as np
import numpy.typing as npt

import carom

law = carom.WallLaw(sphere="copper", surface="glass", normal="ea", friction=0.2)
assert_type(law, carom.WallLaw)
assert_type(law.impact(9e-5, 2.0, 30.0), carom.Outcome)
assert_type(law.impact("90 um", normal=2, errors="nan").energy, dict[str, float])
many = law.impact(np.linspace(1e-5, 9e-5, 3), speed=2.0)
assert_type(many, carom.Outcomes)
assert_type(many.restitution, npt.NDArray[np.float64])
assert_type(law.capture_velocity(9e-5), float)
assert_type(carom.materials["copper"].density, float | None)
assert_type(carom.validity_codes(3), tuple[str, ...])
assert_type(carom.sticking(law, "lognormal(10um, 1.5)", 0.5, samples=10), dict[str, Any])
assert_type(law.replace(friction=None), carom.WallLaw)
