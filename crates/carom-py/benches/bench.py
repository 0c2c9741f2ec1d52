"""What a call costs, beside NumPy and SciPy in the same process.

``python benches/bench.py [ROWS]``: a million oblique impacts against the same closed form in NumPy; the resolved contact against
``scipy.integrate.solve_ivp`` at the same tolerance; a scalar call against an empty one; the memory of a call against its outputs.
"""

from __future__ import annotations

import sys
import time
import tracemalloc
from collections.abc import Callable

import numpy as np

import carom
from carom import _carom

KEYS = {"sphere": "stainless-steel", "surface": "silicon", "friction": 0.2, "roughness_factor": 0.15}


def best(work: Callable[[], object], times: int = 7) -> float:
    """Shortest of several."""
    took = []
    for _ in range(times):
        start = time.perf_counter()
        work()
        took.append(time.perf_counter() - start)
    return min(took)


def closed_form(law: carom.WallLaw) -> Callable[..., list[np.ndarray]]:
    """Kim & Dunn (2007), Eqs 16-21 and 26-30, on a flat wall: the adhesion work and rolling friction."""
    pair = law.pair
    assert pair is not None
    k, w, rho, c_r, f = pair["stiffness"], pair["work_of_adhesion"], pair["density"], law.roughness_factor, 0.2
    # everything that no row changes, outside
    constant = (8 * np.pi / 3) * c_r * (9 * k * w**2 / (2 * np.pi)) ** (1 / 3) * (5 / (4 * k)) ** 0.6 / (4 / 3 * np.pi * rho) ** 0.4

    def impacts(d: np.ndarray, n: np.ndarray, t: np.ndarray, s: np.ndarray) -> list[np.ndarray]:
        r = 0.5 * d
        left = 1 - constant * r ** (-2 / 3) * n ** (-0.8)
        e = np.sqrt(np.maximum(left, 0))
        slip = t - r * s
        jump = (1 + e) * n
        impulse = np.minimum(f * jump, (2 / 7) * np.abs(slip))
        push = np.copysign(impulse, slip)
        stays = left <= 0
        ratio = np.where(stays, np.nan, impulse / jump)
        return [np.where(stays, 0, e * n), np.where(stays, 0, t - push), np.where(stays, 0, s + 2.5 * push / r), e, ratio]

    return impacts


def arrays(count: int) -> None:
    law = carom.WallLaw(normal="ea", **KEYS)
    rng = np.random.default_rng(1)
    d, n = 10 ** rng.uniform(-5, -4, count), 10 ** rng.uniform(-1.5, 1, count)
    t, s = rng.uniform(0, 10, count), rng.normal(0, 1e4, count)
    numpy_ = closed_form(law)
    out, want = law.impact(d, normal=n, tangential=t, spin=s), numpy_(d, n, t, s)
    for name, column in zip(["normal", "tangential", "spin", "restitution", "impulse_ratio"], want, strict=True):
        got = getattr(out, name)
        off = np.nanmax(np.abs(got - column) / np.maximum(np.abs(column), 1e-3))
        assert off < 1e-6, (name, off)
    ours, theirs = best(lambda: law.impact(d, normal=n, tangential=t, spin=s)), best(lambda: numpy_(d, n, t, s), 3)
    one = best(lambda: law.impact(d, normal=n, tangential=t, spin=s, threads=1))
    print(f"{count} oblique impacts: {ours * 1e3:.1f} ms ({one * 1e3:.1f} ms on one thread), numpy {theirs * 1e3:.1f} ms: {theirs / ours:.1f} times")
    speed, angle = np.hypot(n, t), np.degrees(np.arctan2(n, t))
    print(f"  with speed and angle: {best(lambda: law.impact(d, speed, angle, s)) * 1e3:.1f} ms")
    print(f"  energies besides: {best(lambda: law.impact(d, normal=n, tangential=t, spin=s).energy, 3) * 1e3:.1f} ms")
    tracemalloc.start()
    out = law.impact(d, normal=n, tangential=t, spin=s)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    print(f"  memory of the call: {most / (5 * out.normal.nbytes):.4f} of its outputs")


