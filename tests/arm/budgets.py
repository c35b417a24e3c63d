#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The budget of a microcontroller: what the proofs of this folder and of tests/firmware measured, against docs/reference/budgets.md.

budgets.py BUILD           compares: what is more than 3 % worse than on the page fails, and so does a figure that is missing
budgets.py BUILD --write   runs the proofs (ctest in BUILD), and writes the page anew

A proof leaves lines "NAME VALUE" in BUILD/budgets/PROOF-CPU.txt. Less is better in all of them. A row of budgets.md.in reads
"| label | = PROOF NAME | target |"; the page has the processors' figures in place of the second cell, and is the template otherwise.
"""
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
TEMPLATE = pathlib.Path(__file__).with_suffix(".md.in")
PAGE = ROOT / "docs/reference/budgets.md"
PROCESSORS = {"cortex-m0": "Cortex-M0", "cortex-m3": "Cortex-M3", "cortex-m4f": "Cortex-M4F"}
ROW = re.compile(r"\| ([^|]+) \| = (\w+) ([^|]+) \| ([^|]*)\|$")
WORSE = 0.03
SKIPPED = 77


def compiler():
    """The version of the compiler, of which most figures depend."""
    for program in ("arm-none-eabi-g++", "qemu-system-arm"):
        if not shutil.which(program):
            print(f"SKIPPED: {program} is not installed")
            sys.exit(SKIPPED)
    return subprocess.run(["arm-none-eabi-g++", "-dumpfullversion"], check=True, capture_output=True, text=True).stdout.strip()


def measured_in(folder):
    """{(proof, processor, name): value} of every proof; None: it could not be measured here."""
    figures = {}
    for path in sorted(folder.glob("*.txt")):
        proof, cpu = path.stem.split("-", 1)
        for line in path.read_text().splitlines():
            name, value = line.rsplit(" ", 1)
            figures[proof, cpu, name] = None if value == "skipped" else int(value)
    return figures


def with_target(values, target):
    """The cell of a target, "M4F / M0", or one for the M4F alone: is it reached?"""
    bounds = [int(number.replace(",", "")) for number in target.split(" / ") if number.strip()]
    reached = [value <= bound for value, bound in zip((values["cortex-m4f"], values["cortex-m0"]), bounds) if value is not None]
    verdict = "reached" if all(reached) else "**missed** on one" if any(reached) else "**missed**"
    return f"{target.strip()}: {verdict}" if reached else target.strip()


def row(found, figures):
    """A row of the page, with the figures that there are."""
    label, proof, name, target = found.groups()
    values = {cpu: figures.get((proof, cpu, name)) for cpu in PROCESSORS}
    cells = [label] + ["" if value is None else f"{value:,}" for value in values.values()] + [with_target(values, target)]
    return re.sub(" +", " ", "| " + " | ".join(cells) + " |")


def written(figures, version):
    """The page."""
    lines = []
    for line in TEMPLATE.read_text().replace("COMPILER", version).splitlines():
        found = ROW.match(line)
        lines.append(row(found, figures) if found else line)
    return "\n".join(lines) + "\n"


def committed_in(page):
    """The budget: {(proof, processor, name): (value, label)}, and the version of the compiler. Fails where the page is not the
    template but for its figures."""
    lines, template = page.splitlines(), TEMPLATE.read_text().splitlines()
    budget, version = {}, re.search(r"arm-none-eabi-g\+\+ ([0-9.]+[0-9])", page)
    for number, (line, wanted) in enumerate(zip(lines, template), 1):
        found = ROW.match(wanted)
        if not found and version and line == wanted.replace("COMPILER", version[1]):
            continue
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if not found or len(cells) != len(PROCESSORS) + 2 or cells[0] != found[1]:
            sys.exit(f"{PAGE.relative_to(ROOT)}:{number}: is not what tests/arm/budgets.md.in has there: write the page anew")
        for cpu, cell in zip(PROCESSORS, cells[1:]):
            if cell:
                budget[found[2], cpu, found[3]] = int(cell.replace(",", "")), found[1]
    if len(lines) != len(template) or not version:
        sys.exit(f"{PAGE.relative_to(ROOT)}: {len(lines)} lines, tests/arm/budgets.md.in has {len(template)}: write the page anew")
    return budget, version[1]


def wanted_rows():
    """{(proof, name)} that the page is to have."""
    return {(found[2], found[3]) for found in map(ROW.match, TEMPLATE.read_text().splitlines()) if found}


def compare(figures, budget):
    """What is wrong, in words; prints what is better."""
    wrong, better, skipped = [], 0, 0
    for (proof, cpu, name), (allowed, label) in budget.items():
        value = figures.get((proof, cpu, name), "nothing")
        where = f"{label}, {PROCESSORS[cpu]} ({proof} {name})"
        if value is None:
            skipped += 1
        elif value == "nothing":
            wrong.append(f"{where}: not measured, {allowed:,} on the page")
        elif value > allowed * (1 + WORSE):
            wrong.append(f"{where}: {value:,} measured, {allowed:,} on the page: {100 * value / allowed - 100 if allowed else 100:.1f} % worse")
        elif value < allowed * (1 - WORSE):
            print(f"better: {where}: {value:,} measured, {allowed:,} on the page: write the page anew")
            better += 1
    rows = wanted_rows()
    wrong += [f"{proof} {name} of {cpu}: {value:,} measured, not on the page" for (proof, cpu, name), value in figures.items()
              if (proof, name) in rows and (proof, cpu, name) not in budget and value is not None]
    print(f"{len(budget)} figures: {len(wrong)} wrong, {better} better" + (f", {skipped} cannot be measured here" if skipped else ""))
    return wrong


def measure(build):
    """Runs the proofs, whose figures fall into BUILD/budgets. What cannot be measured here would be missing on the page."""
    subprocess.run(["ctest", "--test-dir", build, "--output-on-failure", "-R", "^(arm|firmware)_", "-E", "^arm_budgets$|_NOT_BUILT$"], check=True)
    figures = measured_in(build / "budgets")
    missing = [f"{proof} {name}" for proof, name in sorted(wanted_rows())
               if not any(figures.get((proof, cpu, name)) is not None for cpu in PROCESSORS)]
    missing += [" ".join(key) for key, value in figures.items() if value is None]
    if missing:
        sys.exit("not measured: " + ", ".join(missing))
    return figures


def main():
    if len(sys.argv) not in (2, 3) or sys.argv[2:] not in ([], ["--write"]):
        sys.exit(__doc__)
    build = pathlib.Path(sys.argv[1]).resolve()
    version = compiler()
    if sys.argv[2:]:
        PAGE.write_text(written(measure(build), version))
        print(f"{PAGE.relative_to(ROOT)}: written")
        return 0
    budget, of_version = committed_in(PAGE.read_text())
    if version != of_version:
        print(f"SKIPPED: the budget is that of arm-none-eabi-g++ {of_version}, this one is {version}")
        return SKIPPED
    wrong = compare(measured_in(build / "budgets"), budget)
    for line in wrong:
        print(line)
    if wrong:
        print(f"If that is meant: tests/arm/budgets.py {sys.argv[1]} --write, and say why in the commit")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
