#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The same bits on every processor: builds the corpus of this folder for each target, runs it, and compares its hashes.

equal_bits.py                       every target; writes docs/reference/equal_bits.md
equal_bits.py TARGET...             these targets against that page; a target whose compiler or emulator is missing is skipped
equal_bits.py --programs PATH...    programs that are built already against that page
"""
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs/reference/equal_bits.md"
SCALARS = ("Fixed", "float", "double")
LINE = re.compile(r"(Fixed|float|double) (.+) 0x([0-9a-f]{16})$")
SKIPPED = 77


class Missing(Exception):
    """What a target needs and this machine has not."""


class Target:
    """A build of the corpus: how it is configured, and what runs it."""

    def __init__(self, title, compiler, options, emulator=()):
        self.title = title
        self.compiler = compiler
        self.options = options
        self.emulator = list(emulator)

    def run(self, name):
        for program in [self.compiler, *self.emulator[:1], "cmake", "ninja"]:
            if not shutil.which(program):
                raise Missing(f"{program} is not installed")
        folder = ROOT / "build/bits" / name
        say(["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", "-DSPLINEFEED_BITS=ON", "-DSPLINEFEED_WERROR=ON", *self.options])
        say(["cmake", "--build", folder, "--target", "equal_bits"])
        built = folder / "bin/equal_bits"
        return run_program([*self.emulator, built if built.exists() else built.with_suffix(".elf")])


def say(command):
    """Runs a command; what it says is shown where it fails."""
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{done.stdout}\n{' '.join(map(str, command))}: exit status {done.returncode}")
    return done.stdout


def run_program(command):
    """The hashes that a build of the corpus says: (scalar, program) -> hash."""
    hashes = {}
    for line in say(command).splitlines():
        if line.endswith("bytes"):  # what the start-up code of the boards says of the stack
            continue
        found = LINE.match(line)
        if not found or found[2].endswith("refused"):
            sys.exit(f"{' '.join(map(str, command))}: {line}")
        hashes[found[1], found[2]] = found[3]
    return hashes


def host(compiler, level):
    options = ["-DSPLINEFEED_HOST=OFF", "-DSPLINEFEED_TESTS=OFF", f"-DCMAKE_CXX_COMPILER={compiler}",
               "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_CXX_FLAGS_RELEASE={level} -DNDEBUG"]
    return Target(f"x86-64, {level}", compiler, options)


def linux(processor):
    """A processor that Debian has a cross compiler for, emulated in user mode."""
    compiler = f"{processor}-linux-gnu-g++"
    target = host(compiler, "-O2")
    return Target(f"{processor}, -O2", compiler,
                  [*target.options, "-DCMAKE_SYSTEM_NAME=Linux", f"-DCMAKE_SYSTEM_PROCESSOR={processor}",
                   "-DCMAKE_EXE_LINKER_FLAGS=-static"], [f"qemu-{processor}"])


def chip(cpu, board):
    """A Cortex-M; three axes and degree 5, as firmware would have it. The core of a Cortex-M0 runs on a board with more memory."""
    options = ["--preset", "arm", f"-DSPLINEFEED_CPU={cpu}", "-DSPLINEFEED_MAX_AXES=3", "-DSPLINEFEED_MAX_DEGREE=5"]
    emulator = ["qemu-system-arm", "-M", board, "-nographic", "-monitor", "none", "-serial", "none", "-chardev",
                "stdio,id=host", "-semihosting-config", "enable=on,target=native,chardev=host", "-kernel"]
    return Target(f"{cpu.title().replace('M4f', 'M4F')}, -Os", "arm-none-eabi-g++", options, emulator)


TARGETS = {
    **{f"gcc{level}": host("g++", level) for level in ("-O0", "-O2", "-O3")},
    **{f"clang{level}": host("clang++", level) for level in ("-O0", "-O2", "-O3")},
    "aarch64": linux("aarch64"),
    "riscv64": linux("riscv64"),
    "s390x": linux("s390x"),
    "cortex-m0": chip("cortex-m0", "mps2-an385"),
    "cortex-m3": chip("cortex-m3", "mps2-an385"),
    "cortex-m4f": chip("cortex-m4f", "mps2-an386"),
    "cortex-m7": chip("cortex-m7", "mps2-an500"),
}


def committed():
    """The hashes of the page."""
    hashes = {}
    for line in PAGE.read_text().splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if len(cells) == 1 + len(SCALARS) and any(re.fullmatch(r"`[0-9a-f]{16}`", cell) for cell in cells):
            for scalar, cell in zip(SCALARS, cells[1:]):
                if cell:
                    hashes[scalar, cells[0]] = cell.strip("`")
    return hashes


def differences(hashes, wanted):
    """What is not as wanted, in words."""
    return [f"{scalar} {program}: {hashes.get((scalar, program), 'nothing')}, not {wanted.get((scalar, program), 'there')}"
            for scalar, program in sorted({*hashes, *wanted})
            if hashes.get((scalar, program)) != wanted.get((scalar, program))]


def compare(title, hashes, wanted):
    """Whether they are equal; says it."""
    found = differences(hashes, wanted)
    print(f"{title}: {len(hashes)} hashes, " + ("all as on the page" if not found else "other than on the page:"))
    for line in found:
        print(f"    {line}")
    return not found


def version(compiler):
    first = say([compiler, "--version"]).splitlines()[0]
    return f"{compiler} {re.search(r'[0-9]+[.][0-9]+[.][0-9]+', first)[0]}"


def row_of(name, result, wanted):
    """A target's row: how many of its hashes are as wanted, or why there are none."""
    target = TARGETS[name]
    if isinstance(result, str):
        return f"| `{name}` | {target.title} | {result} | | | |"
    cells = []
    for scalar in SCALARS:
        programs = [program for of, program in wanted if of == scalar]
        other = [program for program in programs if result.get((scalar, program)) != wanted[scalar, program]]
        cells.append(f"all {len(programs)}" if not other else
                     f"{len(programs) - len(other)} of {len(programs)}; not: {', '.join(other)}")
    return f"| `{name}` | {target.title} | {version(target.compiler)} | {' | '.join(cells)} |"


