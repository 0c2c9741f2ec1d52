"""Every link and picture of the built site leads somewhere, also to an anchor; no page asks a network for anything. links.py SITE"""

import html.parser
import pathlib
import sys
import urllib.parse

SITE = pathlib.Path(sys.argv[1]).resolve()


class Page(html.parser.HTMLParser):
    def __init__(self, path: pathlib.Path) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.links: list[str] = []
        self.fetched: list[str] = []
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag: str, attributes: list[tuple[str, str | None]]) -> None:
        given = dict(attributes)
        self.anchors |= {given[key] for key in ("id", "name") if given.get(key)}
        if tag == "a" and given.get("href"):
            self.links.append(given["href"])
        for key in ("src", "data", *(["href"] if tag == "link" else [])):
            if given.get(key):
                (self.fetched if "//" in given[key].split("?")[0] and not given[key].startswith("data:") else self.links).append(given[key])


def main() -> None:
    pages = {
        path: Page(path) for path in SITE.rglob("*.html")
        if "files" not in path.relative_to(SITE).parts and "_static" not in path.relative_to(SITE).parts
    }
    if len(pages) < 20:
        sys.exit(f"links.py: only {len(pages)} pages in {SITE}")
    faults, inner, outer = [], 0, 0
    for path, page in pages.items():
        own = path.relative_to(SITE)
        faults += [f"{own} fetches {address}" for address in page.fetched]
        for link in page.links:
            if urllib.parse.urlsplit(link).scheme:
                outer += 1
                continue
            inner += 1
            address, _, anchor = link.partition("#")
            goal = (path.parent / urllib.parse.unquote(address.split("?")[0])).resolve() if address else path
            if not goal.exists() or SITE not in (goal, *goal.parents):
                faults.append(f"{own}: {link} is not there")
            elif goal.is_dir():
                faults.append(f"{own}: {link} is a folder")
            # the explorer's addresses hold its state
            elif anchor and goal.name != "explorer.html" and goal in pages and urllib.parse.unquote(anchor) not in pages[goal].anchors:
                faults.append(f"{own}: {link} has no such anchor")
    print(f"{len(pages)} pages, {inner} links within them lead somewhere, {outer} lead out (not followed)")
    if faults:
        sys.exit("\n".join(["faults:", *sorted(set(faults))]))


if __name__ == "__main__":
    main()
