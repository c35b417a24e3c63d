#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""All of firmware_core in one header: single_header.py FILE.

The declarations come first. The definitions follow in `#ifdef SPLINEFEED_IMPLEMENTATION`, which one source of a program defines. Names
that several sources of the core have in anonymous namespaces get the name of their source, because all of them are compiled as one here.
"""
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CORE = ROOT / "firmware_core"
OWN = re.compile(r'^ *# *include "(splinefeed/[^"]+)".*\n', re.MULTILINE)
STANDARD = re.compile(r"^ *# *include (<[^>]+>).*\n", re.MULTILINE)
DROPPED = re.compile(r"^(// SPDX-License-Identifier: .*|#pragma once)\n", re.MULTILINE)
NO_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)
KEYWORDS = {"const", "constexpr", "noexcept", "inline", "static", "struct", "class", "enum", "union", "override", "final"}


def blank(text):
    """The text with spaces for comments and literals, so that places stay."""
    return NO_CODE.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)


def declared(head):
    """The name that a declaration declares, from its text up to its body or its value; that of a function with "()"."""
    head = re.sub(r"\[\[.*?\]\]", " ", head)
    while (inner := re.sub(r"^\s*template\s*<[^<>]*>|<[^<>]*>", " ", head)) != head:
        head = inner
    if alias := re.match(r"\s*using\s+(\w+)\s*=", head):
        return alias[1]
    if re.match(r"\s*(using|static_assert|extern|#|template)\b", head) or "operator" in head:
        return None
    if kind := re.match(r"\s*(?:struct|enum class|enum struct|class|enum|concept)\s+(\w+)", head):
        return kind[1]
    until, opened, _ = re.match(r"([^(={\[]*)(.?)(.*)", head, re.DOTALL).groups()
    words = [word for word in re.findall(r"[A-Za-z_]\w*", until) if word not in KEYWORDS]
    return words[-1] + ("()" if opened == "(" else "") if words else None


def hidden_names(text):
    """The names of the anonymous namespaces of a source."""
    code, names = re.sub(r"^ *#(?:[^\n]*\\\n)*[^\n]*", lambda m: re.sub(r"[^\n]", " ", m[0]), blank(text), flags=re.MULTILINE), set()
    for opened in re.finditer(r"\bnamespace\s*\{", code):
        depth, start, place = 0, opened.end(), opened.end()
        while depth >= 0:
            letter = code[place]
            if letter == "{" and depth == 0 or letter == ";" and depth == 0 and start < place:
                names.add(declared(code[start:place]))
            depth += {"{": 1, "}": -1}.get(letter, 0)
            if letter == ";" and depth == 0:
                start = place + 1
            # The end of a function's body: no semicolon follows. That of a struct or of a value has one.
            if letter == "}" and depth == 0 and not re.match(r"\s*[;,]", code[place + 1:]):
                start = place + 1
            place += 1
    return names - {None}


def renamed(text, names, stem):
    """The text with other names; members, qualified names, comments and literals stay."""
    if not names:
        return text
    pattern = re.compile(r"(?<![\w.])(?<!->)(?<!::)(" + "|".join(sorted(names)) + r")\b")
    code, out, at = blank(text), [], 0
    for found in pattern.finditer(code):
        out += [text[at:found.start()], f"{found[1]}_of_{stem}"]
        at = found.end()
    return "".join(out) + text[at:]


def headers():
    """All headers, each after those that it includes."""
    order, seen = [], set()

    def visit(name):
        if name not in seen:
            seen.add(name)
            for other in OWN.findall((CORE / name).read_text()):
                visit(other)
            order.append(name)

    for path in sorted(CORE.glob("splinefeed/**/*.hpp")):
        visit(str(path.relative_to(CORE)))
    return order


def body(text):
    return STANDARD.sub("", OWN.sub("", DROPPED.sub("", text))).strip("\n")


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: single_header.py FILE")
    declarations = [(name, (CORE / name).read_text()) for name in headers()]
    sources = [(str(path.relative_to(CORE)), path.read_text()) for path in sorted(CORE.glob("splinefeed/**/*.cpp"))]
    hidden = {name: hidden_names(text) for name, text in sources}
    times = collections.Counter(word.removesuffix("()") for names in hidden.values() for word in names)
    # What a header or another source means by that word is not to be hidden, either.
    words = collections.defaultdict(set)
    for name, text in declarations + sources:
        for word in re.findall(r"\w+", blank(text)):
            words[word].add(name)
    definitions = []
    for name, text in sources:
        # A function may be an overload of what a header declares.
        clashes = {word.removesuffix("()") for word in hidden[name]
                   if times[word.removesuffix("()")] > 1 or (words[word] != {name} and not word.endswith("()"))}
        definitions.append((name, renamed(body(text), clashes, pathlib.Path(name).stem)))
    standard = sorted({found for _, text in declarations + sources for found in STANDARD.findall(text)})
    version = re.search(r"VERSION (\d+\.\d+\.\d+)", (ROOT / "CMakeLists.txt").read_text())[1]
    licence = "".join(f"// {line}".rstrip() + "\n" for line in (ROOT / "LICENSE").read_text().splitlines())

    def section(name, text):
        return f"// ---- {name}\n\n{text}\n"

    pathlib.Path(sys.argv[1]).write_text(
        "// SPDX-License-Identifier: MIT\n"
        f"// splinefeed {version}: all of firmware_core in one header, made by cmake/packaging/single_header.py. Define\n"
        "// SPLINEFEED_IMPLEMENTATION in one source before it is included. Compile with -std=c++20 -ffp-contract=off.\n//\n"
        + licence + "#pragma once\n\n" + "".join(f"#include {name}\n" for name in standard) + "\n"
        + "\n".join(section(name, body(text)) for name, text in declarations)
        + "\n#ifdef SPLINEFEED_IMPLEMENTATION\n\n" + "\n".join(section(*part) for part in definitions)
        + "\n#endif // SPLINEFEED_IMPLEMENTATION\n")


if __name__ == "__main__":
    main()
