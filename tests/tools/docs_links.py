#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether every relative link and #anchor of the Markdown pages resolves, no page has a mark like @TIME@ left, every `docs/...`
that any file names exists, a page links to each page, the glossary is in the order of the alphabet, and the program has the messages that docs/troubleshooting.md explains."""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
FENCE = re.compile(r"^(```|~~~).*?^\1", re.MULTILINE | re.DOTALL)


def anchors_of(text):
    """The anchors that GitHub makes of the headings, and those of <a id="...">."""
    found, times = set(re.findall(r'<a id="([^"]+)">', text)), {}
    for heading in re.findall(r"^#{1,6} +(.*?) *#*$", FENCE.sub("", text), re.MULTILINE):
        plain = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").replace("*", "")
        slug = re.sub(r"[^\w\- ]", "", plain.lower()).replace(" ", "-")
        times[slug] = times.get(slug, -1) + 1
        found.add(slug if times[slug] == 0 else f"{slug}-{times[slug]}")
    return found


def bad_links(page):
    """Links of a page that lead nowhere, and marks that no figure has replaced, each with its line."""
    text = (ROOT / page).read_text()
    prose = re.sub(r"`[^`\n]*`", lambda m: " " * len(m[0]), FENCE.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), text))
    for mark in re.finditer(r"@[A-Z]+@", prose):
        yield f"{page}:{text.count(chr(10), 0, mark.start()) + 1}: {mark[0]}: nothing stands for this mark"
    for link in LINK.finditer(prose):
        if re.match(r"[a-z]+:", link[1]):
            continue
        path, _, anchor = link[1].partition("#")
        target = (ROOT / page).parent / path if path else ROOT / page
        if not target.exists():
            why = "there is no such file"
        elif anchor and anchor not in anchors_of(target.read_text()):
            why = "the page has no such heading"
        else:
            continue
        yield f"{page}:{text.count(chr(10), 0, link.start()) + 1}: {link[1]}: {why}"


def bad_names(files):
    """Files of docs/ that something names and that do not exist. CHANGELOG.md may speak of what was."""
    for name in files:
        if name == "CHANGELOG.md" or not (ROOT / name).is_file():
            continue
        try:
            text = (ROOT / name).read_text()
        except UnicodeDecodeError:
            continue
        for match in re.finditer(r"(?<![\w/.-])docs/[\w./-]*\w", text):
            if not (ROOT / match[0]).exists():
                yield f"{name}:{text.count(chr(10), 0, match.start()) + 1}: {match[0]}: there is no such file"


def unreachable(pages):
    """Pages of docs/ to which no page links."""
    linked = set()
    for page in pages:
        for link in LINK.findall((ROOT / page).read_text()):
            if not re.match(r"[a-z]+:", link):
                linked.add(((ROOT / page).parent / link.partition("#")[0]).resolve())
    return [f"{page}: no page links to it" for page in pages if page.startswith("docs/") and (ROOT / page) not in linked]


def unknown_messages(page):
    """Messages in the first column of the troubleshooting page that no source has; ... stands for what varies."""
    sources = "\n".join(p.read_text() for tree in ("host_sim", "hal", "firmware_core") for p in sorted((ROOT / tree).rglob("*.cpp")))
    said = re.sub(r'"\s*\n\s*"', "", sources).replace('\\"', '"')
    for number, line in enumerate((ROOT / page).read_text().split("\n"), 1):
        first = line.split(" | ")[0]
        for message in re.findall(r"`([^`]+ [^`]+)`", first) if line.startswith("| ") else []:
            if "command not found" in message or "=" in message:
                continue  # the shell's; a key
            for part in filter(None, (part.strip(" ;") for part in message.split("..."))):
                if part not in said:
                    yield f"{page}:{number}: no source says '{part}'"


def out_of_order(page):
    """Terms of the glossary that do not stand behind the one before in the alphabet."""
    terms = re.findall(r"^\| ([^|]+?) \|", (ROOT / page).read_text(), re.MULTILINE)[1:]
    return [f"{page}: '{term}' stands behind '{before}'" for before, term in zip(terms, terms[1:]) if term.lower() <= before.lower()]


def main():
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard"], cwd=ROOT, check=True,
                            capture_output=True, text=True).stdout.split("\n")
    files = [name for name in listed if (ROOT / name).is_file()]
    pages = [name for name in files if name.endswith(".md")]
    bad = [line for page in pages for line in bad_links(page)] + list(bad_names(files)) + unreachable(pages)
    bad += unknown_messages("docs/troubleshooting.md")
    bad += out_of_order("docs/reference/glossary.md")
    print("\n".join(bad) if bad else f"{len(pages)} pages: all links resolve")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
