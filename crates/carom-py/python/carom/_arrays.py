"""Cases that are dicts, and the arrays in them as the files that the case's text names."""

from __future__ import annotations

import io
import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from carom._carom import Case, Materials

_FLOW = ("x", "y", "z", "u", "v", "w", "k", "epsilon", "omega", "T", "rho")
_PARTICLES = ("x", "y", "z", "u", "v", "w", "diameter", "weight", "time")


@dataclass(frozen=True)
class Prepared:
    """A case's text, its name, and the files that it names and that are held in memory."""

    text: str
    name: str
    sources: tuple[tuple[str, bytes], ...] = ()

    def read(self, materials: Materials | None) -> Case:
        """The case, checked."""
        return Case.from_toml(self.text, self.name, dict(self.sources), materials)


def prepared(case: str | os.PathLike[str] | Mapping[str, Any]) -> Prepared:
    """A case file, or a dict of its tables."""
    if isinstance(case, Mapping):
        sources: dict[str, bytes] = {}
        tables = {str(name): _table(str(name), value, sources) for name, value in case.items()}
        return Prepared(_document(tables), "case.toml", tuple(sources.items()))
    path = Path(case)
    return Prepared(path.read_text(encoding="utf-8"), str(path))


def _table(name: str, value: Any, sources: dict[str, bytes]) -> Any:
    """A table of a case without arrays that only a file could hold."""
    if name == "flow" and _is_columns(_dict(name, value).get("columns")):
        value = dict(value)
        file = "columns of flow.csv"
        sources[file] = _csv(value.pop("columns"), _FLOW, "flow")
        return {**value, "file": file}
    if name in ("wall", "injection"):
        if not isinstance(value, Sequence) or isinstance(value, str):
            raise TypeError(f"{name}: a list of dicts is wanted, not {type(value).__name__}")
        of = _wall if name == "wall" else _injection
        return [of(i, _dict(f"{name} {i + 1}", one), sources) for i, one in enumerate(value)]
    return value


def _dict(name: str, value: Any) -> Mapping[str, Any]:
    if not isinstance(value, Mapping):
        raise TypeError(f"{name}: a dict is wanted, not {type(value).__name__}")
    return value


def _wall(place: int, wall: Mapping[str, Any], sources: dict[str, bytes]) -> dict[str, Any]:
    wall = dict(wall)
    if "triangles" in wall:
        file = f"triangles of wall {place + 1}.ply"
        sources[file] = _ply(*wall.pop("triangles"))
        wall["stl"] = {"file": file}
    return wall


def _injection(place: int, injection: Mapping[str, Any], sources: dict[str, bytes]) -> dict[str, Any]:
    injection = dict(injection)
    if "particles" in injection:
        file = f"particles of injection {place + 1}.csv"
        sources[file] = _csv(injection.pop("particles"), _PARTICLES, "particles")
        injection["particles"] = file
    return injection


def _is_columns(value: Any) -> bool:
    """Whether these are columns of numbers, not the names of a file's columns."""
    if value is None:
        return False
    names = list(value.columns) if hasattr(value, "columns") else list(value)
    return any(not isinstance(value[name], str) for name in names)


def _csv(columns: Any, known: tuple[str, ...], what: str) -> bytes:
    """Columns as a text whose numbers have the same bits."""
    names = [str(name) for name in (columns.columns if hasattr(columns, "columns") else columns)]
    for name in names:
        if name not in known:
            raise ValueError(f"{what}: no column '{name}'; known are {', '.join(known)}")
    arrays = [np.asarray(columns[name]) for name in names]
    for name, array in zip(names, arrays, strict=True):
        if array.dtype.kind not in "fiu":
            raise TypeError(f"{what}: column '{name}' holds {array.dtype}, not numbers")
    try:
        arrays = [np.ravel(a) for a in np.broadcast_arrays(*arrays)]
    except ValueError as error:
        raise ValueError(f"{what}: columns of one length are wanted: {error}") from None
    out = io.StringIO()
    out.write(",".join(names) + "\n")
    for row in zip(*(array.tolist() for array in arrays), strict=True):
        out.write(",".join(map(repr, row)) + "\n")
    return out.getvalue().encode()


def _ply(vertices: Any, faces: Any) -> bytes:
    """Triangles as binary PLY in doubles."""
    points = np.ascontiguousarray(vertices, dtype="<f8")
    corners = np.asarray(faces)
    if points.ndim != 2 or points.shape[1] != 3:
        raise ValueError(f"triangles: vertices of shape (n, 3) are wanted, not {points.shape}")
    if corners.ndim != 2 or corners.shape[1] != 3 or corners.dtype.kind not in "iu":
        raise ValueError(f"triangles: whole numbers of shape (n, 3) are wanted as faces, not {corners.dtype} {corners.shape}")
    if corners.size and (corners.min() < 0 or corners.max() >= len(points)):
        raise ValueError(f"triangles: a face names a vertex that is not there; there are {len(points)}")
    head = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\n"
        "property double x\nproperty double y\nproperty double z\n"
        f"element face {len(corners)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    records = np.empty(len(corners), dtype=[("n", "u1"), ("corners", "<i4", 3)])
    records["n"] = 3
    records["corners"] = corners
    return head.encode() + points.tobytes() + records.tobytes()


def _document(tables: Mapping[str, Any]) -> str:
    """TOML of a dict of tables, lists of tables and plain values."""
    plain: list[str] = []
    rest: list[str] = []
    for name, value in tables.items():
        if name == "law" and isinstance(value, Mapping):
            rest.extend(f"[law.{_key(law)}]\n" + _body(_law(keys)) for law, keys in value.items())
        elif isinstance(value, Mapping):
            rest.append(f"[{_key(name)}]\n" + _body(value))
        elif isinstance(value, (list, tuple)) and value and all(isinstance(v, Mapping) for v in value):
            rest.extend(f"[[{_key(name)}]]\n" + _body(v) for v in value)
        else:
            plain.append(f"{_key(name)} = {_value(value, name)}\n")
    return "".join(plain) + "\n".join(["", *rest])


def _law(law: Any) -> Mapping[str, Any]:
    """A law's keys, of a dict or a WallLaw."""
    found: Mapping[str, Any] = law.to_dict() if hasattr(law, "to_toml") else law
    return found


def _body(table: Mapping[str, Any]) -> str:
    return "".join(f"{_key(str(n))} = {_value(v, str(n))}\n" for n, v in table.items() if v is not None)


def _key(name: str) -> str:
    bare = name and all(c.isascii() and (c.isalnum() or c in "-_") for c in name)
    return name if bare else _text(name)


def _text(text: str) -> str:
    escaped = "".join(
        {'"': '\\"', "\\": "\\\\"}.get(c, c if c.isprintable() else f"\\u{ord(c):04X}") for c in text
    )
    return f'"{escaped}"'


def _value(value: Any, name: str) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, str):
        return _text(value)
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value)) if np.isfinite(value) else {1: "inf", -1: "-inf"}.get(int(np.sign(value) if value == value else 0), "nan")
    if hasattr(value, "magnitude") and hasattr(value, "to_base_units"):
        base = value.to_base_units()
        return _value(np.asarray(base.magnitude).tolist(), name)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(str(n))} = {_value(v, str(n))}" for n, v in value.items()) + " }"
    if isinstance(value, np.ndarray):
        return _value(value.tolist(), name)
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_value(v, name) for v in value) + "]"
    if isinstance(value, os.PathLike):
        return _text(os.fspath(value))
    raise TypeError(f"{name}: a {type(value).__name__} has no place in a case")
