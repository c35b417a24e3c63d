# SPDX-License-Identifier: MIT
"""Every Python block of the pages runs, and prints what the text block behind it shows; and so do the example programs.

A page's blocks are one program. <!-- output --> before ```text: what the block before printed; ... stands for any text.
"""
import contextlib
import io
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/tools"))
import docs_blocks  # pylint: disable=wrong-import-position

PAGES = ("README.md", "docs/tutorial/python.md", "docs/how-to/sweep_with_dask.md")
WITHOUT_PICTURE = ("sweep.py",)  # sweep_test.py runs it


def problems_of(page):
    """What is wrong with a page, one text each."""
    names, printed, ran = {"__name__": "__main__"}, None, 0
    for block in docs_blocks.blocks_of((ROOT / page).read_text()):
        if block.language == "python":
            said = io.StringIO()
            with contextlib.redirect_stdout(said):
                exec(compile("\n" * block.line + block.text, page, "exec"), names)  # pylint: disable=exec-used
            printed, ran = said.getvalue(), ran + 1
        elif block.language == "sh":
            printed = None
        elif block.output and printed is not None and not docs_blocks.pattern_of(block.output, []).search(printed):
            yield f"{page}:{block.line}: the block before it printed something else:\n{printed}"
    if not ran:
        yield f"{page}: it has no Python block"


def main():
    try:
        import matplotlib  # pylint: disable=import-outside-toplevel,unused-import
    except ImportError:
        print("SKIPPED: there is no matplotlib (Debian: apt-get install python3-matplotlib)")
        return 77
    bad = []
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for page in PAGES:
            bad += problems_of(page)
        for example in sorted((ROOT / "examples/python").glob("*.py")):
            if example.name in WITHOUT_PICTURE:
                continue
            done = subprocess.run([sys.executable, example, f"{example.stem}.png"], capture_output=True, text=True, check=False)
            print(f"{example.name}:\n{done.stdout}")
            if done.returncode != 0 or not pathlib.Path(f"{example.stem}.png").exists():
                bad.append(f"{example.name}: {done.stderr or 'it drew nothing'}")
    print("\n".join(bad))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
