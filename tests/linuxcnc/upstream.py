#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""LinuxCNC's own tests that start a machine, with its planner and with splinefeed_tp.so.

  tests/linuxcnc/upstream.py TREE MODULE [--only NAME]... [--planner stock,module] [--parameters "tolerance_um=50"] [--jobs 2] [--say]

TREE is a source tree of LinuxCNC, built to run in place. A test is a folder of TREE/tests whose test.sh starts LinuxCNC with an INI file of its
own that names motmod. Each runs by TREE's runtests on a copy of the tests, in name spaces of its own, as a user without rights. For the
module the copy's INI files have a TPMOD. A table is printed. The test fails where the module fails a test that the planner of LinuxCNC
passes, unless KNOWN says why.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

KNOWN = {
    "motion/g0": "it takes the acceleration from positions of six decimals: 99.99 of 100 inch/s^2 look like 101",
}
LIMIT_S = 300
INSIDE = """set -e
cd /
mount --bind "$1/tests" "$2/tests"
mount --bind "$1/rtlib" "$2/rtlib"
mkdir "$1/tmp"
chown -R 65534:65534 "$1/tests" "$1/rtlib" "$1/tmp" 2>/dev/null || true
mount --rbind "$1/tmp" /tmp
/usr/bin/python3 -c 'import fcntl, socket, struct
fcntl.ioctl(socket.socket(), 0x8914, struct.pack("16sh14x", b"lo", 0x1 | 0x40))'
cd "$2"
export HOME=/tmp PATH=/usr/sbin:/usr/bin:/sbin:/bin
run=(setpriv --no-new-privs timeout "$4" scripts/runtests -n -p -u "tests/$3")
if [ "$5" = root ]; then # rtapi_app refuses to run for root
    exec setpriv --reuid=65534 --regid=65534 --clear-groups "${run[@]}" < /dev/null
fi
exec unshare --user --map-user=65534 --map-group=65534 "${run[@]}" < /dev/null
"""


def machine_tests(tree):
    """The folders of such tests, below TREE/tests."""
    found = []
    for script in sorted((tree / "tests").rglob("test.sh")):
        folder = script.parent
        texts = [p.read_text(errors="replace") for p in folder.glob("*.ini")]
        if (re.search(r"^\s*(\w+ )*linuxcnc ", script.read_text(errors="replace"), re.M) and not (folder / "skip").exists()
                and any("[TRAJ]" in t and re.search(r"^EMCMOT\s*=\s*motmod", t, re.M) for t in texts)):
            found.append(str(folder.relative_to(tree / "tests")))
    return found


def with_module(text, parameters):
    """An INI file with the module as its planner."""
    axes = re.search(r"^COORDINATES\s*=\s*(.*)$", text, re.M)
    letters = "".join(dict.fromkeys(re.sub(r"[^XYZABCUVW]", "", axes[1].split("#")[0].upper()))) if axes else "XYZ"
    inch = re.search(r"^LINEAR_UNITS\s*=\s*in", text, re.M | re.I) is not None
    return text.replace("[TRAJ]\n", f"[TRAJ]\nTPMOD = splinefeed_tp axes={letters} inch={int(inch)} {parameters}\n", 1)


def run(tree, module, name, planner, parameters):
    """Whether the test passes, and what it says."""
    with tempfile.TemporaryDirectory(prefix="upstream-") as folder:
        copy = pathlib.Path(folder)
        shutil.copytree(tree / "tests", copy / "tests", symlinks=True)
        shutil.copytree(tree / "rtlib", copy / "rtlib")
        if planner == "module":
            shutil.copy(module, copy / "rtlib" / "splinefeed_tp.so")
            for ini in (copy / "tests" / name).rglob("*.ini"):
                ini.write_text(with_module(ini.read_text(errors="replace"), parameters))
        subprocess.run(["chmod", "-R", "a+rX", folder], check=True)
        root = os.getuid() == 0
        spaces = ["unshare", "--mount", "--ipc", "--net", "--pid", "--fork", "--mount-proc", "--kill-child"]
        spaces += [] if root else ["--user", "--map-root-user"]
        try:
            ran = subprocess.run([*spaces, "bash", "-c", INSIDE, "inside", folder, tree, name, str(LIMIT_S), "root" if root else "user"],
                                 capture_output=True, text=True, errors="replace", timeout=LIMIT_S + 60, check=False,
                                 env={k: v for k, v in os.environ.items() if k != "DISPLAY"})
        except subprocess.TimeoutExpired:
            return False, "no end"
        said = ran.stdout + ran.stderr
        return "1 successful, 0 failed" in said, said


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tree", type=pathlib.Path)
    parser.add_argument("module", type=pathlib.Path)
    parser.add_argument("--only", action="append")
    parser.add_argument("--planner", default="stock,module")
    parser.add_argument("--parameters", default="", help="more parameters of the module")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--say", action="store_true", help="what a failed test prints")
    options = parser.parse_args()
    tree = options.tree.resolve()
    names = [n for n in machine_tests(tree) if not options.only or n in options.only]
    planners = options.planner.split(",")
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as workers:
        jobs = {(n, p): workers.submit(run, tree, options.module.resolve(), n, p, options.parameters) for n in names for p in planners}
    passed = {key: job.result()[0] for key, job in jobs.items()}
    print("| test | " + " | ".join(planners) + " | |\n|---|" + "---|" * (len(planners) + 1))
    bad = 0
    for name in names:
        wrong = not passed.get((name, "module"), True) and passed.get((name, "stock"), True)
        bad += wrong and name not in KNOWN
        print(f"| {name} | " + " | ".join("passed" if passed[name, p] else "FAILED" for p in planners) + f" | {KNOWN.get(name, '')} |")
        for p in planners:
            if options.say and not passed[name, p]:
                print(jobs[name, p].result()[1], file=sys.stderr)
    for p in planners:
        print(f"{p}: {sum(passed[n, p] for n in names)} of {len(names)}")
    return 1 if bad or not names else 0


if __name__ == "__main__":
    sys.exit(main())