def write_page(results):
    """Writes the page from the hashes of each target, or the reason why there are none. Those of g++ -O2 are the ones on it."""
    wanted = results["gcc-O2"]
    rows = [row_of(name, result, wanted) for name, result in results.items()]
    table = [f"| {program} | " + " | ".join(f"`{wanted[scalar, program]}`" if (scalar, program) in wanted else ""
                                            for scalar in SCALARS) + " |"
             for program in dict.fromkeys(program for _, program in wanted)]
    PAGE.write_text((pathlib.Path(__file__).parent / "equal_bits.md.in").read_text()
                    .replace("TARGETS\n", "\n".join(rows) + "\n").replace("HASHES\n", "\n".join(table) + "\n"))
    print(f"{PAGE.relative_to(ROOT)}: written")
    return all([compare(name, result, wanted) for name, result in results.items() if not isinstance(result, str)])


def run_all():
    """The hashes of each target, or why there are none."""
    results = {}
    for name, target in TARGETS.items():
        try:
            results[name] = target.run(name)
        except Missing as reason:
            results[name] = f"not run: {reason}"
        print(f"{name}: {len(results[name])} hashes" if not isinstance(results[name], str) else f"{name}: {results[name]}",
              flush=True)
    return results


def main():
    words = sys.argv[1:]
    if not words:
        return 0 if write_page(run_all()) else 1
    wanted = committed()
    if not wanted:
        sys.exit(f"{PAGE.relative_to(ROOT)} has no hashes")
    if words[0] == "--programs":
        return 0 if all([compare(path, run_program([path]), wanted) for path in words[1:]]) else 1
    skipped = good = True
    for name in words:
        if name not in TARGETS:
            sys.exit(f"{name} is no target; they are {', '.join(TARGETS)}")
        try:
            good = compare(name, TARGETS[name].run(name), wanted) and good
            skipped = False
        except Missing as reason:
            print(f"SKIPPED: {name}: {reason}")
    return 1 if not good else SKIPPED if skipped else 0


if __name__ == "__main__":
    sys.exit(main())
