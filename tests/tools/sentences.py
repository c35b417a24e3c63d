#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether a sentence has more than 30 words: in the Markdown pages, in comments of public headers, in what the command says.

sentences.py [--all] [PATH...]: the sentences that are too long, each with its place; --all: every sentence with its length.

A sentence ends at . ! ? or at the end of its paragraph, list item, table cell or @tag; in a message, which is one line, at ; too. A word has a letter or a digit: a formula of signs
counts by its names. Inline code is one word, a link its text, a placeholder {} one word. Code blocks and drawings are left out.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
MOST = 30
PAGES = ("*.md", "docs/**/*.md", "bench/**/*.md", "examples/**/*.md")
HEADERS = ("firmware_core/splinefeed/**/*.hpp", "hal/splinefeed/**/*.hpp")
SAYING = ("host_sim/**/*.?pp", "python/native/*.?pp")
ITEM = re.compile(r"^\s*(?:[-*]|\d+\.|@\w+)\s+|^\s*(?=(?:Throws|Returns) )")
END = re.compile(r"(?<=[.!?])[\"')*_]*\s+(?![a-z]*\.)|(?<=[.!?][\"')*_])\s+|(?<=[.!?]\*\*)\s+")
NO_END = re.compile(r"\b(?:e\.g|i\.e|etc|vs|Fig|No|approx)\.$")


def sentences(paragraph):
    """The sentences of a text without line breaks."""
    start = 0
    for end in END.finditer(paragraph):
        if not NO_END.search(paragraph[start:end.start()]):
            yield paragraph[start:end.start()]
            start = end.end()
    yield paragraph[start:]


def words(sentence):
    return sum(1 for word in sentence.split() if re.search(r"\w", word) or "{" in word)


def joined(lines):
    """[(line, paragraph)] of numbered lines: empty ones and items divide; texts that are one paragraph are joined by a space."""
    found, start, held = [], 0, []
    for number, line in [*lines, (0, "")]:
        if held and (not line.strip() or ITEM.match(line)):
            found.append((start, " ".join(" ".join(held).split())))
            held = []
        if line.strip():
            start = start if held else number
            held.append(ITEM.sub("", line) if not held else line)
    return found


def of_page(text):
    """[(line, paragraph)] of Markdown: prose, items, headings and cells; code is one word."""
    text = re.sub(r"^( *)(```|~~~).*?^ *\2[^\n]*$|<!--.*?-->", lambda m: re.sub(r"[^\n]", "", m[0]), text, flags=re.M | re.S)
    text = re.sub(r"(`+)(?!`)[^`]*\1", lambda m: "CODE" + "\n" * m[0].count("\n"), text)
    text = re.sub(r"!?\[([^\]]*)\]\(([^)\s]*)\)", r"\1", text)
    lines = []
    for number, line in enumerate(text.split("\n"), 1):
        line = re.sub(r"<[^>]*>", "", line)
        if line.lstrip().startswith("|"):
            for cell in re.split(r"(?<!\\)\|", line.strip().strip("|")):
                lines += [(number, cell), (number, "")]
        elif line.startswith("#"):
            lines += [(number, ""), (number, line.lstrip("# ")), (number, "")]
        else:
            lines.append((number, line))
    return joined(lines)


def of_header(text):
    """[(line, paragraph)] of the comments of a C++ source; what is indented, and continues no item, is a drawing or a formula."""
    lines, before, in_item = [], None, False
    for number, line in enumerate(text.split("\n"), 1):
        comment = re.match(r'^((?:[^"/]|"(?:[^"\\]|\\.)*"|/(?!/))*)//([/!]?<?)(.*)$', line)
        if not comment or "SPDX" in line or "NOLINT" in line or "clang-format" in line:
            lines.append((number, ""))
            before = None
            continue
        alone, said = not comment[1].strip(), re.sub(r"`[^`]*`", "CODE", comment[3])
        if before is not None and not (alone and (before == "alone" or "<" in comment[2] or len(comment[1]) > 8)):
            lines.append((number, ""))
        indented = alone and bool(re.match(r" {3,}\S", said))
        in_item = bool(ITEM.match(said)) or (in_item and indented)
        lines.append((number, "" if indented and not in_item and len(comment[1]) <= 8 else said))
        before = "alone" if alone else "beside"
    return joined(lines)


