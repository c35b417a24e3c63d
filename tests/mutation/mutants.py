#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Changes operators and constants of the feed plan, the segment stream, the pulse train and the ports, one at a time: a test has to
notice each. All of them are in one build (schemata.py); which one acts is said when a test program starts.

    mutants.py [--module NAME] [--count N a module] [--seed S] [--jobs J] [--folder F: is kept]

Those that no test notices have to be in survivors.txt, with the reason why that is right, or as open."""
import argparse
import concurrent.futures
import dataclasses
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

from modules import MODULES
from schemata import chosen, rewritten, sites

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
SEED = 13
LIMIT_FACTOR, LIMIT_LEAST_S = 6.0, 20.0  # a mutant that takes so much longer than the tests without one hangs
ATTEMPTS = 6  # to compile: what does not is left out


class Build:
    """A copy of the repository with all mutants of some modules in it."""

    def __init__(self, folder, modules, seed, count, jobs):
        self.folder, self.jobs = pathlib.Path(folder), jobs
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout
        for name in filter(None, listed.split("\0")):
            if (ROOT / name).is_file():
                (self.folder / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy2(ROOT / name, self.folder / name)
        self.candidates = {}
        for module in modules:
            every = [site for file in module.files(ROOT) for site in sites(file, (ROOT / file).read_text(encoding="utf-8"))]
            self.candidates[module.name] = chosen(every, seed, 2 * count)
        self.count, self.left_out, self.mutants = count, set(), {}
        self.targets = sorted({program for module in modules for program, _ in module.tests})
        self.options = [f"-DSPLINEFEED_HOST={'ON' if any(module.host for module in modules) else 'OFF'}"]  # of a folder that is kept, too

    def number(self):
        """Gives each mutant that is left a number: of each module the first `count`."""
        self.mutants = {}
        for name, candidates in self.candidates.items():
            for site in [site for site in candidates if site.name not in self.left_out][:self.count]:
                self.mutants[len(self.mutants)] = (name, site)

    def write(self):
        by_file = {}
        for number, (_, site) in self.mutants.items():
            by_file.setdefault(site.file, []).append((number, site))
        for file in {site.file for candidates in self.candidates.values() for site in candidates}:
            text = (ROOT / file).read_text(encoding="utf-8")
            if file in by_file:
                text = rewritten(text, by_file[file])
                shutil.copy2(HERE / "mutants.hpp", (self.folder / file).parent)
            if (self.folder / file).read_text(encoding="utf-8") != text:
                (self.folder / file).write_text(text, encoding="utf-8")

    def make(self):
        build = self.folder / "build" / "release"
        subprocess.run(["cmake", "--preset", "release", "-DSPLINEFEED_REPOSITORY_TESTS=OFF", *self.options], cwd=self.folder, check=True, stdout=subprocess.DEVNULL)
        for _ in range(ATTEMPTS):
            self.number()
            self.write()
            made = subprocess.run(["ninja", "-k", "0", "-j", str(self.jobs), "-C", str(build), *self.targets], check=False,
                                  capture_output=True, text=True)
            if made.returncode == 0:
                return build / "bin"
            named = set(re.findall(r"([\w/.]+\.cpp):(\d+):", made.stdout))
            failed = {site.name for _, site in self.mutants.values()
                      if any(file.endswith(site.file) and int(line) == site.line + 1 for file, line in named)}
            if not failed:
                print(made.stdout[-4000:], made.stderr[-4000:])
                break
            self.left_out |= failed
        raise SystemExit("the mutants do not compile")


class Tests:
    """A test program with its filter, and what it does without a mutant."""

    def __init__(self, program, pattern, folder):
        self.command = [str(program), *([pattern] if pattern else []), "--abort"]
        self.folder = folder
        self.limit_s = None
        record = os.path.join(folder, "reached")
        started = time.monotonic()
        status, output = self.run(None, {"SPLINEFEED_MUTANTS_REACHED": record})
        if status != 0:
            raise SystemExit(f"{' '.join(self.command)} fails without a mutant:\n{output[-3000:]}")
        print(f"{program.name} {pattern}: {time.monotonic() - started:.1f} s without a mutant", flush=True)
        self.limit_s = max(LIMIT_LEAST_S, LIMIT_FACTOR * (time.monotonic() - started))
        self.reached = set()
        if os.path.exists(record):  # not where the program is made without any source that has a mutant
            with open(record, encoding="ascii") as file:
                self.reached = {int(line) for line in file}
            os.remove(record)

    def run(self, mutant, more=None):
        """The exit status, not 0 where it takes too long, and what was printed."""
        environment = {**os.environ, **(more or {})}
        environment.pop("SPLINEFEED_LONG", None)  # random tests as in ./check
        if mutant is not None:
            environment["SPLINEFEED_MUTANT"] = str(mutant)
        try:
            call = subprocess.run(self.command, cwd=self.folder, env=environment, capture_output=True, text=True, check=False,
                                  timeout=self.limit_s, errors="replace")
        except subprocess.TimeoutExpired:
            return -1, "takes too long"
        return call.returncode, call.stdout

    def notice(self, mutant):
        return mutant in self.reached and self.run(mutant)[0] != 0


def listed():
    """The mutants of survivors.txt, and the text that is indented below each."""
    reasons, name = {}, None
    for line in (HERE / "survivors.txt").read_text(encoding="utf-8").splitlines():
        if line.startswith("    ") and name:
            reasons[name] = f"{reasons[name]} {line.strip()}".strip()
        elif line and not line.startswith("#"):
            name = line.strip()
            reasons[name] = ""
    return reasons


@dataclasses.dataclass
class Score:
    """What became of the mutants of a module."""
    module: str
    noticed: int = 0
    argued: int = 0
    open: int = 0
    new: int = 0

    def __str__(self):
        count = self.noticed + self.argued + self.open + self.new
        return (f"{self.module}: {self.noticed} of {count} noticed; of the others {self.argued} are argued, {self.open} known as open, "
                f"{self.new} not in survivors.txt")


def scores(options, modules):
    """One for each of these modules, whose mutants are in one build."""
    reasons = listed()
    with tempfile.TemporaryDirectory(prefix="splinefeed-mutants-") as scratch:
        build = Build(options.folder or scratch, modules, options.seed, options.count, options.jobs)
        programs = build.make()
        print(f"seed {options.seed}; {len(build.mutants)} mutants, {len(build.left_out)} do not compile and are left out", flush=True)
        for module in modules:
            tests = [Tests(programs / program, pattern, scratch) for program, pattern in module.tests]
            score = Score(module.name)
            sites_of_module = [(number, site) for number, (name, site) in build.mutants.items() if name == module.name]
            with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
                noticed = pool.map(lambda mutant, those=tuple(tests): any(test.notice(mutant[0]) for test in those), sites_of_module)
            for (number, site), was_noticed in zip(sites_of_module, noticed):
                reason = reasons.get(site.name, "")
                if was_noticed:
                    score.noticed += 1
                    if reason:
                        print(f"noticed, and yet in survivors.txt: {site.name}", flush=True)
                elif reason:
                    score.open += reason.startswith("open")
                    score.argued += not reason.startswith("open")
                else:
                    score.new += 1
                    where = "" if any(number in test.reached for test in tests) else " (no test passes it)"
                    print(f"NOT NOTICED {number}{where}\n{site.name}", flush=True)
            yield score


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--module", choices=[module.name for module in MODULES])
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=SEED)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--folder")
    options = parser.parse_args()
    wanted = [module for module in MODULES if options.module in (None, module.name)]
    # What does without the host's libraries is built without them.
    found = [score for host in (False, True) if (modules := [module for module in wanted if module.host == host])
             for score in scores(options, modules)]
    print(*found, sep="\n")
    surveyed = {module.name for module in wanted if module.surveyed}
    return 1 if any(score.new and score.module in surveyed for score in found) else 0


if __name__ == "__main__":
    sys.exit(main())
