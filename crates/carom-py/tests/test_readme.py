"""The Python of the README and of guides: it runs, and each line with a value after it gives that."""

from __future__ import annotations

import re
from typing import Any

import pytest
from conftest import ROOT

PAGES = [("README.md", 10), ("docs/fit.md", 2), ("docs/which-law.md", 3)]


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


@pytest.mark.parametrize(("page", "values"), PAGES)
def test_its_python_runs(page: str, values: int, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ROOT)
    blocks = re.findall(r"^```python\n(.*?)^```", (ROOT / page).read_text(), re.MULTILINE | re.DOTALL)
    names: dict[str, Any] = {}
    held = 0
    for line in "".join(blocks).splitlines():
        code, _, told = line.partition("  # ")
        if told:
            _holds(eval(code.strip(), names), told.strip())  # noqa: S307
            held += 1
        else:
            exec(code, names)  # noqa: S102
    assert held >= values


def test_the_case_files_of_the_examples_are_there() -> None:
    """Their runs take from seconds to many minutes: only the paths are looked at."""
    pages = sorted((ROOT / "docs/examples").glob("*.md"))
    named = [name for page in pages for name in re.findall(r'carom\.run\("(.*?)"', page.read_text())]
    assert len(named) >= 12
    assert all((ROOT / name).is_file() for name in named), named
