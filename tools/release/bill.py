"""What a binary of carom is made of: its bill of materials (CycloneDX) and the licences that go with it.

    bill.py --manifest Cargo.toml --package carom-cli --name carom --sbom OUT.cdx.json --licences OUT.txt

Counted is what cargo links for this machine: normal dependencies with the features that are on, without procedural macros and build
scripts, and Rust's standard library. Texts are those that each package ships; a package that ships none gets the text of a licence that
it names, and is said to. A licence that nobody has looked at (`ACCEPTED`) is an error.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys

# licences under which a binary may be passed on with their texts beside it
ACCEPTED = {
    "0BSD", "Apache-2.0", "Apache-2.0 WITH LLVM-exception", "BSD-2-Clause", "BSD-3-Clause", "BSL-1.0", "Bitstream-Vera", "CC0-1.0", "ISC", "MIT",
    "MIT-0", "Unicode-3.0", "Unicode-DFS-2016", "Unlicense", "Zlib", "WTFPL",
}
# what the manifest does not say as SPDX, and where it was read
READ_BY_HAND: dict[str, str] = {}
TEXTS = re.compile(r"^(licen[cs]e|copying|notice|unlicense|copyright|ofl)([-._].*)?$", re.IGNORECASE)
ROOT = pathlib.Path(__file__).resolve().parents[2]


def cargo(*arguments: str, manifest: pathlib.Path) -> str:
    run = subprocess.run(
        ["cargo", *arguments, "--manifest-path", str(manifest), "--locked"], stdout=subprocess.PIPE, text=True, check=False, cwd=ROOT
    )
    if run.returncode:
        sys.exit(f"bill.py: cargo {' '.join(arguments)} failed")
    return run.stdout


def linked(manifest: pathlib.Path, package: str) -> list[tuple[str, str]]:
    """Names and versions of what is linked into `package`, itself included."""
    tree = cargo(
        "tree", "-p", package, "-e", "normal,no-proc-macro", "--prefix", "none", "--no-dedupe", "--format", "{p}", manifest=manifest
    )
    found = {tuple(line.split()[:2]) for line in tree.splitlines() if line.strip()}
    return sorted((name, version.removeprefix("v")) for name, version in found)


def packages(manifest: pathlib.Path, package: str) -> list[dict]:
    known = json.loads(cargo("metadata", "--format-version", "1", manifest=manifest))
    by_name = {(p["name"], p["version"]): p for p in known["packages"]}
    return [by_name[key] for key in linked(manifest, package)]


def choices(expression: str) -> list[set[str]]:
    """An SPDX expression as a list of sets: one set of licences is to be kept."""
    words = re.findall(r"\(|\)|[^\s()]+(?:\s+WITH\s+[^\s()]+)?", expression.replace("/", " OR "))

    def either() -> list[set[str]]:
        ways = both()
        while words and words[0] == "OR":
            words.pop(0)
            ways = ways + both()
        return ways

    def both() -> list[set[str]]:
        ways = one()
        while words and words[0] == "AND":
            words.pop(0)
            ways = [a | b for a in ways for b in one()]
        return ways

    def one() -> list[set[str]]:
        word = words.pop(0)
        if word == "(":
            ways = either()
            words.pop(0)
            return ways
        return [{" ".join(word.split())}]

    return either()


def licence(package: dict) -> str:
    expression = READ_BY_HAND.get(package["name"]) or package["license"]
    if not expression:
        sys.exit(f"bill.py: {package['name']} {package['version']} names no licence: read it and put it into READ_BY_HAND")
    if not any(way <= ACCEPTED for way in choices(expression)):
        sys.exit(f"bill.py: {package['name']} {package['version']} is {expression}, which is not among the licences accepted here")
    return expression


def texts(package: dict) -> list[tuple[str, str]]:
    """The licence files of a package, also those of what it embeds."""
    folder = pathlib.Path(package["manifest_path"]).parent
    named = {folder / package["license_file"]} if package["license_file"] else set()
    found = sorted(
        path for path in folder.rglob("*")
        if path.is_file() and (TEXTS.match(path.name) or path in named) and path.suffix not in {".rs", ".toml", ".html"}
        and not {"target", "tests", "benches"} & set(path.relative_to(folder).parts)
    )
    return [(str(path.relative_to(folder)), path.read_text(encoding="utf-8", errors="replace").strip()) for path in found]


def ours(package: dict) -> bool:
    return package["source"] is None


def standard_library(compiler: str) -> tuple[str, str, str]:
    """Version and licence of the compiler's standard library, and the text that Rust ships for it (the toolchain's at hand)."""
    rustc = subprocess.run([compiler, "-vV"], capture_output=True, text=True, check=True, cwd=ROOT).stdout
    version = re.search(r"^release: (.*)$", rustc, re.MULTILINE).group(1)
    root = pathlib.Path(subprocess.run(["rustc", "--print", "sysroot"], capture_output=True, text=True, check=True, cwd=ROOT).stdout.strip())
    page = next((p for p in (root / "share/doc").rglob("COPYRIGHT-library.html")), None)
    if page is None:
        sys.exit("bill.py: COPYRIGHT-library.html of Rust's standard library is not in this toolchain's share/doc")
    body = re.sub(r"(?is)<(style|script|head)\b.*?</\1>", "", page.read_text(encoding="utf-8"))
    body = re.sub(r"(?i)</?(p|h\d|li|summary|details|pre|br|div)\b[^>]*>", "\n", body)
    body = re.sub(r"<[^>]+>", "", body)
    for entity, sign in (("&lt;", "<"), ("&gt;", ">"), ("&quot;", '"'), ("&#39;", "'"), ("&amp;", "&"), ("&copy;", "©")):
        body = body.replace(entity, sign)
    return version, "MIT OR Apache-2.0", re.sub(r"\n\s*\n+", "\n\n", body).strip()


def write_licences(path: pathlib.Path, name: str, version: str, parts: list[dict], compiler: str) -> None:
    shared: dict[str, list[str]] = {}
    without, lines = [], []
    for part in parts:
        label = f"{part['name']} {part['version']}"
        lines.append(f"{label:<36} {licence(part)}")
        if ours(part):
            continue
        found = texts(part)
        if not found:
            without.append(part)
        for file, text in found:
            shared.setdefault(text, []).append(f"{label} ({file})")
    std, std_licence, std_text = standard_library(compiler)
    out = [
        f"Licences of what {name} {version} contains", "",
        "carom itself is MIT OR Apache-2.0 (LICENSE-MIT, LICENSE-APACHE). It is linked with:", "",
        *lines, f"{'Rust standard library ' + std:<36} {std_licence}", "",
    ]
    if without:
        out += ["These ship no licence text; under the licences they name they are used as MIT or, where that is not offered, as named:", ""]
        for part in without:
            out.append(f"  {part['name']} {part['version']}: {licence(part)}, by {', '.join(part['authors']) or 'its authors'}, {part['repository'] or ''}")
        mit = (ROOT / "LICENSE-MIT").read_text(encoding="utf-8")
        shared.setdefault(mit[mit.index("Permission"):].strip(), []).extend(f"{p['name']} {p['version']} (by name)" for p in without)
    for text, users in shared.items():
        out += ["", "=" * 100, *(f"  {user}" for user in users), "-" * 100, "", text, ""]
    out += ["", "=" * 100, f"  Rust standard library {std}", "-" * 100, "", std_text, ""]
    path.write_text("\n".join(out), encoding="utf-8")


def write_sbom(path: pathlib.Path, name: str, version: str, parts: list[dict], compiler: str) -> None:
    from cyclonedx.contrib.license.factories import LicenseFactory
    from cyclonedx.model import ExternalReference, ExternalReferenceType, HashAlgorithm, HashType, XsUri
    from cyclonedx.model.bom import Bom
    from cyclonedx.model.component import Component, ComponentType
    from cyclonedx.output.json import JsonV1Dot6
    from cyclonedx.schema import SchemaVersion
    from cyclonedx.validation.json import JsonStrictValidator
    from packageurl import PackageURL

    licences = LicenseFactory()
    sums = checksums(parts)

    def component(part: dict) -> Component:
        made = Component(
            type=ComponentType.LIBRARY, name=part["name"], version=part["version"], bom_ref=f"{part['name']}@{part['version']}",
            description=part["description"], purl=PackageURL("cargo", None, part["name"], part["version"]),
            licenses=[licences.make_with_expression(licence(part).replace("/", " OR "))],
        )
        if part["repository"]:
            made.external_references.add(ExternalReference(type=ExternalReferenceType.VCS, url=XsUri(part["repository"])))
        if digest := sums.get((part["name"], part["version"])):
            made.hashes.add(HashType(alg=HashAlgorithm.SHA_256, content=digest))
        return made

    bom = Bom()
    bom.metadata.component = Component(
        type=ComponentType.APPLICATION, name=name, version=version, bom_ref="root", licenses=[licences.make_with_expression("MIT OR Apache-2.0")]
    )
    made = {(part["name"], part["version"]): component(part) for part in parts}
    std, std_licence, _ = standard_library(compiler)
    library = Component(
        type=ComponentType.LIBRARY, name="rust-std", version=std, bom_ref=f"rust-std@{std}", licenses=[licences.make_with_expression(std_licence)]
    )
    bom.components.update([*made.values(), library])
    bom.register_dependency(bom.metadata.component, [*made.values(), library])
    text = JsonV1Dot6(bom).output_as_string(indent=1)
    if wrong := JsonStrictValidator(SchemaVersion.V1_6).validate_str(text):
        sys.exit(f"bill.py: the bill of materials is not CycloneDX 1.6: {wrong}")
    path.write_text(text + "\n", encoding="utf-8")


def checksums(parts: list[dict]) -> dict[tuple[str, str], str]:
    """SHA-256 of each package's archive, as the lock files have it."""
    found = {}
    for lock in (ROOT / "Cargo.lock", ROOT / "crates/carom-py/Cargo.lock"):
        for block in lock.read_text(encoding="utf-8").split("[[package]]"):
            fields = dict(re.findall(r'^(name|version|checksum) = "(.*)"$', block, re.MULTILINE))
            if "checksum" in fields:
                found[fields["name"], fields["version"]] = fields["checksum"]
    return found


def main() -> None:
    ask = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    ask.add_argument("--manifest", type=pathlib.Path, default=ROOT / "Cargo.toml")
    ask.add_argument("--package", required=True)
    ask.add_argument("--name", required=True)
    ask.add_argument("--sbom", type=pathlib.Path)
    ask.add_argument("--licences", type=pathlib.Path)
    ask.add_argument("--rustc", default="rustc", help="whose standard library is linked")
    wanted = ask.parse_args()
    parts = packages(wanted.manifest, wanted.package)
    version = next(p["version"] for p in parts if p["name"] == wanted.package)
    if wanted.licences:
        write_licences(wanted.licences, wanted.name, version, parts, wanted.rustc)
    if wanted.sbom:
        write_sbom(wanted.sbom, wanted.name, version, parts, wanted.rustc)
    print(f"{wanted.name} {version}: {len(parts)} packages, {sum(map(ours, parts))} of them carom's, and Rust's standard library")


if __name__ == "__main__":
    main()
