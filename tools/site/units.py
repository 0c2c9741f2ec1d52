"""The page of units, from the tables that the reader of quantities uses (`crates/carom/src/units`)."""

import math
import pathlib
import re

UNITS = pathlib.Path(__file__).resolve().parents[2] / "crates/carom/src"
BASE = ("m", "kg", "s", "K")
SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def si(dimension: str) -> str:
    powers = [int(power) for power in re.findall(r"-?\d+", dimension)]
    return " ".join(unit + ("" if power == 1 else str(power).translate(SUPERSCRIPT)) for unit, power in zip(BASE, powers) if power)


def value(text: str) -> float:
    """A factor as the source has it: a number, or a constant over one."""
    left, _, right = text.replace("_", "").partition("/")
    known = {"core::f64::consts::PI": math.pi, "core::f64::consts::TAU": math.tau}

    def number(part: str) -> float:
        return known.get(part.strip()) or float(part)

    return number(left) / (number(right) if right else 1.0)


def page() -> str:
    quantities = (UNITS / "units.rs").read_text(encoding="utf-8")
    reader = (UNITS / "units/parse.rs").read_text(encoding="utf-8")
    kinds = re.findall(r'^    (\w+), "([^"]+)", (\[[^\]]*\]), "([^"]*)", "([^"]*)";', quantities, re.MULTILINE)
    units = re.findall(r'^    \("([^"]+)", ([^,]+), (-?\d+), (NUMBER|\[[^\]]*\]), (true|false)\),', reader, re.MULTILINE)
    prefixes = re.findall(r'^    \("([^"]+)", (-?\d+)\),', reader, re.MULTILINE)
    if len(kinds) < 20 or len(units) < 50 or len(prefixes) < 12:
        raise SystemExit(f"units.py: the reader's tables were not found ({len(kinds)}, {len(units)}, {len(prefixes)})")
    text = [
        "# Units", "",
        "Taken from the tables of the reader of quantities when this manual was built. A quantity is a text, a number and a unit: `\"90 um\"`, `\"1.2 J/m2\"`,"
        " `\"9.81 m s^-2\"`; a bare number is in SI units.", "",
        "## Kinds of quantities", "", "| kind | SI unit | example |", "|---|---|---|",
        *(f"| {what} | {unit} | `{example}` |" for _, what, _, unit, example in kinds), "",
        "## Units", "", "| unit | is | prefixes |", "|---|---|---|",
    ]
    for name, factor, power, dimension, prefixed in units:
        amount = float(f"{value(factor) * 10.0 ** int(power):.12g}")
        text.append(f"| `{name}` | {amount:.12g} {si(dimension) if dimension != 'NUMBER' else ''} | {'yes' if prefixed == 'true' else ''} |")
    text += [
        "", "Temperatures are also read in `degC` (`°C`, `C`) and `degF` (`°F`, `F`).", "", "## Prefixes", "",
        ", ".join(f"`{name}` 10{power.translate(SUPERSCRIPT)}" for name, power in prefixes) + ".", "",
    ]
    return "\n".join(text)
