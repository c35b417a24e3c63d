#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Programs through LinuxCNC, headless and simulated, with its own trajectory planner and with splinefeed_tp.so.

  bench/linuxcnc_tp.py PROGRAM... [--module build/linuxcnc/linuxcnc/splinefeed_tp.so] [--planner stock,module] [--mode "G64 P0.01 Q0"]
      [--jerk 30000] [--period 1000] [--parameters "ahead=16"] [--steer SEED] [--starve 10] [--judge CHECK_PATH.PY] [--canon CANON.PY]
      [--tool build/tool/bin/splinefeed] [--stops] [--keep FOLDER] [--hal FILE] [--set SECTION.KEY=VALUE]... [--inch] [--check]
      [--linuxcnc TREE] [--step] [--back]

Each axis has 100 mm/s and 1000 mm/s^2. LinuxCNC runs in name spaces of its own and needs no rights; each servo period is recorded as
double. Printed: cycle time, largest use of a limit in first, second and third differences of what was commanded, and of the module what
its part of a period took, in the mean and at most. --mode replaces the G64 and G61 words of the program. --steer holds, steps, changes
overrides and the velocity limit at random times, and ends a third of the runs with an abort and moves by hand. --starve: in so many of
a hundred periods planning gets no time. --judge and --canon measure the distance from the path. --stops, with --tool, prints the time
without motion, too, and what the tool takes with a stop where the machine stood: what is left is lost by the planner. --hal: more lines for
HAL. --set: a line of the INI file. --inch: the machine's unit is the inch. --refused: what LinuxCNC has to say, without motion and without
output 0. --indexer: A is a locking rotary axis, which takes 0.15 s to unlock or lock. Nothing else moves while it is unlocked, and it not
while it is locked. --step: pauses the program, which has whole millimetres, steps four times, and looks where. --back: an adaptive feed of -1 from 1.5 s
on, until it has come to where it began, and then of 1. How far it is from the way there is printed as its path. --check fails where a limit is exceeded by 1e-4, an end is missed, or a period had no motion. --linuxcnc: a source tree
of LinuxCNC, built to run in place, else what is installed.
"""
import argparse
import importlib.util
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from linuxcnc_samples import ACCELERATION, OTHERS, VELOCITY, back_problem, controller_us, indexer_problem, limits_used, standing, step_problem

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:] = [p for p in sys.path if pathlib.Path(p or ".").resolve() != HERE]  # its gcode.py is not LinuxCNC's gcode
FIGURES = ["splinefeed-tp." + name for name in ("max-us", "mean-us", "urgent", "late", "busy")] + [
    "splinefeed-tp.below-%04d-us" % (1 << bit) for bit in range(12)] + ["splinefeed-tp.above-2048-us", "motion-controller.tmax"]

INSIDE = """set -e
cd /
[ -z "$2" ] || mount --bind "$2" "$4"
mount --rbind "$1" /tmp
/usr/bin/python3 -c 'import fcntl, socket, struct
fcntl.ioctl(socket.socket(), 0x8914, struct.pack("16sh14x", b"lo", 0x1 | 0x40))'
cd /tmp
export HOME=/tmp PATH="$5"/usr/sbin:/usr/bin:/sbin:/bin
if [ "$3" = root ]; then # rtapi_app refuses to run for root
    chown -R 65534:65534 /tmp/.
    exec setpriv --reuid=65534 --regid=65534 --clear-groups --no-new-privs linuxcnc -r /tmp/sim.ini < /dev/null
