#!/usr/bin/env python3
"""Puts the explorer's page together: web/index.html with its styles, scripts, presets and the WebAssembly in it.

    tools/web-page.py KERNEL.wasm PAGE.html

Presets are the panels of carom-lab's experiments: laws, sizes, measured points and their sources as they stand in those files.
"""

import base64
import gzip
import json
import math
import pathlib
import re
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
EXPERIMENTS = ROOT / "crates/carom-lab/data/experiments"
# compressed, all together
MOST = 400_000


def text_of(value):
    """A value of a law's file as it is typed into a field."""
    if isinstance(value, list):
        return ", ".join(value)
    if isinstance(value, dict):
        short = {"density": "rho", "young_modulus": "E", "poisson_ratio": "nu", "surface_energy": "gamma", "yield_strength": "sigma"}
        return ",".join(f"{short[key]}={str(part).replace(' ', '')}" for key, part in value.items())
    return str(value)


def law(experiment, panel, name):
    fields = {key: text_of(value) for key, value in experiment["law"][name].items()}
    # as `carom validate`: friction may be left out where restitution alone is shown, and says nothing there
    if panel.get("quantity", "restitution") == "restitution" and "friction" not in fields:
        fields["friction"] = "0"
    return fields


def points(panel, speed):
    """Where a measured point lies along the panel, its value, its standard uncertainty."""
    rows = []
    for measured in panel.get("measured", []):
        for n, value in enumerate(measured["value"]):
            angles = measured.get("angle_deg")
            normal = measured.get("angle_from_normal_deg")
            angle = angles[n] if angles else 90.0 - normal[n] if normal else 90.0
            sigma = measured.get("sigma")
            sigma = sigma[n] if isinstance(sigma, list) else sigma
            along = angle if panel["over"] == "angle" else measured["speed"][n] * math.sin(math.radians(angle))
            rows.append([along, value, sigma])
    return rows


def presets():
    found = []
    for path in sorted(EXPERIMENTS.glob("*.toml")):
        experiment = tomllib.loads(path.read_text(encoding="utf-8"))
        for panel in experiment.get("panel", []):
            curves = []
            for curve in panel["curve"]:
                entry = {"label": curve["label"], "law": law(experiment, panel, curve["law"]), "diameter": curve["diameter"]}
                if "to" in curve:
                    entry["to"] = law(experiment, panel, curve["to"])
                if curve.get("dashed"):
                    entry["dashed"] = True
                curves.append(entry)
            figure = panel.get("figure", "")
            title = panel.get("title") or panel["name"]
            found.append(
                {
                    "id": f"{path.stem}.{panel['name']}",
                    "figure": figure,
                    "name": f"Fig. {figure}: {title}" if figure else title,
                    "title": title,
                    "quantity": panel.get("quantity", "restitution").replace("-", "_"),
                    "over": panel["over"],
                    "range": panel["range"],
                    "speed": panel.get("speed"),
                    "curves": curves,
                    "points": points(panel, panel.get("speed")),
                    "stated": [[s["at"], s.get("above", s.get("below")), "above" if "above" in s else "below"] for s in panel.get("stated", [])],
                    "pointsFrom": "; ".join(m["source"] for m in panel.get("measured", [])),
                    "source": experiment["source"],
                    "valuesFrom": experiment["values_from"],
                    "notes": experiment.get("notes", []),
                }
            )
    return sorted(found, key=lambda p: (int(p["figure"] or 99), p["id"]))


def smaller(name, text):
    """Without what only a reader of the source needs."""
    if name.endswith(".js"):
        text = re.sub(r"^\s*(//.*|/\*\*.*\*/)\n", "", text, flags=re.M)
        return re.sub(r"^ +", "", text.replace('"use strict";\n', ""), flags=re.M) if "`" not in text else text.replace('"use strict";\n', "")
    return re.sub(r"\n\s*", "\n", text)


def main():
    kernel, page = map(pathlib.Path, sys.argv[1:])
    packed = gzip.compress(kernel.read_bytes(), 9, mtime=0)
    parts = {
        "wasm": base64.b64encode(packed).decode(),
        # nothing in a script's data may end it
        "presets": json.dumps(presets(), ensure_ascii=False, separators=(",", ":")).replace("</", "<\\/"),
    }
    html = (ROOT / "web/index.html").read_text(encoding="utf-8")

    def part(match):
        name = match.group(1)
        return parts[name] if name in parts else smaller(name, (ROOT / "web" / name).read_text(encoding="utf-8"))

    html = re.sub(r"\{\{([\w.]+)\}\}", part, html)
    page.write_text(html, encoding="utf-8")
    size = len(gzip.compress(html.encode(), 9, mtime=0))
    print(f"{page}: {size} bytes compressed ({len(html.encode())} as it is; the kernel {len(packed)})")
    if size > MOST:
        sys.exit(f"the page has {size} bytes compressed, and may have {MOST}")


if __name__ == "__main__":
    main()
