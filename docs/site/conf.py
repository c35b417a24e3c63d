# SPDX-License-Identifier: MIT
"""The pages of the repository as a site, by Sphinx: docs/site/make.sh. They are read where they stand, as the Markdown that they are everywhere else."""
import pathlib
import re

from pygments.lexers.special import TextLexer

project = html_title = "splinefeed"
html_theme = "sphinx_rtd_theme"  # everything that its pages load lies beside them
html_extra_path = ["index.html"]
html_static_path = html_css_files = ["site.css"]
html_copy_source = html_show_sphinx = html_show_copyright = html_use_index = smartquotes = False
extensions = ["myst_parser"]
root_doc = "README"
include_patterns = ["**.md"]
exclude_patterns = ["build*", "**/node_modules", ".*"]
myst_heading_anchors = 6
# What is only MyST's stays text.
myst_disable_syntax = ["amsmath", "myst_block_break", "myst_line_comment", "myst_role", "myst_target", "substitution_inline", "substitution_block"]


def contents(pages, listed):
    """(heading, pages) of each list: those of docs/README.md in its order, then the others."""
    named = {"README"}
    for section in re.split(r"^#+ ", listed.replace("\n", "\n[](README.md)\n", 1), flags=re.M):  # itself first
        heading, _, text = section.partition("\n")
        links = ["docs/" + link for link in re.findall(r"\]\((?!\.\.)([^)#:]+)\.md\)", text)]
        found = [page for page in dict.fromkeys(links) if page in pages - named]
        yield heading, found
        named.update(found)
    yield "The project", sorted(pages - named, key=lambda page: (page.count("/"), page))


def add_contents(app, page, source):
    """Behind the first page: the lists that the side bar shows."""
    if page != root_doc:
        return
    for heading, pages in contents(app.project.docnames, pathlib.Path(app.srcdir, "docs/README.md").read_text(encoding="utf-8")):
        if pages:
            source[0] += "\n".join(["", "```{toctree}", ":hidden:", f":caption: {heading}", "", *[f"/{page}" for page in pages], "```", ""])


def setup(app):
    app.add_lexer("csv", TextLexer)
    app.connect("source-read", add_contents)
