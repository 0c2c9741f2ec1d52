"""Arrays of every kind: right, or refused."""

from __future__ import annotations

import sys
import threading
import tracemalloc

import numpy as np
import pytest
from conftest import ROOT, same
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

import carom

LAW = carom.WallLaw(sphere="copper", surface="glass", normal="ea", friction=0.2, roughness_factor=0.8)
N = np.array([0.05, 0.3, 1.0, 3.0, 10.0, 20.0])
REFERENCE = LAW.impact(90e-6, normal=N, tangential=2.0)


def one(value: object) -> carom.Outcomes:
    return LAW.impact(90e-6, normal=value, tangential=2.0)  # type: ignore[call-overload,no-any-return]


@pytest.mark.parametrize(
    "array",
    [
        N.astype(">f8"),
        np.repeat(N, 3)[::3],
        N[::-1][::-1],
        np.asfortranarray(np.stack([N, N]))[0],
        np.frombuffer(b"\0" + N.tobytes(), dtype=np.uint8)[1:].view(np.float64),
        N.tolist(),
        tuple(N),
        N.astype(object),
        np.ma.masked_array(N, mask=False),
        [f"{v!r} m/s" for v in N.tolist()],
    ],
    ids=["big-endian", "strided", "reversed", "fortran", "unaligned", "list", "tuple", "object", "masked", "texts"],
)
def test_any_layout_is_right(array: object) -> None:
    assert same(one(array).restitution, REFERENCE.restitution)


def test_other_dtypes() -> None:
    whole = np.array([1, 2, 30])
    want = one(whole.astype(float)).normal
    for dtype in ("i1", "u2", "i8", "f4", "f2", ">i4", "longdouble"):
        assert same(one(whole.astype(dtype)).normal, want), dtype
    read_only = N.copy()
    read_only.flags.writeable = False
    assert same(one(read_only).normal, REFERENCE.normal)


@pytest.mark.parametrize(
    "bad",
    [np.array([1j]), np.array([True]), np.array(["2020"], "M8[D]"), np.array([b"1"]), [None, "a"], [[1], [1, 2]], {}, object(), b"1"],
    ids=["complex", "bool", "date", "bytes", "mixed", "ragged", "dict", "object", "bytes-scalar"],
)
def test_what_is_no_number_is_refused(bad: object) -> None:
    with pytest.raises((TypeError, ValueError)):
        one(bad)


def test_masked_values_are_no_impacts() -> None:
    masked = np.ma.masked_array(N, mask=[1, 0, 0, 0, 0, 1])
    out = one(masked)
    assert np.isnan(out.normal).tolist() == [True, False, False, False, False, True]
    assert out.fate[0] == "not-finite"


def test_shapes() -> None:
    assert one(np.empty((0, 3))).shape == (0, 3) and one(np.empty(0)).fate.shape == (0,)
    assert one(np.empty(0)).energy["kept"].size == 0
    assert isinstance(one(np.array(1.0)), carom.Outcome)
    grid = LAW.impact(np.array([[1e-5], [9e-5]]), normal=N, tangential=2.0)
    assert grid.shape == (2, 6) and len(grid) == 2 and grid.size == 12
    assert same(grid.restitution[1], REFERENCE.restitution)
    assert same(grid.energy["kept"][1], REFERENCE.energy["kept"])
    cube = LAW.impact(np.array([1e-5, 9e-5])[:, None, None], normal=N[:3, None], tangential=np.zeros(4), spin=1.0)
    assert cube.shape == (2, 3, 4)
    assert same(cube.normal[1, :, 0], LAW.impact(9e-5, normal=N[:3], spin=1.0).normal)
    with pytest.raises(ValueError, match=r"do not broadcast: diameter \[2\], normal \[6\]"):
        LAW.impact(np.ones(2), normal=N)


def test_broadcast_of_large_arrays_is_by_row() -> None:
    speed = np.linspace(0.1, 9, 301)[:, None]
    size = np.linspace(1e-6, 1e-4, 97)
    out = LAW.impact(size, speed, 40.0)
    whole = LAW.impact(*(np.ascontiguousarray(a) for a in np.broadcast_arrays(size, speed)), angle=40.0)
    assert same(out.normal, whole.normal) and same(out.impulse_ratio, whole.impulse_ratio)
    turned = LAW.impact(np.asfortranarray(np.broadcast_to(size, (301, 97))), speed, 40.0)
    assert same(turned.normal, whole.normal)


def test_huge_is_refused() -> None:
    huge = np.broadcast_to(1.0, (2**24, 2**24, 2**10))
    with pytest.raises((ValueError, MemoryError)):
        one(huge)
    with pytest.raises((ValueError, MemoryError)):
        LAW.impact(np.broadcast_to(1e-5, (2**31, 1)), normal=np.broadcast_to(1.0, (2**31,)))


