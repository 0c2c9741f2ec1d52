"""Holds pages against what they speak of: sources.py CAROM. Equations against the files and tests they name, tables of columns against the writers,
keys of the case file against its reader, the paper's table against `carom validate`."""

import csv
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
CAROM = pathlib.Path(sys.argv[1]).resolve()
faults: list[str] = []


def fault(text: str) -> None:
    faults.append(text)


def text(path: str) -> str:
    return (ROOT / path).read_text(encoding="utf-8")


def says(*arguments: str) -> str:
    return subprocess.run([CAROM, *arguments], cwd=ROOT, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True).stdout


def equations() -> int:
    """Each section of docs/theory.md with an equation names what computes it and what holds it, and both are there."""
    count = 0
    for section in re.split(r"^### ", text("docs/theory.md"), flags=re.MULTILINE)[1:]:
        title = section.splitlines()[0]
        section = re.split(r"^## ", section, flags=re.MULTILINE)[0]
        if "$$" not in section:
            fault(f"theory.md, {title}: no equation")
        count += section.count("$$") // 2
        said = re.search(r"\*Computed by\* (.*?)\. \*Held by\* (.*?)\.$", section, re.MULTILINE)
        if not said:
            fault(f"theory.md, {title}: does not name what computes it and what holds it")
            continue
        if "Source" not in section and title not in ("Given tangential restitution",):
            fault(f"theory.md, {title}: no source")
        for _, path in re.findall(r"\[`([^`]+)`\]\(\.\./([^)]+)\)", said[1]):
            if not (ROOT / path).is_file():
                fault(f"theory.md, {title}: {path} is not there")
        tests = re.findall(r"\[`([^`]+)`\]\(\.\./([^)]+)\)", said[2])
        if not tests:
            fault(f"theory.md, {title}: no test")
        for name, path in tests:
            if not (ROOT / path).is_file() or not re.search(rf"\bfn {name}\(", text(path)):
                fault(f"theory.md, {title}: there is no test {name} in {path}")
    return count


def described() -> dict[str, list[tuple[str, str]]]:
    tables = {}
    for section in re.split(r"^## ", text("docs/columns.md"), flags=re.MULTILINE)[1:]:
        rows = re.findall(r"^\| `([^`]+)` \| ([^|]*)\|", section, re.MULTILINE)
        tables[section.splitlines()[0].strip()] = [(name, unit.strip()) for name, unit in rows]
    return tables


def columns() -> int:
    """The tables of docs/columns.md are those of the writers."""
    tables = described()
    layouts = re.findall(r'stem: "(\w+)",\s*columns: &\[(.*?)\n        \]', text("crates/carom-track/src/tables.rs"), re.DOTALL)
    if len(layouts) < 4:
        fault("tables.rs: its layouts were not found")
    written = {stem: re.findall(r'\("(\w+)", "([^"]*)", ', rows) for stem, rows in layouts}

    def header(path: pathlib.Path) -> list[tuple[str, str]]:
        names = next(csv.reader(path.open(encoding="utf-8")))
        return [(re.sub(r" \(.*\)$", "", name), (re.findall(r"\((.*)\)$", name) or [""])[0]) for name in names]

    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        says("run", "examples/wind-tunnel.toml", "--out", str(folder / "run"))
        for stem in ("impacts", "fates", "trajectories"):
            if [name for name, _ in header(folder / f"run/{stem}.csv")] != [name for name, _ in written[stem]]:
                fault(f"{stem}.csv has other columns than tables.rs")
        # units of this table stand in no header
        units = dict(tables.get("deposition", []))
        written["deposition"] = [(name, units.get(name, "")) for name, _ in header(folder / "run/deposition.csv")]
        pair = ("--sphere", "copper", "--surface", "glass")
        says("sweep", *pair, "--diameter", "90um", "--over", "speed=1..2m/s", "--points", "2", "--out", str(folder / "sweep.csv"))
        says("capture", *pair, "--over", "diameter=1um..9um", "--points", "2", "--out", str(folder / "capture.csv"))
        says("impact", *pair, "--diameter", "90um", "--speed", "1", "--law", "resolved", "--history", str(folder / "history.csv"))
        for table in ("sweep", "capture", "history"):
            written[table] = header(folder / f"{table}.csv")
    for table, want in written.items():
        if tables.get(table) != want:
            lines = [f"  {a} in columns.md, {b} written" for a, b in zip(tables.get(table, []), want) if a != b]
            fault(f"columns.md, {table}: not what is written ({len(tables.get(table, []))} columns, {len(want)} written)\n" + "\n".join(lines))
    return sum(map(len, written.values()))


def case_keys() -> int:
    """Every key that the case file's reader knows stands on its page."""
    page, reader = text("docs/case-file.md"), text("crates/carom-track/src/case/text.rs")
    keys = re.findall(r'(?:rename = "(\w+)"\)\]\s*)?pub (\w+): ', reader)
    keys = sorted({renamed or name for renamed, name in keys})
    words = set(re.findall(r"\w+", " ".join(re.findall(r"`[^`]+`|```.*?```", page, re.DOTALL))))
    for key in keys:
        if key not in words:
            fault(f"case-file.md does not name the key {key}")
    return len(keys)


def paper() -> int:
    """Deviations in the paper's table are those that `carom validate` prints."""
    said, printed = text("paper/paper.md"), says("validate")
    want = {
        "micro-slip |": r"kharaz-2001 .*micro-slip .* ([\d.]+)$",
        "rigid rolling": r"kharaz-2001 .*rolling .* ([\d.]+)$",
        "closed form with damping": r"damped, 0.1 to 25 m/s .* ([\d.]+)$",
        "EAP, 5 mm": r"gorham-kharaz-2000 .*EAP .* ([\d.]+)$",
    }
    for row, pattern in want.items():
        found = re.search(pattern, printed, re.MULTILINE)
        line = next((line for line in said.splitlines() if line.startswith("|") and row in line), "")
        number = re.search(r"\| ([\d.]+) \|$", line)
        if not found or not number:
            fault(f"paper.md: the row '{row}' or its number in `carom validate` was not found")
        elif float(number[1]) != round(float(found[1]), len(number[1].partition(".")[2])):
            fault(f"paper.md, '{row}': {number[1]}, but `carom validate` says {found[1]}")
    cited = set(re.findall(r"@([a-z]+\d{4})", said))
    listed = set(re.findall(r"^@\w+\{(\w+),", text("paper/paper.bib"), re.MULTILINE))
    for key in sorted(cited ^ listed):
        fault(f"paper: {key} is cited and not listed, or listed and not cited")
    return len(want)


def main() -> None:
    print(
        f"{equations()} equations have their files and tests; {columns()} columns are the writers'; {case_keys()} keys of case files are described;"
        f" {paper()} numbers of the paper are those of carom validate"
    )
    if faults:
        sys.exit("\n".join(["faults:", *faults]))


if __name__ == "__main__":
    main()