fi
exec unshare --user --map-user=65534 --map-group=65534 setpriv --no-new-privs linuxcnc -r /tmp/sim.ini < /dev/null
"""

INI = """[EMC]
VERSION = 1.1
[DISPLAY]
DISPLAY = ./driver.py
MAX_FEED_OVERRIDE = 2.0
[RS274NGC]
PARAMETER_FILE = sim.var
[EMCMOT]
EMCMOT = motmod
UNLOCK_JOINTS = 0
COMM_TIMEOUT = 60.0
SERVO_PERIOD = {period_ns}
[EMCIO]
EMCIO = io
CYCLE_TIME = 0.1
TOOL_TABLE = sim.tbl
[TASK]
TASK = milltask
CYCLE_TIME = 0.001
[HAL]
HALFILE = sim.hal
[KINS]
KINEMATICS = trivkins coordinates={axes}
JOINTS = {joints}
[TRAJ]
COORDINATES = {axes}
LINEAR_UNITS = {units}
ANGULAR_UNITS = degree
DEFAULT_LINEAR_VELOCITY = 100
MAX_LINEAR_VELOCITY = 1000
{tpmod}
"""
AXIS = """[{section}]
TYPE = {kind}
MIN_LIMIT = -10000
MAX_LIMIT = 10000
MAX_VELOCITY = {velocity}
MAX_ACCELERATION = {acceleration}
HOME = 0
HOME_OFFSET = 0
HOME_SEARCH_VEL = 0
HOME_LATCH_VEL = 0
HOME_SEQUENCE = 0
FERROR = 1000
MIN_FERROR = 1000
"""
HAL = """loadrt [KINS]KINEMATICS
loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS unlock_joints_mask=[EMCMOT]UNLOCK_JOINTS
loadrt sampler depth=60000 cfg={cfg}
addf motion-command-handler servo-thread
addf motion-controller servo-thread
addf sampler.0 servo-thread
{nets}net speed motion.current-vel => sampler.0.pin.{0}
net line motion.program-line => sampler.0.pin.{1}
net inpos motion.in-position => sampler.0.pin.{2}
net out motion.digital-out-00 => sampler.0.pin.{3}
net clocks motion-controller.time => sampler.0.pin.{4}
net adaptive => motion.adaptive-feed
sets adaptive 1
net estop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in
net prep iocontrol.0.tool-prepare => iocontrol.0.tool-prepared
net chng iocontrol.0.tool-change => iocontrol.0.tool-changed
net atspeed spindle.0.on => spindle.0.at-speed
"""
INDEXER_HAL = """loadrt timedelay count=1
addf timedelay.0 servo-thread
setp timedelay.0.on-delay 0.15
setp timedelay.0.off-delay 0.15
net unlock joint.3.unlock => timedelay.0.in
unlinkp sampler.0.pin.{0}
net unlocked timedelay.0.out => joint.3.is-unlocked => sampler.0.pin.{0}
"""
INDEXER_INI = ["JOINT_3.LOCKING_INDEXER=1", "EMCMOT.UNLOCK_JOINTS=8", "AXIS_A.LOCKING_INDEXER_JOINT=3", "AXIS_A.WRAPPED_ROTARY=1"]


def modules_of(options):
    return options.linuxcnc / "rtlib" if options.linuxcnc else pathlib.Path("/usr/lib/linuxcnc/modules")


def units_mm(axes, inch):
    return [25.4 if inch and axis not in "ABC" else 1.0 for axis in axes]


def write_machine(folder, axes, options, tpmod):
    text = INI.format(period_ns=options.period * 1000, axes=axes, joints=len(axes), units="inch" if options.inch else "mm",
                      tpmod=f"TPMOD = {tpmod}" if tpmod else "")
    nets = ""
    for i, (axis, mm) in enumerate(zip(axes, units_mm(axes, options.inch))):
        for section in ("AXIS_" + axis, f"JOINT_{i}"):
            kind = "ANGULAR" if axis in "ABC" else "LINEAR"
            text += AXIS.format(section=section, kind=kind, velocity=VELOCITY / mm, acceleration=ACCELERATION / mm)
        nets += f"net j{i} joint.{i}.motor-pos-cmd => joint.{i}.motor-pos-fb\n"
        nets += f"net p{i} axis.{axis.lower()}.pos-cmd => sampler.0.pin.{i}\n"
    for setting in options.set + (INDEXER_INI if options.indexer else []): # of two lines for one key the first counts
        section, key = setting.split("=")[0].split(".")
        text = text.replace(f"[{section}]\n", f"[{section}]\n{key} = {setting.split('=', 1)[1]}\n")
    n = len(axes)
    (folder / "sim.ini").write_text(text)
    (folder / "sim.hal").write_text(HAL.format(*range(n, n + 5), cfg="f" * (n + 1) + "sbbs", nets=nets) + (options.hal.read_text() if options.hal else "")
                                    + (INDEXER_HAL.format(n + OTHERS.index("digital-out-00")) if options.indexer else ""))
    (folder / "sim.var").write_text("")
    (folder / "sim.tbl").write_text("T1 P1 D1\n")
    shutil.copy(HERE / "linuxcnc_driver.py", folder / "driver.py")
    os.chmod(folder / "driver.py", 0o755)


def run(program, axes, options, module, parameters, actions, components=[]):
    """One run: what the driver tells, with the samples as an array of a row a period."""
    import numpy

    with tempfile.TemporaryDirectory(prefix="linuxcnc-") as name:
        folder = pathlib.Path(name) / "work"
        folder.mkdir()
        modules = ""
        if module or components:
            modules = pathlib.Path(name) / "modules"
            shutil.copytree(modules_of(options), modules)
            for path, so in ([(module, "splinefeed_tp.so")] if module else []) + [(path, path.name) for path in components]:
                shutil.copy(path, modules / so)
            subprocess.run(["chmod", "-R", "a+rX", name], check=True)
        write_machine(folder, axes, options, module and f"splinefeed_tp axes={axes} inch={int(options.inch)} {parameters}")
        (folder / "program.ngc").write_text(program)
        job = {"actions": actions, "timeout_s": options.timeout, "figures": FIGURES, "columns": len(axes) + len(OTHERS)}
        (folder / "job.json").write_text(json.dumps(job))
        spaces = ["unshare", "--mount", "--ipc", "--net", "--pid", "--fork", "--mount-proc", "--kill-child"]
        root = os.getuid() == 0
        spaces += [] if root else ["--user", "--map-root-user"]
        environment = {k: v for k, v in os.environ.items() if k != "DISPLAY"}
        path = f"{options.linuxcnc}/scripts:{options.linuxcnc}/bin:" if options.linuxcnc else ""
        ran = subprocess.run([*spaces, "bash", "-c", INSIDE, "inside", folder, modules, "root" if root else "user", modules_of(options), path],
                             capture_output=True, text=True, env=environment, timeout=options.timeout + 120, check=False)
        if not (folder / "result.json").exists():
            return {"problem": "LinuxCNC did not run: " + " | ".join((ran.stdout + ran.stderr).strip().split("\n")[-12:]), "said": []}
        result = json.loads((folder / "result.json").read_text())
        result["samples"] = numpy.fromfile(folder / "samples.bin").reshape(-1, job["columns"])
        result["samples"][:, : len(axes)] *= units_mm(axes, options.inch)
        return result


def load(path):
    spec = importlib.util.spec_from_file_location(pathlib.Path(path).stem, path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def path_error(options, text, samples, axes, period_us, folder):
    import numpy

    program = folder / "program.ngc"
    program.write_text(text)
    elements = load(options.canon).convert(str(program))
    n = len(axes)
    limits = numpy.full(n, VELOCITY), numpy.full(n, ACCELERATION), numpy.full(n, options.jerk or numpy.inf)
    times = numpy.arange(len(samples)) * period_us * 1e-6
    return load(options.judge).judge(elements, times, samples[:, :n], axes.lower(), *limits)


def with_stops(text, lines):
    """The program with a stop before each of the lines, which count from 1."""
    rows = text.split("\n")
    for line in reversed([n for n in lines if 1 < n <= len(rows)]):
        rows.insert(line - 1, "G4 P0")
    return "\n".join(rows)


def tool_time(options, text, axes, folder):
    programmed = re.search(r"G64\s*P([\d.]+)", text, re.I)
    tolerance = float(programmed[1]) if programmed else 0.01
    machine = f"sample_period_us = {options.period}\n\n[path]\nmax_feed_mm_s = 173.2\nrapid_tolerance_mm = {tolerance}\n"
    for axis in axes:
        machine += f'\n[[axis]]\nname = "{axis.lower()}"\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\nsteps_per_mm = 320\n'
        machine += f"max_jerk_mm_s3 = {options.jerk}\n" if options.jerk else ""
        machine += 'kind = "rotary"\n' if axis in "ABC" else ""
    (folder / "m.toml").write_text(machine)
    (folder / "tool.ngc").write_text(re.sub(r"(G64\s*P[\d.]+)\s*Q[\d.]+", r"\1", text, flags=re.I)) # it joins short lines itself, within P
    ran = subprocess.run([options.tool, "run", folder / "tool.ngc", "-m", folder / "m.toml", "--scalar", "double", "--summary", "json"],
                         capture_output=True, text=True, check=False)
    return json.loads(ran.stdout)["cycle_time_s"] if ran.returncode == 0 else float("nan")


def begun_with(words, text):
    first = re.match(r"\s*%.*\n", text)
    at = first.end() if first else 0
    return text[:at] + words + "\n" + text[at:]


def in_mode(text, mode):
    if not mode:
        return text
    inch = "G20" in text.upper() # all its tolerances, then
    words = re.sub(r"([PQ])([\d.]+)", lambda m: f"{m[1]}{float(m[2]) / 25.4:.7f}" if inch else m[0], mode)
    replaced, n = re.subn(r"\bG(64|61(\.1)?)\b(\s*[PQ][\d.]+)*", words, text, flags=re.I)
    return replaced if n else begun_with(words, text)


def parsed(parser, timeout_s):
    """The arguments, with those of any run(); None where there is no LinuxCNC."""
    for name, kind, default in (("module", pathlib.Path, HERE.parent / "build/linuxcnc/linuxcnc/splinefeed_tp.so"), ("linuxcnc", pathlib.Path, None),
                                ("jerk", int, 0), ("period", int, 1000), ("timeout", int, timeout_s)):
        parser.add_argument("--" + name, type=kind, default=default)
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("--inch", action="store_true")
    parser.set_defaults(hal=None, indexer=False)
    options = parser.parse_args()
    if options.linuxcnc and not modules_of(options).is_dir():
        parser.error(f"--linuxcnc {options.linuxcnc}: there is no {modules_of(options)}: build that source tree to run in place")
    if not options.linuxcnc and shutil.which("linuxcnc") is None:
        print("SKIPPED: there is no LinuxCNC (Debian: apt-get install linuxcnc-uspace)")
        return None
    return options


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs="+", type=pathlib.Path)
    parser.add_argument("--planner", default="stock,module")
    parser.add_argument("--axes", default="")
    for name, kind, default in (("mode", str, ""), ("parameters", str, ""), ("steer", int, None),
                                ("runs", int, 1), ("starve", int, 0), ("judge", str, ""), ("canon", str, ""), ("tool", str, ""),
                                ("refused", str, ""), ("keep", pathlib.Path, None), ("hal", pathlib.Path, None)):
        parser.add_argument("--" + name, type=kind, default=default)
    parser.add_argument("--stops", action="store_true")
    parser.add_argument("--indexer", action="store_true")
    parser.add_argument("--step", action="store_true")
    parser.add_argument("--back", action="store_true")
    parser.add_argument("--check", action="store_true")
    options = parsed(parser, 300)
    if options is None:
        return 0
    print("| program | planner | s | tool, s | path, um | velocity | acceleration | jerk | mean us | max us | urgent | late | controller us: mean, 99.9 % | problem |\n"
          "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|")
    failed = 0
    ends = {} # where a program ends
    for program, seed in ((p, s) for p in options.programs for s in range(options.runs)):
        text = in_mode(program.read_text(), options.mode)
        axes = options.axes or ("XYZA" if re.search(r"\bA[-+.\d]", re.sub(r"\(.*?\)|;.*", "", text)) else "XYZ")
        with tempfile.TemporaryDirectory() as name:
            tool_s = tool_time(options, text, axes, pathlib.Path(name)) if options.tool else 0.0
        for planner in options.planner.split(","):
            ours = planner == "module"
            parameters = options.parameters + (f" jerk={options.jerk}" if options.jerk else "") + f" starve={options.starve}"
            steers = options.steer is not None
            actions = load(HERE / "linuxcnc_actions.py").random_actions(options.steer + seed, tool_s or 8.0) if steers else []
            if options.step:
                actions = [[t, "step" if t > 0.5 else "hold", 0] for t in (0.5, 1.5, 3.0, 4.5, 6.0)] + [[7.5, "resume", 0]]
            if options.back:
                actions = [[1.5, "adaptive", -1.0], [4.5, "adaptive", 1.0]]
            sent = begun_with("M52 P1", text) if steers or options.back else text
            result = run(sent, axes, options, options.module.resolve() if ours else None, parameters, actions)
            row = [program.name, planner]
            problem = "; ".join(dict.fromkeys([result["problem"]] * bool(result["problem"]) + result["said"]))
            if "samples" in result:
                used = limits_used(result["samples"], axes, options.period, options.jerk)
                figures = result["figures"]
                path_um = 0.0
                if options.judge and not steers:
                    with tempfile.TemporaryDirectory() as name:
                        path_um = 1e3 * path_error(options, text, result["samples"], axes, options.period, pathlib.Path(name))["path_error_mm"]
                tell = [figures.get("splinefeed-tp." + n, 0) for n in ("mean-us", "max-us", "urgent", "late")]
                took, of_tool = f"{used[0]:.3f}", f"{tool_s:.3f}"
                if options.stops:
                    stood, lines = standing(result["samples"], axes, options.period)
                    with tempfile.TemporaryDirectory() as name:
                        stopping_s = tool_time(options, with_stops(text, lines), axes, pathlib.Path(name))
                    took, of_tool = f"{took}, {stood:.3f} without motion", f"{of_tool}, {stopping_s:.3f} with {len(lines)} stops"
                row += [took, of_tool, f"{path_um:.1f}", *(f"{u:.5f}" for u in used[1:]), f"{tell[0]:.1f}", f"{tell[1]:.0f}",
                        *map(str, tell[2:]), controller_us(result["samples"], len(axes))]
                if not any(what == "abort" for _, what, _ in actions):
                    end = ends.setdefault(program, result["position"])
                else:
                    end = [0.0] * 3 # of the moves by hand
                if max(abs(a - b) for a, b in zip(end, result["position"])) > 1e-6:
                    problem += f" it ends at {result['position'][:len(axes)]} and not at {end[:len(axes)]}"
                if ours and max(used[1:]) > 1.0001:
                    problem += " a limit is exceeded"
                if ours and tell[3]:
                    problem += " a period without motion"
                if options.indexer:
                    problem += indexer_problem(result["samples"], axes)
                if options.step:
                    problem += step_problem(result["samples"], axes)
                if options.back:
                    wrong, path_um = back_problem(result["samples"], axes, result["said"])
                    problem, row[4] = result["problem"] + wrong, f"{path_um:.1f}"
                if options.refused:
                    went_on = used[0] > 0.0 or result["samples"][:, len(axes) + OTHERS.index("digital-out-00")].any()
                    problem = f"it went on: {problem}" if went_on else "" if options.refused in problem else f"it says: {problem}"
                if options.keep:
                    options.keep.mkdir(exist_ok=True)
                    result["samples"].tofile(options.keep / f"{program.stem}.{planner}.{seed}.bin")
                    (options.keep / f"{program.stem}.{planner}.{seed}.json").write_text(
                        json.dumps({k: v for k, v in result.items() if k != "samples"} | {"actions": actions}))
            print("| " + " | ".join(row + ["-"] * (13 - len(row)) + [problem]) + " |", flush=True)
            failed += 1 if problem and ours else 0
    return 1 if options.check and failed else 0


if __name__ == "__main__":
    sys.exit(main())
