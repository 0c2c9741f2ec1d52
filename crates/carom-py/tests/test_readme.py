"""The README's Python: it runs, and each line with a value after it gives that."""

from __future__ import annotations

import re
from typing import Any

import pytest
from conftest import ROOT

BLOCKS = re.findall(r"^```python\n(.*?)^```", (ROOT / "README.md").read_text(), re.MULTILINE | re.DOTALL)


def _holds(value: Any, told: str) -> None:
    """A number may be cut (``0.92321...``) or rounded to the digits that stand there."""
    if not re.match(r"-?\d", told):
        assert repr(value) == told
        return
    if "..." in told:
        assert repr(float(value)).startswith(told.partition("...")[0]), (value, told)
        return
    digits = len(told.partition(".")[2])
    assert round(float(value), digits) == float(told), (value, told)


def test_the_readme_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    names: dict[str, Any] = {}
    held = 0
    for block in BLOCKS:
        for line in block.splitlines():
            code, _, told = line.partition("  # ")
            if told:
                _holds(eval(code.strip(), names), told.strip())  # noqa: S307
                held += 1
            else:
                exec(code, names)  # noqa: S102
    assert held >= 10 and len(BLOCKS) >= 9
