#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The site of docs/site: made without a warning, each link of each page alive, nothing loaded from elsewhere, and its search finds pages without a
server: docs_site.py BUILD_DIRECTORY. The site is then in BUILD_DIRECTORY/site."""
import html.parser
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse

ROOT = pathlib.Path(__file__).resolve().parents[2]
NEEDED = ("sphinx-build", "chromium")
SOUGHT = {"override": "reference/controller", "homing": "reference/gpio"}  # a word, and a page that the search has to name


class Page(html.parser.HTMLParser):
    """What a page links to and what it loads, and the places that others may link to."""

    def __init__(self, text):
        super().__init__()
        self.links, self.loads, self.anchors = [], [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.anchors.update(value for name, value in attributes if name == "id" or (tag, name) == ("a", "name"))
        if tag == "a":
            self.links.append(values.get("href") or "")
        else:
            self.loads += [value for name, value in attributes if value and name in ("src", "href", "srcset", "data")]
            self.loads += loaded_by_style(values.get("style") or "")


def loaded_by_style(text):
    """What a style sheet loads; data: lies within it."""
    return [url for url in re.findall(r"(?:url\(|@import\s+(?!url))\s*[\"']?([^\"')\s;]+)", text) if not url.startswith(("data:", "#"))]


def bad_places(site, file, places, pages):
    """Those places of a file of the site that are elsewhere or nowhere."""
    for place in places:
        address = urllib.parse.urlsplit(place)
        if address.scheme or address.netloc:
            yield f"{file.relative_to(site)}: {place}: is not in the site"
            continue
        target = (file.parent / urllib.parse.unquote(address.path)).resolve() if address.path else file
        if not target.is_file():
            yield f"{file.relative_to(site)}: {place}: there is no such file"
        elif address.fragment and target in pages and urllib.parse.unquote(address.fragment) not in pages[target].anchors:
            yield f"{file.relative_to(site)}: {place}: the page has no such heading"


def bad_files(site):
    pages = {file: Page(file.read_text()) for file in sorted(site.rglob("*.html"))}
    for file, page in pages.items():
        yield from bad_places(site, file, [link for link in page.links if not link.startswith(("http:", "https:", "mailto:"))], pages)
        yield from bad_places(site, file, page.loads, pages)
    for sheet in sorted(site.rglob("*.css")):
        yield from bad_places(site, sheet, loaded_by_style(sheet.read_text()), pages)


def not_found(site):
    """Words whose page the search does not name, in a browser that has files alone."""
    for word, page in SOUGHT.items():
        shown = subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=20000", "--dump-dom",
                                f"file://{site}/search.html?q={word}"], capture_output=True, text=True, timeout=300).stdout
        if not re.search(rf'<a [^>]*href="docs/{page}.html[?#"]', shown[shown.find('id="search-results"'):]):
            yield f"search.html?q={word}: does not name {page}"


def main():
    missing = [program for program in NEEDED if not shutil.which(program)]
    if missing:
        print(f"SKIPPED: {missing[0]} is not installed")
        return 77
    site = pathlib.Path(sys.argv[1]).resolve() / "site"
    shutil.rmtree(site, ignore_errors=True)
    made = subprocess.run([ROOT / "docs/site/make.sh", site], capture_output=True, text=True)
    bad = [made.stdout + made.stderr] if made.returncode else [*bad_files(site), *not_found(site)]
    print("\n".join(bad) if bad else made.stdout.strip())
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
