#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Moves that follow the spindle (G33, G76, G33.1) in LinuxCNC, headless and simulated: how far they are from revolutions x pitch.

  bench/linuxcnc_spindle.py [--module build/linuxcnc/linuxcnc/splinefeed_tp.so] [--planner stock,module] [--jerk 30000] [--period 1000]
      [--wobble 0.03] [--hz 2] [--load 0.05] [--counts 2000] [--steer SEED] [--mode "G64 P0.01"] [--keep FOLDER] [--inch] [--check UM]
      [--linuxcnc TREE]

Each axis has 100 mm/s and 1000 mm/s^2. The spindle (bench/linuxcnc_spindle.comp) changes its speed by --wobble to both sides --hz times a
second, loses --load of it eleven revolutions behind the index, as where a cut begins, and has an encoder of --counts a revolution. A row is
a move. Its error is what the axes are commanded, less true revolutions x pitch, in the same period: its mean, and the largest distance from
0 and from the mean, from a quarter of the move to where it brakes for its end. Of a tap it is that behind a quarter of its depth, in and
out. Run-in: the time until the distance from the mean stays below 10 um. --steer holds, steps, changes overrides and the velocity limit at
random times, and ends a third of the runs with an abort: nothing but the abort may change a move that follows the spindle. --check fails
where the module exceeds a limit by 1e-4 or is more than UM off, or where an end is missed. --linuxcnc: as of bench/linuxcnc_tp.py.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import linuxcnc_tp as tp # noqa: E402, it takes this folder off the path

MOVES = [(300, 1.5, 20), (600, 1.0, 20), (600, 3.0, 40), (900, 1.5, 40), (1200, 2.0, 60), (1200, 0.5, 20)] # rpm, pitch, length
TAP = 12 # depth
SPINDLE = """loadrt linuxcnc_spindle
addf linuxcnc-spindle servo-thread 1
setp linuxcnc-spindle.wobble {o.wobble}
setp linuxcnc-spindle.wobble-hz {o.hz}
setp linuxcnc-spindle.load {o.load}
setp linuxcnc-spindle.counts {o.counts}
net spin spindle.0.speed-out-rps => linuxcnc-spindle.speed
net revs linuxcnc-spindle.revs => spindle.0.revs
net rps linuxcnc-spindle.speed-in => spindle.0.speed-in
net index spindle.0.index-enable <=> linuxcnc-spindle.index-enable
unlinkp spindle.0.at-speed
net fast linuxcnc-spindle.at-speed => spindle.0.at-speed
unlinkp sampler.0.pin.3
net turns linuxcnc-spindle.turns => sampler.0.pin.3
"""


def program(mode):
    lines = ["G21 G90 G17 G94 " + mode, "F3000"]
    marks = {}
    for rpm, pitch, length in MOVES:
        lines += [f"S{rpm} M3", "G4 P0.3", "G0 X0 Z0", f"G33 Z-{length} K{pitch}"]
        marks[len(lines)] = (rpm, pitch, length)
        lines += ["G0 X5"]
    lines += ["S300 M3", "G4 P0.3", "G0 X0 Z0", f"G33.1 Z-{TAP} K1"]
    marks[len(lines)] = (300, 1.0, TAP)
    lines += ["G0 X1", f"G33.1 Z-{TAP} K0.7 I2"] # the spindle is as the first one left it, and turns back twice as fast
    marks[len(lines)] = (300, 0.7, TAP)
    lines += ["S600 M3", "G4 P0.3", "G0 X20 Z0 G18", "G76 P1.5 Z-30 I-1 J0.2 R1.5 K0.8 Q29.5 H1 E1 L2"]
    marks[len(lines)] = (600, 1.5, 29)
    return "\n".join(lines + ["G0 X0 Z0", "M5", "M2", ""]), marks


