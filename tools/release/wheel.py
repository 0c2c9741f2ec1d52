"""Puts licence files into a wheel: wheel.py WHEEL FOLDER FILE[:NAME]... writes the wheel anew into FOLDER."""

import base64
import hashlib
import pathlib
import sys
import zipfile

source, folder, *files = sys.argv[1:]
source = pathlib.Path(source)


def line(name: str, data: bytes) -> str:
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(data)}\n"


with zipfile.ZipFile(source) as old, zipfile.ZipFile(pathlib.Path(folder) / source.name, "w", zipfile.ZIP_DEFLATED) as new:
    record = next(name for name in old.namelist() if name.endswith(".dist-info/RECORD"))
    home = record.removesuffix("RECORD") + "licenses/"
    lines = old.read(record).decode()
    for info in old.infolist():
        if info.filename != record and not info.filename.startswith(home):
            new.writestr(info, old.read(info))
    lines = "".join(kept + "\n" for kept in lines.splitlines() if not kept.startswith(home))
    for file in files:
        path, _, name = file.partition(":")
        path = pathlib.Path(path)
        data = path.read_bytes()
        new.writestr(home + (name or path.name), data)
        lines = line(home + (name or path.name), data) + lines
    new.writestr(record, lines)