def test_rows_that_are_none() -> None:
    bad = np.array([1.0, -1.0, np.nan, np.inf, 0.0, 1e300, 2.0])
    out = one(bad)
    assert out.fate.tolist() == ["rebound", "not-approaching", "not-finite", "not-finite", "not-approaching", "not-finite", "rebound"]
    assert np.isnan(out.normal[1:6]).all() and np.isnan(out.energy["kept"][1:6]).all()
    assert not np.isnan(out.normal[[0, 6]]).any()
    with pytest.raises(ValueError, match="row 1: the sphere does not approach the wall"):
        LAW.impact(90e-6, normal=bad, errors="raise")
    with pytest.raises(ValueError, match=r"row \(0, 1\)"):
        LAW.impact(90e-6, normal=bad[None, :], errors="raise")
    with pytest.raises(ValueError, match="errors='no'"):
        LAW.impact(90e-6, normal=bad, errors="no")  # type: ignore[call-overload]
    assert LAW.impact(90e-6, normal=-1.0, errors="nan").fate == "not-approaching"
    with pytest.raises(ValueError, match="does not approach"):
        LAW.impact(90e-6, normal=-1.0)


def test_arguments_that_exclude_each_other() -> None:
    for keys in ({}, {"speed": 1.0, "normal": 1.0}, {"normal": 1.0, "angle": 3.0}, {"speed": 1.0, "tangential": 1.0}):
        with pytest.raises(TypeError, match=r"impact\(\) takes speed="):
            LAW.impact(1e-5, **keys)  # type: ignore[call-overload]


def test_changed_arrays_are_noticed() -> None:
    n = N.copy()
    out = LAW.impact(90e-6, normal=n, tangential=2.0)
    n[2] = 5.0
    with pytest.raises(RuntimeError, match="were changed since"):
        _ = out.energy


def test_nothing_is_copied_in() -> None:
    n = np.linspace(0.1, 20, 400_000)
    tracemalloc.start()
    out = LAW.impact(90e-6, normal=n, tangential=2.0)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    outputs = 5 * n.nbytes
    assert out.normal.nbytes * 5 == outputs and most < outputs * 1.01 + 1e5, (most, outputs)


@given(
    hnp.arrays(
        dtype=hnp.floating_dtypes(endianness="?") | hnp.integer_dtypes(endianness="?"),
        shape=hnp.array_shapes(min_dims=0, max_dims=3, min_side=0, max_side=5),
    ),
    st.floats(),
    st.floats(),
)
def test_hostile_numbers(normal: np.ndarray, tangential: float, spin: float) -> None:
    out = LAW.impact(9e-5, normal=normal, tangential=tangential, spin=spin, errors="nan")
    if isinstance(out, carom.Outcome):
        return
    assert out.shape == normal.shape
    flat = normal.ravel()
    for i in range(min(flat.size, 4)):
        row = LAW.impact(9e-5, normal=float(flat[i]), tangential=tangential, spin=spin, errors="nan")
        assert same(out.normal.ravel()[i], row.normal) and out.fate.ravel()[i] == row.fate


@given(st.floats(), st.floats(), st.floats())
def test_hostile_scalars(diameter: float, speed: float, angle: float) -> None:
    out = LAW.impact(diameter, speed, angle, errors="nan")
    assert out.fate == "rebound" or out.fate == "capture" or np.isnan(out.normal)
    repr(out)


def test_density_and_draws() -> None:
    heavy = LAW.impact(9e-5, normal=N, density=[1000.0] * 6)
    assert same(heavy.normal[2], LAW.impact(9e-5, normal=1.0, density="1 g/cm3").normal)
    assert not same(heavy.normal, LAW.impact(9e-5, normal=N).normal)
    rough = LAW.replace(roughness_angle="5 deg")
    assert rough.scatters
    draws = np.random.default_rng(1).random((6, 4))
    out = rough.impact(9e-5, normal=N, tangential=2.0, draws=draws)
    for i in range(6):
        row = rough.impact(9e-5, normal=float(N[i]), tangential=2.0, draws=draws[i].tolist())
        assert same(out.normal[i], row.normal) and same(out.spin[i], row.spin)
    with pytest.raises(ValueError, match="draws: four numbers"):
        rough.impact(9e-5, normal=N, draws=draws[:, :3])


def test_threads_may_share_a_law() -> None:
    found: list[np.ndarray] = []
    workers = [threading.Thread(target=lambda: found.append(LAW.impact(9e-5, normal=np.linspace(0.1, 9, 50_000)).normal)) for _ in range(4)]
    for w in workers:
        w.start()
    for w in workers:
        w.join()
    assert all(same(f, found[0]) for f in found)


