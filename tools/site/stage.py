"""Lays out the manual for Sphinx: the pages of docs, the texts at the root and of the plug-ins as they stand, and what the programs print.

    stage.py CAROM FOLDER [EXPLORER]

Nothing is written twice: a page is a file of the repository. Links between pages lead to pages, links to other files of the repository to a
copy of them. Tables on the pages "what the programs say" are printed by CAROM, the command, while the manual is built.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys

import units

ROOT = pathlib.Path(__file__).resolve().parents[2]

# cases that run within seconds: what they come to is printed below the page that is about them
COMPUTED = {
    "docs/examples/wind-tunnel.md": "examples/wind-tunnel.toml",
    "docs/examples/two-walls.md": "examples/two-walls.toml",
    "docs/examples/diffusion-in-a-pipe.md": "examples/settling-plates.toml",
    "docs/examples/pipe-deposition.md": "examples/pipe.toml",
    "docs/examples/sampling-line.md": "examples/sampling-line.toml",
}

# where each file of the repository stands in the manual, by chapter
CHAPTERS = {
    "Getting started": {
        "README.md": "tour",
        "docs/python.md": "python",
        "plugins/openfoam/README.md": "openfoam",
        "docs/c.md": "c",
        "plugins/fluent/README.md": "fluent",
        "plugins/code_saturne/README.md": "code-saturne",
        "": "browser",
    },
    "Laws of the wall": {
        "docs/which-law.md": "which-law",
        "docs/wall-law.md": "wall-law",
        "docs/theory.md": "theory",
        "docs/materials.md": "materials",
        "docs/uncertainty.md": "uncertainty",
        "docs/fit.md": "fit",
        "docs/export.md": "export",
    },
    "Particles in flows": {
        "docs/case-file.md": "case-file",
        "docs/cfd-results.md": "cfd-results",
        "docs/columns.md": "columns",
        "units": "units",
    },
    "Studies": {
        "docs/examples/wind-tunnel.md": "examples/wind-tunnel",
        "docs/examples/two-walls.md": "examples/two-walls",
        "docs/examples/impactor.md": "examples/impactor",
        "docs/examples/pipe-deposition.md": "examples/pipe-deposition",
        "docs/examples/duct.md": "examples/duct",
        "docs/examples/diffusion-in-a-pipe.md": "examples/diffusion-in-a-pipe",
        "docs/examples/sampling-line.md": "examples/sampling-line",
        "docs/examples/pitz-daily.md": "examples/pitz-daily",
        "docs/examples/bend-90.md": "examples/bend-90",
        "docs/examples/round-impactor.md": "examples/round-impactor",
        "docs/examples/chamber.md": "examples/chamber",
    },
    "How far to trust it": {
        "docs/validation.md": "validation",
        "docs/benchmarks.md": "benchmarks",
        "docs/faq.md": "faq",
    },
    "What the programs say": {"command": "command", "library": "library", "validated": "validated"},
    "Reference": {
        "docs/glossary.md": "glossary",
        "CONTRIBUTING.md": "contributing",
        "ARCHITECTURE.md": "architecture",
        "CHANGELOG.md": "changelog",
        "SECURITY.md": "security",
        "THIRD-PARTY.md": "third-party",
    },
}
# where the title of a file would say too little among others
NAMES = {"tour": "The tour <tour>", "c": "C, C++, Fortran <c>", "python": "Python <python>", "openfoam": "OpenFOAM <openfoam>", "fluent": "Fluent <fluent>", "code-saturne": "code_saturne <code-saturne>"}
PAGES = {file: page for chapter in CHAPTERS.values() for file, page in chapter.items() if "." in file}
# a link or picture, or code, in which nothing is one
LINK = re.compile(r"(!?\[(?:[^\[\]]|\[[^\]]*\])*\])\(([^()\s]+(?:\([^()]*\)[^()\s]*)*)\)|`[^`]+`")
PICTURES = {".svg", ".png", ".jpg"}
# the text of a file is shown by browsers, whatever its own ending
SHOWN = ".txt"


def as_rows(printed: str) -> list[str]:
    """A table as the command prints it, columns under a line of dashes, as a table of the page; what follows it stays as it is."""
    lines = printed.rstrip().splitlines()
    rule = next(index for index, line in enumerate(lines) if re.fullmatch(r"[- ]+", line))
    spans = [match.span() for match in re.finditer("-+", lines[rule])]
    end = next((index for index in range(rule, len(lines)) if not lines[index].strip()), len(lines))

    def row(line: str) -> str:
        ends = [start for start, _ in spans[1:]] + [None]
        return "| " + " | ".join(line[start:stop].strip() for (start, _), stop in zip(spans, ends)) + " |"

    rows = [row(line) for line in lines[rule - 1 : rule]] + ["|" + "---|" * len(spans)] + [row(line) for line in lines[rule + 1 : end]]
    return rows + [""] + [re.sub(r"(?<=:)$", "\n", line) for line in lines[end + 1 :]]


class Stage:
    def __init__(self, carom: pathlib.Path, folder: pathlib.Path, explorer: pathlib.Path | None) -> None:
        self.carom, self.folder, self.explorer = carom, folder, explorer
        self.files = folder.parent / "files"

    def says(self, *arguments: str) -> str:
        run = subprocess.run([self.carom, *arguments], capture_output=True, text=True, cwd=ROOT, env={"COLUMNS": "120", "NO_COLOR": "1"})
        if run.returncode:
            sys.exit(f"stage.py: carom {' '.join(arguments)} failed:\n{run.stderr}")
        return run.stdout

    def write(self, page: str, text: str) -> None:
        path = self.folder / f"{page}.md"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def link(self, source: pathlib.Path, page: str, label: str, target: str) -> str:
        """A link as it is in the manual."""
        if re.match(r"[a-z]+:|#", target):
            return f"{label}({target})"
        path, _, anchor = target.partition("#")
        goal = (source.parent / path).resolve()
        if not goal.exists():
            sys.exit(f"stage.py: {source.relative_to(ROOT)} leads to {target}, which is not there")
        name = goal.relative_to(ROOT).as_posix()
        if goal.name == "README.md" and name not in PAGES and goal.parent == ROOT / "docs":
            return f"{label}({'../' * page.count('/')}index.md)"
        if goal.is_dir():
            name = f"{name}/README.md" if f"{name}/README.md" in PAGES else name
        if name in PAGES:
            return f"{label}({'../' * page.count('/')}{PAGES[name]}.md{'#' + anchor if anchor else ''})"
        if goal.is_dir():
            return label.removeprefix("[").removesuffix("]") if not label.startswith("[`") else label[1:-1]
        if goal.suffix in PICTURES and label.startswith("!"):
            copy = self.folder / pathlib.Path(name).relative_to("docs")
            copy.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(goal, copy)
            return f"{label}({'../' * page.count('/')}{copy.relative_to(self.folder).as_posix()})"
        copy = self.files / f"{name}{SHOWN}"
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(goal, copy)
        return f"{label}(source{page.count('/')}:{name}{SHOWN})"

    def page(self, file: str, page: str) -> None:
        """A file of the repository as a page, its links led to where things are; code is left as it is."""
        source = ROOT / file
        parts = re.split(r"(^[ \t]*```.*?^[ \t]*```[ \t]*$)", source.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)
        for index in range(0, len(parts), 2):
            parts[index] = LINK.sub(lambda m: self.link(source, page, m[1], m[2]) if m[1] else m[0], parts[index])
        self.write(page, "".join(parts) + self.ending(file))

    def ending(self, file: str) -> str:
        """Below a page with numbers that no program printed today: when they were last written, and what its case comes to now."""
        if not (file.startswith("docs/examples/") or file == "docs/benchmarks.md"):
            return ""
        text = ""
        if file in COMPUTED:
            case = COMPUTED[file]
            text += f"\n\n## Computed when this manual was built\n\n```text\n$ carom run {case}\n{self.says('run', case).rstrip()}\n```\n"
        git = subprocess.run(["git", "log", "-1", "--format=%cs", "--", file], capture_output=True, text=True, cwd=ROOT)
        date = f", last on {git.stdout.strip()}" if git.returncode == 0 and git.stdout.strip() else ""
        what = "measured, on the machine that is named with them" if file == "docs/benchmarks.md" else "computed or measured, by the commands that are named with them"
        which = "other numbers" if file in COMPUTED else "numbers"
        return f"{text}\n\n*The {which} of this page were {what}, when it was written{date}, not when this manual was built.*\n"

    def index(self) -> None:
        text = [
            "# carom", "", "What happens when a small particle hits a wall: does it stick or bounce, and how does it leave?", "",
            "![Restitution against speed](images/restitution.svg)", "",
            "[The tour](tour.md) goes from the first command to particles in a flow. [Which law](which-law.md) helps to choose;"
            " [validation](validation.md) says how far to trust the answer. In a browser, without installing anything: [the explorer](browser.md).", "",
        ]
        for chapter, pages in CHAPTERS.items():
            text += ["```{toctree}", f":caption: {chapter}", ":maxdepth: 1", "", *(NAMES.get(page, page) for page in pages.values()), "```", ""]
        text += [
            "**Where the numbers come from.** Flags, materials, units, the comparison with experiments and the explorer were computed or printed when this copy was"
            " built. Keys of laws and losses are written from their registry, and a test holds them. Command lines with their output, on"
            " the tour and the pages about laws, fits, exports and CFD results, are run by tests. Columns, keys of case files and what the equations name are"
            " checked while the manual is built. Studies whose case runs within seconds end with what it came to now;"
            " their other numbers, and benchmarks, were measured when their pages were written, with the date at their end.", "",
        ]
        self.write("index", "\n".join(text))
        images = self.folder / "images"
        images.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / "docs/images/restitution.svg", images)

    def style(self) -> None:
        """Settings, style and the font of the mathematics, with its licence: of the crate that draws the plots' letters."""
        here, static = pathlib.Path(__file__).parent, self.folder / "_static"
        static.mkdir()
        shutil.copy(here / "conf.py", self.folder)
        shutil.copy(here / "manual.css", static)
        known = json.loads(subprocess.run(["cargo", "metadata", "--format-version", "1", "--locked"], stdout=subprocess.PIPE, check=True, cwd=ROOT).stdout)
        crate = next(pathlib.Path(package["manifest_path"]).parent for package in known["packages"] if package["name"] == "dejavu")
        shutil.copy(next(crate.rglob("DejaVuMathTeXGyre.ttf")), static)
        shutil.copy(next(crate.rglob("dejavu-fonts*/LICENSE")), static / "DejaVuMathTeXGyre-LICENSE.txt")

    def command(self) -> None:
        """Every subcommand with its help."""
        help_text = self.says("--help")
        names = re.findall(r"^  ([a-z]+)  ", help_text.split("Commands:")[1].split("\n\n")[0], re.MULTILINE)
        text = ["# Every command and flag", "", "Printed by the command (`carom COMMAND --help`) when this manual was built.", "", "```text", help_text.rstrip(), "```"]
        for name in names:
            if name != "help":
                text += ["", f"## carom {name}", "", "```text", self.says(name, "--help").rstrip(), "```"]
        self.write("command", "\n".join(text) + "\n")

    def library(self) -> None:
        """The materials, each value with its source."""
        known = json.loads(self.says("materials", "--json"))
        known = list(known.values()) if isinstance(known, dict) else known
        text = [
            "# The library of materials", "", "Printed by `carom materials` when this manual was built; what the fields mean: [Materials](materials.md).", "",
            *as_rows(self.says("materials")),
        ]
        for material in known:
            name = material["name"]
            text += ["", f"## {name}", "", "```text", self.says("materials", name).rstrip(), "```"]
        self.write("library", "\n".join(text) + "\n")

    def validated(self) -> None:
        """What `carom validate` finds, with the pictures it draws."""
        out = self.folder.parent / "validate"
        shutil.rmtree(out, ignore_errors=True)
        table = self.says("validate", "--out", str(out))
        table = "\n".join(line for line in table.splitlines() if not line.startswith("wrote"))
        report = out / "report.html"
        text = [
            "# The models against experiments", "",
            "Computed by `carom validate` when this manual was built. What the tiers mean and what is weak: [Validation](validation.md).", "",
            *as_rows(table), "",
        ]
        if report.exists():
            self.files.mkdir(parents=True, exist_ok=True)
            shutil.copy(report, self.files / "validation-report.html")
            text += ["With every curve and the points and bounds it is held against: [the report](source0:validation-report.html).", ""]
        self.write("validated", "\n".join(text))

    def explorer_page(self) -> None:
        text = ["# The explorer", ""]
        if self.explorer and self.explorer.exists():
            shutil.copy(self.explorer, self.files.parent / "extra" / "explorer.html")
            text += [
                "One page that computes with the same kernel, compiled to WebAssembly. [Open it by itself](page0:explorer.html): it is one file and works offline.", "",
                "```{raw} html", '<iframe src="explorer.html" title="carom explorer" style="width:100%;height:85vh;border:1px solid #8884"></iframe>', "```", "",
            ]
        else:
            text += ["The explorer is a page that computes in the browser. It was not there when this copy of the manual was built.", ""]
        self.write("browser", "\n".join(text))


def main() -> None:
    carom, folder = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    explorer = pathlib.Path(sys.argv[3]).resolve() if len(sys.argv) > 3 else None
    for old in (folder, folder.parent / "files", folder.parent / "extra"):
        shutil.rmtree(old, ignore_errors=True)
        old.mkdir(parents=True)
    stage = Stage(carom, folder, explorer)
    for file, page in PAGES.items():
        stage.page(file, page)
    stage.index()
    stage.command()
    stage.library()
    stage.validated()
    stage.explorer_page()
    stage.write("units", units.page())
    stage.style()
    shutil.move(folder.parent / "files", folder.parent / "extra" / "files")
    print(f"{len(PAGES)} pages of the repository and {len(CHAPTERS['What the programs say']) + 3} made")


if __name__ == "__main__":
    main()