def followed(samples, line, pitch, length, period_s, rpm, taps):
    """passes, then mean, |error|, |error - mean| in um, run-in in s, speed"""
    import numpy

    z = -samples[:, 2]
    goes = (samples[:, 4] == line) & (z > 1e-6) & (z < length - 1e-6) & (numpy.diff(z, prepend=0.0) > 0.0)
    edges = numpy.flatnonzero(numpy.diff(goes.astype(int), prepend=0, append=0))
    if taps: # in, and back again
        if not (z[samples[:, 4] == line] > length).any():
            return None
        deep = numpy.flatnonzero((samples[:, 4] == line) & (z > length / 4))
        error = 1e3 * (z[deep] - pitch * samples[deep, 3])
        return 1, error.mean(), abs(error).max(), abs(error - error.mean()).max(), 0.0, rpm / 60.0 * pitch
    passes = [slice(a, b) for a, b in zip(edges[::2], edges[1::2]) if b - a > 9 and z[b - 1] > length - 1]
    if not passes:
        return None
    speed = rpm / 60.0 * pitch
    error = [1e3 * (z[on] - z[on.start - 1] - pitch * samples[on, 3]) for on in passes] # a pass of G76 begins where the cut is wide enough
    judged = numpy.concatenate([e[(z[on] > length / 4) & (z[on] < length - 1 - speed * speed / 250)] for e, on in zip(error, passes)])
    mean = judged.mean()
    far = max((numpy.flatnonzero((abs(e - mean) > 10.0) & (z[on] < length / 4))[-1:] + 1).sum() for e, on in zip(error, passes))
    return len(passes), mean, abs(judged).max(), abs(judged - mean).max(), far * period_s, speed


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name, kind, default in (("planner", str, "stock,module"), ("wobble", float, 0.03),
                                ("hz", float, 2.0), ("load", float, 0.05), ("counts", int, 2000), ("steer", int, None), ("mode", str, "G64 P0.01"),
                                ("keep", pathlib.Path, None), ("check", float, None)):
        parser.add_argument("--" + name, type=kind, default=default)
    options = tp.parsed(parser, 120)
    if options is None:
        return 0
    failed = False
    print("| planner | rpm | pitch | passes | speed mm/s | mean um | off by um | from the mean um | run-in s | velocity | acceleration | jerk | problem |\n" + "|---" * 13 + "|")
    text, marks = program(options.mode)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        comp = folder / "linuxcnc_spindle.comp"
        comp.write_text((HERE / comp.name).read_text())
        compiler = options.linuxcnc / "bin/halcompile" if options.linuxcnc else "halcompile"
        subprocess.run([compiler, "--compile", comp.name], cwd=folder, check=True, capture_output=True)
        options.hal = folder / "spindle.hal"
        options.hal.write_text(SPINDLE.format(o=options))
        for planner in options.planner.split(","):
            ours = planner == "module"
            parameters = f"jerk={options.jerk}" if options.jerk else ""
            actions = [] if options.steer is None else tp.load(tp.HERE / "linuxcnc_actions.py").random_actions(options.steer, 25.0)
            aborted = any(what == "abort" for _, what, _ in actions)
            result = tp.run(text, "XYZ", options, options.module.resolve() if ours else None, parameters, actions, [comp.with_suffix(".so")])
            problem = "; ".join([result["problem"]] * bool(result["problem"]) + result["said"])
            if "samples" not in result:
                print(f"| {planner} | {problem} |")
                failed = True
                continue
            if options.keep:
                options.keep.mkdir(exist_ok=True)
                result["samples"].tofile(options.keep / f"spindle.{planner}.bin")
            used = tp.limits_used(result["samples"], "XYZ", options.period, options.jerk)[1:]
            if ours and max(used) > 1.0001:
                problem += " a limit is exceeded"
            if max(abs(p) for p in result["position"]) > 1e-6:
                problem += f" it ends at {result['position'][:3]}"
            for line, (rpm, pitch, length) in marks.items():
                found = followed(result["samples"], line, pitch, length, options.period * 1e-6, rpm, length == TAP)
                if found is None and aborted:
                    continue
                if found is None:
                    print(f"| {planner} | {rpm} | {pitch} | line {line} was not seen | {problem} |")
                    failed = failed or ours
                    continue
                passes, mean, off, spread, run_in, speed = found
                failed = failed or ours and options.check is not None and off > options.check
                print(f"| {planner} | {rpm} | {pitch} | {passes} | {speed:.1f} | {mean:.2f} | {off:.2f} | {spread:.2f} | {run_in:.3f} | "
                      + " | ".join(f"{u:.5f}" for u in used) + f" | {problem} |", flush=True)
            failed = failed or ours and bool(problem)
    return 1 if options.check is not None and failed else 0


if __name__ == "__main__":
    sys.exit(main())