def resolved() -> None:
    """The contact equation of src/resolved.rs, m x'' = -sqrt(r) K x^1.5 (1 + C_H x') + 2 pi a f0 C_R (1 - C_A x') while separating."""
    from scipy.integrate import solve_ivp

    law = carom.WallLaw(normal="resolved", adhesion_damping=1.3, hertz_damping=0.007, **KEYS)
    pair = law.pair
    assert pair is not None
    k, w, rho, c_r = pair["stiffness"], pair["work_of_adhesion"], pair["density"], law.roughness_factor
    c_a, c_h, r = 1.3, 0.007, 35e-6
    m = 4 / 3 * np.pi * r**3 * rho
    f0 = (9 * k * r * w**2 / (2 * np.pi)) ** (1 / 3)
    speeds = np.geomspace(0.5, 10, 8)

    def scipys(v: float) -> float:
        # in units of the Hertz contact, with x = s^2 and dt = 2 s dsigma as in the core
        length = (m * v * v / (np.sqrt(r) * k)) ** 0.4
        a = 2 * np.pi * np.sqrt(r * length) * f0 * c_r * length / (m * v * v)

        def right(_: float, y: np.ndarray) -> list[float]:
            s, u = y
            pull = a * (1 - c_a * v * u) if u < 0 else 0.0
            return [u, 2 * s * s * (pull - s * s * (1 + c_h * v * u))]

        def ends(_: float, y: np.ndarray) -> float:
            return float(y[0])

        def turns(_: float, y: np.ndarray) -> float:
            return float(y[1])

        ends.terminal, ends.direction = True, -1  # type: ignore[attr-defined]
        turns.terminal = True  # type: ignore[attr-defined]
        # from the first touch to the turning point, and from there to the end
        first = solve_ivp(right, (0, 1e3), [1e-8, 1.0], method="DOP853", rtol=2e-9, atol=1e-12, events=turns)
        last = solve_ivp(right, (0, 1e3), [first.y[0, -1], -1e-12], method="DOP853", rtol=2e-9, atol=1e-12, events=ends)
        return -float(last.y[1, -1])

    want = np.array([scipys(v) for v in speeds])
    got = law.impact(2 * r, normal=speeds).restitution
    theirs = best(lambda: [scipys(v) for v in speeds], 3) / len(speeds)
    many = np.repeat(speeds, 2000)
    ours = best(lambda: law.impact(2 * r, normal=many), 3) / len(many)
    single = best(lambda: law.impact(2 * r, normal=many[:2000], threads=1), 3) / 2000
    print(
        f"resolved contact: {ours * 1e6:.2f} us ({single * 1e6:.2f} us on one thread), solve_ivp {theirs * 1e6:.0f} us: "
        f"{theirs / ours:.0f} times; greatest difference of e {np.abs(got - want).max():.1e}"
    )


def scalars() -> None:
    law = carom.WallLaw(normal="ea", **KEYS)
    count = 200_000

    def calls() -> None:
        for _ in range(count):
            law.impact(9e-5, 2.0, 30.0)

    def named() -> None:
        for _ in range(count):
            law.impact(diameter=9e-5, speed=2.0, angle=30.0, spin=0.0)

    def empty() -> None:
        for _ in range(count):
            _carom._nothing()

    nothing = best(empty) / count
    print(
        f"a scalar call: {best(calls) / count * 1e9:.0f} ns ({best(named) / count * 1e9:.0f} ns with keywords), "
        f"an empty one {nothing * 1e9:.0f} ns"
    )


if __name__ == "__main__":
    arrays(int(sys.argv[1]) if len(sys.argv) > 1 else 1_000_000)
    resolved()
    scalars()
