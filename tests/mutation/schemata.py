# SPDX-License-Identifier: MIT
"""Schemata: sources in which every chosen operator and constant can be changed at run time, one at a time (mutants.hpp).

Which ones are chosen depends on a seed and on the text of their lines alone: a change elsewhere in a file chooses no others."""
import hashlib
import re

OPERATORS = {"<": "Less", "<=": "LessEqual", ">": "Greater", ">=": "GreaterEqual", "==": "Equal", "!=": "Unequal",
             "+": "Plus", "-": "Minus", "*": "Times", "/": "Over"}
SITE = re.compile(r"(?P<operator>(?<= )(?:<=|>=|==|!=|<|>|\+|-|\*|/)(?= ))"
                  r"|std::(?P<extreme>min|max)\((?!\{)"
                  r"|(?<![\w.:\"'\[])(?P<number>\d+(?:\.\d+)?(?:e-?\d+)?(?:U|L|LL|ULL)?)(?![\w.'\"])")
# Lines whose numbers and operators are no computation of the program's
LEFT_OUT = re.compile(r"^\s*(//|#|template|using|namespace|case |friend|static_assert|inline constexpr|constexpr|static constexpr)"
                      r"|assert\(|ASSERT\(|operator|requires|__|std::array<|snprintf|\bconst char")

ARGUMENT = re.compile(r"<(?:[^ ]*, )*$|literal<[\w<>]+>\([^()]*$")  # of a template, or of a function that computes while compiling


class Site:
    """One place that can be changed: of a file, in this line (from 0) at this column."""

    def __init__(self, file, line, match, text):
        self.file, self.line, self.start, self.end = file, line, match.start(), match.end()
        self.kind, self.found = match.lastgroup, match.group(match.lastgroup)
        self.text = f"{text[:self.start]}[{text[self.start:self.end]}]{text[self.end:]}".strip()

    @property
    def name(self):
        """As survivors.txt has it."""
        return f"{self.file}: {self.text}"

    def order(self, seed):
        return hashlib.sha256(f"{seed} {self.name}".encode()).digest()

    def replacement(self, number):
        if self.kind == "operator":
            return f"{self.found} mutation::{OPERATORS[self.found]}{{{number}}} {self.found}"
        if self.kind == "extreme":
            return f"mutation::{'least' if self.found == 'min' else 'most'}({number}, "
        return f"mutation::number({number}, {self.found})"


def sites(file, source):
    """Of the text of a file; what is said twice in the same words counts once."""
    found = {}
    for at, text in enumerate(source.splitlines()):
        code = text.split(" // ")[0]
        if LEFT_OUT.search(code) or '"' in code:
            continue
        for match in SITE.finditer(code):
            if match.lastgroup == "number" and ARGUMENT.search(code[:match.start()]):
                continue
            site = Site(file, at, match, code)
            found.setdefault(site.name, site)
    return list(found.values())


def chosen(all_sites, seed, count):
    return sorted(all_sites, key=lambda site: site.order(seed))[:count]


def rewritten(source, numbered):
    """The source with these (number, site) in it."""
    lines = source.splitlines()
    for number, site in sorted(numbered, key=lambda pair: -pair[1].start):
        line = lines[site.line]
        lines[site.line] = line[:site.start] + site.replacement(number) + line[site.end:]
    return '#include "mutants.hpp"\n#line 1\n' + "\n".join(lines) + "\n"
