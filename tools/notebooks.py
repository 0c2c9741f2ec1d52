"""Runs the notebooks of examples/notebooks, each in a fresh kernel; what fails in one fails here. Writes nothing.

`tools/notebooks.py FOLDER` keeps the executed ones there.
"""

import os
import sys
import time
from pathlib import Path

import nbformat
from nbclient import NotebookClient

ROOT = Path(__file__).resolve().parent.parent


def main() -> None:
    # figures are drawn into the notebook, whatever backend the environment asks for
    os.environ.pop("MPLBACKEND", None)
    keep = Path(sys.argv[1]) if len(sys.argv) > 1 else None
    for path in sorted((ROOT / "examples" / "notebooks").glob("*.ipynb")):
        start = time.monotonic()
        notebook = nbformat.read(path, as_version=4)
        NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": path.parent}}).execute()
        outputs = [out for cell in notebook.cells for out in cell.get("outputs", [])]
        figures = sum("image/png" in out.get("data", {}) for out in outputs)
        assert figures, f"{path.name}: no figure"
        print(f"{path.name}: {figures} figures, {time.monotonic() - start:.1f} s", flush=True)
        if keep:
            keep.mkdir(parents=True, exist_ok=True)
            nbformat.write(notebook, keep / path.name)


main()
