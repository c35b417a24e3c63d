# SPDX-License-Identifier: MIT
"""The hints of the module: mypy --strict accepts the package, the example programs and the blocks of
the pages, and nothing that is wrong. With ./check --long the stub is compared with the extension."""
import os
import pathlib
import subprocess
import sys
import tempfile

import splinefeed
from pages import docs_blocks, PAGES, ROOT

#: (a program, what mypy says of it): hints that accept everything would accept these.
WRONG = (("splinefeed.plan([[0, 0], [1, 1]]).time.real.foo", 'has no attribute "foo"'),
         ("splinefeed.plan([[0, 0], [1, 1]], machine='mill.toml')", 'Argument "machine" to "plan" has incompatible type "str"'),
         ("splinefeed.plan(None)", 'Argument 1 to "plan" has incompatible type "None"'),
         ("splinefeed.Machine('xy', max_feed_mm_s='fast', max_velocity_mm_s=1, max_acceleration_mm_s2=1)", 'Argument "max_feed_mm_s" to "Machine" has'),
         ("splinefeed.Machine.default().limits['max_feed']", 'TypedDict "Limits" has no key "max_feed"'),
         ("splinefeed.Curve([[0, 0], [1, 1]]).bezier.shape", 'has no attribute "shape"'),
         ("splinefeed.Stream().push([1, 2], corner='yes')", 'Argument "corner" to "push" of "Stream" has incompatible type "str"'),
         ("splinefeed.plan_gcode(['G1 X1'])", 'Argument 1 to "plan_gcode" has incompatible type'))

#: What pybind11 makes of each class: a metaclass, and an __init__ that refuses.
OF_PYBIND = r"""splinefeed\._native\.(Input|Machine|Motion|Stream)
splinefeed\._native\.(Machine|Motion)\.__init__
"""


def said_by(*command):
    """(exit status, output) of a checker."""
    package = pathlib.Path(splinefeed.__file__).parent.parent
    done = subprocess.run([sys.executable, "-m", *command], cwd=ROOT, env={**os.environ, "MYPYPATH": str(package)}, capture_output=True, text=True,
                          check=False)
    return done.returncode, done.stdout + done.stderr


def main():
    if subprocess.run([sys.executable, "-m", "mypy", "--version"], capture_output=True, check=False).returncode != 0:
        print("SKIPPED: there is no mypy (Debian: apt-get install mypy)")
        return 77
    bad = []
    with tempfile.TemporaryDirectory() as folder:
        programs = []
        for page in PAGES:
            programs.append(pathlib.Path(folder) / (page.replace("/", "_").removesuffix(".md") + ".py"))
            blocks = [block.text for block in docs_blocks.blocks_of((ROOT / page).read_text()) if block.language == "python"]
            programs[-1].write_text("\n".join(blocks))
        wrong = pathlib.Path(folder) / "wrong.py"
        wrong.write_text("import splinefeed\n" + "".join(f"{line}\n" for line, _ in WRONG))
        examples = sorted((ROOT / "examples/python").glob("*.py"))
        status, said = said_by("mypy", "--strict", "python/splinefeed", *map(str, (*examples, *programs, wrong)))
        problems = [line for line in said.splitlines()[:-1] if ": note: " not in line]
        for number, (line, sentence) in enumerate(WRONG, 2):
            of_line = [one for one in problems if f"wrong.py:{number}: error" in one]
            bad += [] if any(sentence in one for one in of_line) else [f"mypy accepts {line}"]
            problems = [one for one in problems if one not in of_line]
        bad += problems
        if status != 1:
            bad.append(said)
        if os.environ.get("SPLINEFEED_LONG") == "1":
            allowed = pathlib.Path(folder) / "allowed"
            allowed.write_text(OF_PYBIND)
            status, said = said_by("mypy.stubtest", "splinefeed._native", "--mypy-config-file", "pyproject.toml", "--allowlist", str(allowed))
            bad += [said] if status else []
    print("\n".join(bad))
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