def test_a_fork_after_threads() -> None:
    if not sys.platform.startswith("linux"):
        pytest.skip("fork")
    import multiprocessing

    LAW.impact(9e-5, normal=np.linspace(0.1, 9, 200_000), threads=2)
    with multiprocessing.get_context("fork").Pool(1) as pool:
        assert pool.apply(_in_child) == 200_000


def _in_child() -> int:
    return LAW.impact(9e-5, normal=np.linspace(0.1, 9, 200_000), threads=2).size


def test_pint() -> None:
    pint = pytest.importorskip("pint")
    u = pint.UnitRegistry()
    out = LAW.impact(90 * u.um, 2 * u.m / u.s, 30 * u.deg)
    assert abs(out.restitution - LAW.impact(9e-5, 2.0, 30.0).restitution) < 1e-12
    many = LAW.impact(90 * u.um, normal=N * 1000 * u.mm / u.s, tangential=2.0)
    assert np.allclose(many.restitution, REFERENCE.restitution, rtol=1e-12)
    law = carom.WallLaw(sphere="copper", surface="glass", normal="ea", work_of_adhesion=0.5 * u.J / u.m**2)
    assert law.to_dict()["work_of_adhesion"] == 0.5
    with pytest.raises(ValueError, match="diameter: Cannot convert"):
        LAW.impact(90 * u.kg, 2.0)


def test_tables_of_others() -> None:
    pyarrow = pytest.importorskip("pyarrow")
    table = pyarrow.table(REFERENCE)
    assert table.num_rows == 6 and table["fate"].to_pylist() == REFERENCE.fate.tolist()
    assert same(table["normal"].to_numpy(), REFERENCE.normal)
    assert table.schema.field("normal").metadata[b"unit"] == b"m/s"
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(REFERENCE.to_dict())
    assert same(one(frame["restitution"].to_numpy()).normal, one(REFERENCE.restitution).normal)
    assert same(one(pandas.Series(N)).normal, REFERENCE.normal)
    polars = pytest.importorskip("polars")
    assert polars.DataFrame(REFERENCE).height == 6
    assert same(one(polars.Series(N)).normal, REFERENCE.normal)


def test_sweep() -> None:
    found = carom.sweep(LAW, speed=[0.1, 1.0, 10.0], diameter=["10 um", "90 um"], friction=[0.1, 0.2], angle=40, dataset=False)
    assert found["restitution"].shape == (3, 2, 2) and found["diameter"].tolist() == [1e-5, 9e-5]
    want = LAW.replace(friction=0.1).impact(9e-5, 10.0, 40.0)
    assert found["tangential"][2, 1, 0] == want.tangential and found["fate"][2, 1, 0] == want.fate
    xarray = pytest.importorskip("xarray")
    data = carom.sweep(LAW, speed=N, diameter="90 um", energy=True)
    assert isinstance(data, xarray.Dataset) and data.restitution.dims == ("speed",) and data.speed.attrs["units"] == "m/s"
    assert float(data.kept[3]) == LAW.impact(9e-5, 3.0).energy["kept"]


def test_numbers_out_of_range_and_things_of_the_wrong_kind_are_mistakes_like_any_other(copper: carom.WallLaw) -> None:
    for wrong in [
        lambda: copper.impact(np.full(3, 9e-5), 2, threads=-1),
        lambda: carom.sticking(copper, "lognormal(50um, 1.3)", 0.05, samples=-3),
        lambda: carom.sticking(copper, "lognormal(50um, 1.3)", 0.05, samples=10**12),
        lambda: carom.sticking(copper, "lognormal(50um, 1.3)", 0.05, seed=-1),
        lambda: carom.run(ROOT / "examples/wind-tunnel.toml", threads=-1),
        lambda: carom.validity_codes(2**40),
        lambda: copper.impact(10**400, 2),
    ]:
        with pytest.raises(ValueError, match=r"is out of range|too large"):
            wrong()
    for missing in [lambda: copper.impact(None, 2), lambda: copper.capture_velocity(None)]:
        with pytest.raises(TypeError, match="diameter: None"):
            missing()
    for case in [{"flow": None}, {"wall": {}}, {"wall": ["floor"]}, {"injection": "dust"}]:
        with pytest.raises(TypeError, match=r"(a dict|a list of dicts) is wanted, not"):
            carom.run(case)
    with pytest.raises(TypeError, match="executor: .* not int"):
        carom.run({"flow": {"kind": "still"}}, executor=3)
    one, many = copper.impact(np.full(5, 9e-5), 2, threads=1), copper.impact(np.full(5, 9e-5), 2, threads=0)
    assert (one.restitution == many.restitution).all()
