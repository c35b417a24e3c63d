#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Whether a source that is compiled together with others has a name for itself that a header has, too.

CMake joins sources of a target (UNITY_BUILD). What one of them declares in an unnamed namespace, or static, is then known in those
behind it, and hides a name of an enclosing namespace, or joins its overloads: they silently get another meaning. Two such names of two
sources are the compiler's to find.
"""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TREES = ("firmware_core", "hal", "host_sim")  # each includes headers of itself and of those before it

TOKEN = re.compile(r'[A-Za-z_]\w*|::|->|\d[\w.\']*|\S')
STRING = re.compile(r'R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![0-9a-fA-F])\'(?:\\.|[^\'\\\n])+\'', re.DOTALL)
NOT_A_NAME = {"noexcept", "requires", "decltype", "alignas", "static_assert", "operator", "explicit", "sizeof", "if", "const", "final"}


def tokens_of(text):
    """(token, line), without comments, texts and preprocessor lines."""
    def lines(match):
        return "\n" * match[0].count("\n")
    text = re.sub(r'/\*.*?\*/', lines, STRING.sub(lambda m: '""' + lines(m), re.sub(r'//[^\n]*', "", text)), flags=re.DOTALL)
    text = re.sub(r'^[ \t]*#(?:[^\n]*\\\n)*[^\n]*', lines, text, flags=re.MULTILINE)
    return [(m[0], text.count("\n", 0, m.start()) + 1) for m in TOKEN.finditer(text)]


def skip(tokens, at, opening, closing):
    """Behind the bracket that closes the one at `at`."""
    depth = 0
    while at < len(tokens):
        depth += (tokens[at][0] == opening) - (tokens[at][0] == closing)
        at += 1
        if depth == 0:
            break
    return at


def name_of(head):
    """What a declaration up to its first '(', '{', '=' or ';' declares, or None."""
    words = [word for word, _ in head]
    while words and words[0] == "template":
        depth, at = 0, 1
        while at < len(words):
            depth += (words[at] == "<") - (words[at] == ">")
            at += 1
            if depth == 0:
                break
        words = words[at:]
    while words[:2] == ["[", "["]:
        words = words[words.index("]") + 2:]
    words = [word for word in words if word not in ("inline", "extern", "constinit", "friend")]
    if not words or words[0] in ("namespace", "static_assert") or words[:2] == ["using", "namespace"] or "operator" in words:
        return None
    if words[0] in ("struct", "class", "union", "enum"):
        names = [word for word in words[1:] if word not in ("class", "struct")]
        return names[0] if names and (len(names) == 1 or names[1] in (":", "final", "<")) else (names[-1] if names else None)
    while words and words[-1] == "]":  # an array
        words = words[:len(words) - 1 - words[::-1].index("[")]
    if len(words) < 2 or not re.fullmatch(r'[A-Za-z_]\w*', words[-1]) or words[-1] in NOT_A_NAME:
        return None
    return None if words[-2] == "::" and words[0] != "using" else words[-1]


def names_of(text):
    """(name, line, whether it is its source's own) of all that a file with that text declares at namespace scope."""
    tokens = tokens_of(text)
    out = []
    unnamed = []  # whether each open namespace is, from the outermost
    inner = []  # whether it is a `detail`, which nobody else looks into
    at = 0
    while at < len(tokens):
        if tokens[at][0] == "}":
            unnamed, inner = unnamed[:-1], inner[:-1]
            at += 1
            continue
        head = []
        angle = 0
        while at < len(tokens) and not (tokens[at][0] in ("(", "{", "=", ";", "}") and angle == 0):
            word = tokens[at][0]
            if word == "<" and head and re.fullmatch(r'\w+', head[-1][0]):
                angle += 1
            angle -= word == ">" and angle > 0
            head.append(tokens[at])
            at += 1
        if at == len(tokens):
            break
        words = [word for word, _ in head]
        end = tokens[at][0]
        if "namespace" in words and "using" not in words and end == "{":
            unnamed.append(words[-1] == "namespace")
            inner.append("detail" in words)
            at += 1
            continue
        if words == ["extern"] and end == "{":  # extern "C"
            unnamed.append(False)
            inner.append(False)
            at += 1
            continue
        name = None if any(inner) or (words[0] == "using" and end == ";") else name_of(head)  # `using a::b;` is that b
        if name:
            own = any(unnamed) or ("static" in words and "::" not in words[-2:])
            out.append((name, head[-1][1], own))
        if words[:1] == ["enum"] and "class" not in words and end == "{":
            body = tokens[at + 1:skip(tokens, at, "{", "}") - 1]
            for k, (word, line) in enumerate(body):
                if re.fullmatch(r'[A-Za-z_]\w*', word) and (k == 0 or body[k - 1][0] == ","):
                    out.append((word, line, any(unnamed)))
        # To the end of the declaration: its ';', or the '}' of a function's body.
        call = False
        while at < len(tokens) and tokens[at][0] not in (";", "}"):
            if tokens[at][0] == "(":
                at = skip(tokens, at, "(", ")")
                call = True
            elif tokens[at][0] == "{":
                at = skip(tokens, at, "{", "}")
                if call and at < len(tokens) and tokens[at][0] not in (";", ",", "{"):
                    break
            else:
                call = call and tokens[at][0] != "="
                at += 1
        if at < len(tokens) and tokens[at][0] == ";":
            at += 1
    return out


# What has to be found in a source, so that this test does not grow blind: its own names, and those that all know.
SAMPLE = """
#define hidden(x) struct x {
namespace a { struct Known; enum class Kind { first }; enum { plain, listed = 2 };
template <class T, int n = (1 > 0)> concept Fit = requires(T t) { t.x(); };
namespace { // struct comment
constexpr std::array<std::pair<int, int>, 2> table{{{1, 2}, {3, 4}}}; const char* const text = "struct Text {";
using Places = std::vector<int>; using b::Same; class Helper final : Base { int member; void method() {} };
[[nodiscard]] std::map<int, std::string> build(int argument) noexcept { int local = 0; return {}; }
template <class T> T own_template(T t) { return t; } int before[2] = {1, 2}; auto lambda = [](int x) { return x; };
}
namespace detail { struct Unreachable; }
static int old_style(); int shared(int x) { if (x) { return 1; } return 2; } Known::Known(int x) : member(x), other{x} {} Known Known::get() const { return *this; }
bool operator==(Known, Known); template <> struct Known<int> { int y; };
}
"""
OWN = {"table", "text", "Places", "Helper", "build", "own_template", "before", "lambda", "old_style"}
COMMON = {"Known", "Kind", "plain", "listed", "Fit", "shared"}


def main():
    if sys.argv[1:2] == ["--names"]:  # what is found in a file, for whoever doubts it
        for name, line, own in names_of(pathlib.Path(sys.argv[2]).read_text()):
            print(f"{sys.argv[2]}:{line}: {name}{' (its own)' if own else ''}")
        return 0
    found = names_of(SAMPLE)
    if {name for name, _, own in found if own} != OWN or {name for name, _, own in found if not own} != COMMON:
        sys.exit(f"this test misreads its sample: {found}")
    known = {}
    for place, tree in enumerate(TREES):
        for header in sorted((ROOT / tree).rglob("*.hpp")):
            for name, line, _ in names_of(header.read_text()):
                known.setdefault(name, (place, f"{header.relative_to(ROOT)}:{line}"))
    if len(known) < 500:
        sys.exit(f"only {len(known)} names were found in all headers: this test does not read them any more")
    problems = []
    owned = 0
    for place, tree in enumerate(TREES):
        for path in sorted((ROOT / tree).rglob("*.cpp")):
            source = path.relative_to(ROOT)
            for name, line, own in names_of(path.read_text()):
                owned += own
                if own and known.get(name, (place + 1,))[0] <= place:
                    problems.append(f"{source}:{line}: its own {name} hides that of {known[name][1]} in sources joined to it; rename it")
    print("\n".join(problems) if problems else f"none of {owned} names of joined sources is one of a header's {len(known)}")
    return 1 if problems or owned < 100 else 0


if __name__ == "__main__":
    sys.exit(main())
