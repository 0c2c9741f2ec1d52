"""The workspace's crates that may be published, each after those it needs."""

import json
import subprocess

known = json.loads(subprocess.run(["cargo", "metadata", "--format-version", "1", "--no-deps", "--locked"], stdout=subprocess.PIPE, check=True).stdout)
crates = {package["name"]: package for package in known["packages"] if package["publish"] != []}
needs = {
    name: {dependency["name"] for dependency in package["dependencies"] if dependency["name"] in crates and dependency["kind"] != "dev"}
    for name, package in crates.items()
}
while needs:
    ready = sorted(name for name, left in needs.items() if not left & needs.keys())
    if not ready:
        raise SystemExit(f"order.py: these crates need each other: {', '.join(needs)}")
    for name in ready:
        print(name)
        del needs[name]