def of_source(text):
    """[(line, paragraph)] of the string literals of a C++ source; neighbours are one literal, as for the compiler."""
    found = []
    literal = r'R"\((?:.|\n)*?\)"|"(?:[^"\\\n]|\\.)*"'
    for match in re.finditer(rf"//[^\n]*|'(?:[^'\\\n]|\\.)'|^\s*#\s*include[^\n]*|(?:{literal})(?:\s*(?://[^\n]*\n\s*)*(?:{literal}))*", text, re.M):
        if not match[0].startswith(("R", '"')):
            continue
        parts = re.findall(literal, match[0])
        said = "".join(p[3:-2] if p.startswith("R") else p[1:-1].replace("\\n", "\n").replace('\\"', '"') for p in parts)
        line = text.count("\n", 0, match.start()) + 1
        for paragraph in re.split(r"\n|; ", said):
            found.append((line, " ".join(re.sub(r"\{[^}]*\}", "{}", re.sub(r"`[^`]*`", "CODE", paragraph)).split())))
    return found


def too_long(paragraphs, most=MOST):
    for line, paragraph in paragraphs:
        for sentence in sentences(paragraph):
            if words(sentence) > most:
                yield line, words(sentence), sentence


def self_test():
    """Whether samples are counted as they should be."""
    page = "# A b\n\nOne `two three` [four five](six.md). Seven - eight\nnine e.g. ten.\n\n- a b\n  c\n- d\n\n| x y | z |\n|---|---|\n\n```sh\nq r s\n```\n"
    counted = [words(s) for _, p in of_page(page) for s in sentences(p)]
    if counted != [2, 4, 5, 3, 1, 2, 1, 0, 0]:
        yield f"self-test: the words of a page are {counted}"
    header = "// SPDX no\n// One two.\n//     drawing a b c\n// three\n/// @param x y\n///          z\nint a = 1; ///< four five\n           ///< six\nint b; // seven\n"
    counted = [words(s) for _, p in of_header(header) for s in sentences(p)]
    if counted != [2, 1, 3, 3, 1]:
        yield f"self-test: the words of a header are {counted}"
    source = '#include "x y z"\n f("one {} " // no\n   "two. Three", \'"\', "four {:g} \\"five\\"");\n'
    counted = [words(s) for _, p in of_source(source) for s in sentences(p)]
    if counted != [3, 1, 3]:
        yield f"self-test: the words of a source are {counted}"
    long = " ".join(["word"] * (MOST + 1))
    if [n for _, n, _ in too_long(of_page(f"{long}.\n\n- {long[5:]}\n"))] != [MOST + 1]:
        yield "self-test: a sentence that is too long is not seen"


def main():
    paths = [pathlib.Path(a).resolve() for a in sys.argv[1:] if a != "--all"]
    bad, count = list(self_test()), 0
    for patterns, reader in ((PAGES, of_page), (HEADERS, of_header), (SAYING, of_source)):
        for path in sorted({p for pattern in patterns for p in ROOT.glob(pattern)}):
            if paths and path not in paths:
                continue
            paragraphs = reader(path.read_text())
            count += sum(1 for _, p in paragraphs for s in sentences(p) if s)
            for line, length, sentence in too_long(paragraphs, -1 if "--all" in sys.argv else MOST):
                bad.append(f"{path.relative_to(ROOT)}:{line}: {length} words: {sentence}")
    print("\n".join([*bad, f"{count} sentences, {len(bad)} of more than {MOST} words"]))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
