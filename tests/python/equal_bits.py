# SPDX-License-Identifier: MIT
"""Random plans have the bits of the command's: equal_bits.py [SEED [COUNT]]."""
import itertools
import pathlib
import sys
import tempfile

import numpy as np

import splinefeed
import tool

CURVES = ("g2", "catmull-rom", "polyline", "bspline", "bspline-interpolation")


def random_machine(rng):
    axes = "xyzabc"[:rng.integers(1, 7)]
    jerk = rng.random() < 0.5
    return splinefeed.Machine(axes, max_feed_mm_s=rng.uniform(20, 200),
                              max_velocity_mm_s=rng.uniform(50, 200, len(axes)), max_acceleration_mm_s2=rng.uniform(300, 3000, len(axes)),
                              max_jerk_mm_s3=rng.uniform(1e4, 1e5, len(axes)) if jerk else None,
                              max_braking_mm_s2=rng.uniform(500, 3000) if rng.random() < 0.3 else None,
                              steps_per_mm=rng.uniform(50, 1000, len(axes)), sample_period_us=int(rng.integers(4, 40)) * 50,
                              centripetal_mm_s2=rng.uniform(500, 2000) if rng.random() < 0.3 else None)


def main():
    seed = int(sys.argv[1]) if len(sys.argv) > 1 else int(np.random.SeedSequence().entropy % 2**32)
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 50
    print(f"seed {seed}", flush=True)
    rng = np.random.default_rng(seed)
    segments = 0
    with tempfile.TemporaryDirectory() as folder:
        for number, curve in zip(range(count), itertools.cycle(CURVES)):
            machine = random_machine(rng)
            axes, rows = len(machine.axes), int(rng.integers(5, 60))
            points = np.cumsum(rng.normal(0, 3, (rows, axes)), axis=0)
            columns = {name: values for name, values in (("feed", rng.uniform(5, 150, rows)), ("max_feed", rng.uniform(50, 150, rows)))
                       if curve != "bspline-interpolation" and rng.random() < 0.5}
            scalar = ["fixed", "double"][int(rng.integers(2))]
            table = np.column_stack([points, *columns.values()])
            file = pathlib.Path(folder) / f"{number}.csv"
            file.write_text(",".join([*machine.axes, *columns]) + "\n" + "\n".join(",".join(map(repr, map(float, row))) for row in table) + "\n")
            expected, summary = tool.planned(file, machine, "--curve", curve, "--scalar", scalar)
            motion = splinefeed.plan(points, machine, curve, scalar=scalar, **{f"{name}_mm_s": values for name, values in columns.items()})
            found = tool.as_rows(motion.segments, axes)
            if not np.array_equal(expected, found) or tool.without_process(summary) != tool.without_process(motion.summary):
                print(f"plan {number} of seed {seed} ({curve}, {scalar}, {machine}) is not that of the command")
                return 1
            segments += len(found)
    print(f"{count} plans, {segments} segments: equal bits")
    return 0


if __name__ == "__main__":
    sys.exit(main())
