# SPDX-License-Identifier: MIT
"""A sweep on a cluster of which a worker is killed: every row is there, and is what one process plans."""
import contextlib
import csv
import importlib.util
import os
import pathlib
import subprocess
import sys
import time
import unittest
import warnings

os.environ["DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT"] = "120s"  # of every process here: others may have the processors
try:
    import distributed
except ImportError:
    print("SKIPPED: there is no distributed (Debian: apt-get install python3-distributed)")
    sys.exit(77)

import splinefeed
import tool
from scratch import JERKY, noise, Scratch

SWEEP = tool.ROOT / "examples/python/sweep.py"
MACHINE = tool.ROOT / "examples/jerk_limited.toml"
PROGRAM = str(tool.ROOT / "examples/wave.ngc")
VARY = ["axis.*.max_acceleration_mm_s2=500:3000:20", "axis.*.max_jerk_mm_s3=10000:90000:25", "path.max_feed_mm_s=50:100:2"]  # 1,000 machines
PATIENCE_S = 120.0
warnings.filterwarnings("ignore", category=DeprecationWarning)  # of Debian's distributed and tornado


def example():
    """The program as a module."""
    spec = importlib.util.spec_from_file_location("sweep", SWEEP)
    module = importlib.util.module_from_spec(spec)
    sys.modules["sweep"] = module
    spec.loader.exec_module(module)
    return module


class Sweep(Scratch):
    def start(self, *command, **options):
        process = subprocess.Popen(command, cwd=self.folder, **options)
        self.addCleanup(process.__exit__, None, None, None)
        self.addCleanup(process.kill)
        return process

    def wait_for(self, what, condition):
        end = time.monotonic() + PATIENCE_S
        while not (found := condition()):
            self.assertLess(time.monotonic(), end, f"{what} has not come")
            time.sleep(0.01)
        return found

    def cluster(self):
        """(client, address, workers by name): a scheduler and two workers, each a process."""
        file, log = self.folder / "scheduler.json", (self.folder / "log").open("w")
        self.addCleanup(log.close)
        self.start("dask-scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard", "--scheduler-file", file, stderr=log, stdout=log)
        self.wait_for("the scheduler", lambda: file.exists() and file.stat().st_size > 0)
        workers = {name: self.start("dask-worker", "--scheduler-file", file, "--host", "127.0.0.1", "--no-nanny", "--no-dashboard", "--nthreads", "1",
                                    "--name", name, "--local-directory", self.folder / name, stderr=log, stdout=log) for name in ("stays", "dies")}
        client = self.enterContext(distributed.Client(scheduler_file=str(file)))
        client.wait_for_workers(2)
        return client, client.scheduler.address, workers

    def test_a_worker_that_is_killed_loses_nothing(self):
        bad = self.folder / "bad.ngc"
        bad.write_text("G1 X10 F3000\nG1 Q7\n")
        programs = [PROGRAM, str(bad)]
        client, address, workers = self.cluster()
        table = self.folder / "table.csv"
        run = self.start(sys.executable, SWEEP, MACHINE, *programs, *(word for one in VARY for word in ("--vary", one)), "--csv", table,
                         "--scheduler", address, stderr=subprocess.PIPE, text=True)
        rows = lambda: len(table.read_text().splitlines()) - 1 if table.exists() else 0
        total = 2000
        addresses = {info["name"]: worker for worker, info in client.scheduler_info()["workers"].items()}
        self.wait_for("a row", lambda: rows() > total // 20)
        self.wait_for("work for the worker", lambda: client.processing()[addresses["dies"]])
        workers["dies"].kill()
        at_death = rows()
        said = run.communicate(timeout=PATIENCE_S)[1]
        self.assertEqual(run.returncode, 0, said)
        self.assertLess(at_death, total)
        self.assertIn(f"{total} of {total}", said)
        self.assertEqual([info["name"] for info in client.scheduler_info()["workers"].values()], ["stays"])
        sweep = example()
        expected = [{"program": program, **values, **sweep.planned(pathlib.Path(program).read_text() + "\n", machine, None)}
                    for program in programs for values, machine in sweep.machines_of(MACHINE, [sweep.Variation.parse(one) for one in VARY])]
        with table.open(newline="") as file:
            found = list(csv.DictReader(file))
        texts = [{key: str(row.get(key, "")) for key in found[0]} for row in expected]
        order = lambda row: sorted(row.items())
        self.assertEqual(len(found), total)
        self.assertEqual(sorted(found, key=order), sorted(texts, key=order))
        self.assertEqual({row["error"].partition(":")[0] for row in found if row["program"] == str(bad)}, {"program"})
        self.assertGreater(len({row["time_s"] for row in found}), 100)
        # Whole motions come back with their bits, from the worker that is left.
        points = noise(50)
        self.assertEqual(client.submit(splinefeed.plan, points, JERKY).result(), splinefeed.plan(points, JERKY))
        with self.assertRaisesRegex(splinefeed.InputError, "points:1: there is a single waypoint"):
            client.submit(splinefeed.plan, points[:1], JERKY).result()

    def test_what_is_wrong_is_said_before_there_is_a_table(self):
        for program, vary, sentence in ((PROGRAM, "path.max_feed_mm_s=0:100:3", "--set path.max_feed_mm_s=0.0: max_feed_mm_s is 0; it must lie between"),
                                        (PROGRAM, "path.max_feed_mm_s=7", "'path.max_feed_mm_s=7' must be KEY=LOW:HIGH:COUNT"),
                                        ("none.ngc", "path.max_feed_mm_s=50:100:3", "No such file or directory: 'none.ngc'")):
            done = subprocess.run([sys.executable, SWEEP, MACHINE, program, "--vary", vary, "--csv", self.folder / "t.csv"], capture_output=True,
                                  text=True, check=False)
            self.assertEqual(done.returncode, 2)
            self.assertIn(sentence, done.stderr)
            self.assertFalse((self.folder / "t.csv").exists())


if __name__ == "__main__":
    unittest.main(verbosity=1)
