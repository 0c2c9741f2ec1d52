"""Laws: made, read, refused, written, pickled, shown."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path

import numpy as np
import pytest
from conftest import command
from hypothesis import given
from hypothesis import strategies as st

import carom


def test_units_are_read(copper: carom.WallLaw) -> None:
    damped = copper.replace(hertz_damping="7 ms/m", adhesion_damping=np.float64(1.3))
    assert damped.to_dict()["hertz_damping"] == 0.007
    assert damped.to_dict()["adhesion_damping"] == 1.3
    a, b = copper.impact("90 um", "2 m/s", "30 deg"), copper.impact(9e-5, 2, 30)
    assert a.restitution == b.restitution and abs(a.restitution - 0.92321) < 5e-6


def test_errors_speak_python() -> None:
    with pytest.raises(TypeError, match="unknown key 'frictoin'; did you mean friction"):
        carom.WallLaw(normal="ea", frictoin=0.2)
    with pytest.raises(ValueError, match=r"normal='tabor' needs a fitted yield velocity; give yield_velocity='0.09 m/s'"):
        carom.WallLaw(normal="tabor", meyer_index=2.3)
    with pytest.raises(ValueError, match="unknown material 'coper'; did you mean copper"):
        carom.WallLaw(sphere="coper", surface="glass", normal="ea")
    with pytest.raises(ValueError, match=r"friction=-1 is out of range"):
        carom.WallLaw(sphere="copper", surface="glass", normal="ea", friction=-1)
    with pytest.raises(ValueError, match="hertz_damping.*is wanted|hertz_damping"):
        carom.WallLaw(sphere="copper", surface="glass", normal="ea", hertz_damping="7 kg")
    with pytest.raises(TypeError, match="friction: a bool"):
        carom.WallLaw(sphere="copper", surface="glass", normal="ea", friction=True)
    with pytest.raises(ValueError, match="out of range|not finite|nan"):
        carom.WallLaw(sphere="copper", surface="glass", normal="ea", friction=float("nan"))
    with pytest.raises(ValueError, match=r"law:2:1: unknown key 'frictoin'"):
        carom.WallLaw.from_toml('normal = "ea"\nfrictoin = 0.2\n')
    with pytest.raises(ValueError, match="give friction=0.2"):
        carom.WallLaw(sphere="copper", surface="glass", normal="ea").impact(9e-5, 2, 30)


@given(st.dictionaries(st.sampled_from([*carom.law_keys(), "x"]), st.one_of(
    st.floats(), st.text(max_size=8), st.integers(), st.none(), st.lists(st.floats(), max_size=3), st.booleans(),
    st.dictionaries(st.text(max_size=4), st.floats(), max_size=2), st.binary(max_size=3),
), max_size=4))
def test_nothing_panics(keys: dict[str, object]) -> None:
    try:
        carom.WallLaw(**{"sphere": "copper", "surface": "glass", "normal": "ea", **keys})  # type: ignore[arg-type]
    except (ValueError, TypeError) as error:
        assert "--" not in str(error) and "panic" not in str(error)


def test_law_pickles_and_compares(law: carom.WallLaw) -> None:
    for other in (pickle.loads(pickle.dumps(law)), copy.deepcopy(law), carom.WallLaw.from_toml(str(law))):
        assert other == law and hash(other) == hash(law) and str(other) == str(law)
    again = eval(repr(law))
    assert again == law
    assert law != 3


def test_law_of_a_file(tmp_path: Path, copper: carom.WallLaw) -> None:
    file = tmp_path / "walls.toml"
    file.write_text(copper.to_toml("a") + copper.replace(friction=0.3).to_toml("b"))
    assert carom.WallLaw.from_file(file, "a") == copper
    assert carom.WallLaw.from_file(str(file), name="b").to_dict()["friction"] == 0.3
    with pytest.raises(ValueError, match="more than one law"):
        carom.WallLaw.from_file(file)
    with pytest.raises(FileNotFoundError):
        carom.WallLaw.from_file(tmp_path / "none.toml")


def test_repr_is_the_commands(copper: carom.WallLaw) -> None:
    out = copper.impact(90e-6, 2.0, 30.0)
    words = ["--sphere", "copper", "--surface", "glass", "--law", "ea", "--friction", "0.2", "--roughness-factor", "0.8"]
    told = command("impact", *words, "--diameter", "90um", "--speed", "2", "--angle", "30")
    assert repr(out) == told.stdout.rstrip()
    assert "It rebounds" in out._repr_html_()
    assert "C_R" in copper._repr_html_() or "roughness_factor" in copper._repr_html_()


def test_materials() -> None:
    copper = carom.materials["copper"]
    assert copper.density is not None and 8000 < copper.density < 9500
    assert all(p["source"] or p["typical"] for p in copper.properties.values())
    assert "copper" in carom.materials and "coper" not in carom.materials and len(carom.materials) == len(list(carom.materials))
    assert carom.materials.get("coper") is None
    with pytest.raises(KeyError, match="did you mean copper"):
        carom.materials["coper"]
    mine = carom.materials.with_toml('[material.mine]\ndensity = 7850\nyoung_modulus = "210 GPa"\npoisson_ratio = 0.3\nsurface_energy = 1\n')
    law = carom.WallLaw(sphere="mine", surface="glass", normal="ea", materials=mine)
    assert law.density == 7850
    back = pickle.loads(pickle.dumps(law))
    assert back == law and back.impact(1e-5, 1.0).restitution == law.impact(1e-5, 1.0).restitution
    direct = carom.WallLaw(sphere=mine["mine"], surface="glass", normal="ea")
    assert direct.impact(1e-5, 1.0).restitution == law.impact(1e-5, 1.0).restitution


def test_figures(copper: carom.WallLaw) -> None:
    assert abs(copper.capture_velocity("90um") - 0.091551) < 5e-7
    sizes = np.array([1e-6, 1e-5, 9e-5])
    many = copper.capture_velocity(sizes)
    assert many.tolist() == [copper.capture_velocity(d) for d in sizes.tolist()]
    assert abs(copper.critical_angle(9e-5, 2.0) - 36.459) < 5e-4
    assert np.isnan(copper.yield_velocity(9e-5))
    assert copper.adhesion_numbers(9e-5)["regime"] == "JKR"
    with pytest.raises(ValueError, match="diameter must lie"):
        copper.capture_velocity(-1.0)
    with pytest.raises(ValueError, match=r"row 1: the diameter"):
        copper.capture_velocity(np.array([1e-6, 2.0]))


def test_everything_is_documented() -> None:
    for name in carom.__all__:
        thing = getattr(carom, name)
        if callable(thing):
            assert thing.__doc__ and len(thing.__doc__) > 30, name
    for method in ("impact", "from_toml", "from_file", "capture_velocity", "critical_angle", "replace"):
        text = getattr(carom.WallLaw, method).__doc__
        assert "Parameters\n" in text and "Returns\n" in text, method


def test_every_key_is_taken() -> None:
    for name, about in carom.law_keys().items():
        assert about["meaning"]
        try:
            carom.WallLaw(normal="ea", sphere="copper", surface="glass").replace(**{name: about["example"]})
        except ValueError as error:
            assert "unknown key" not in str(error)
