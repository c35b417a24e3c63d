# SPDX-License-Identifier: MIT
"""What a host that stands still spoils by itself: runs in real time are judged where the host kept time."""
import dataclasses
import os
import signal
import subprocess
import threading
import time
import tty

STOOD_STILL_S = 0.005  # a wake-up so late makes a line's answers late
DELAYS = 4  # a message passes so many processes, each of which may be woken late
ATTEMPTS = 3


class OffTime(str):
    """A problem of the instants at which things happened, which a host that stands still for stall_s may cause; all others are
    to be had on any host."""

    def __new__(cls, text, stall_s=STOOD_STILL_S):
        problem = super().__new__(cls, text)
        problem.stall_s = stall_s
        return problem

    @classmethod
    def off_path(cls, worst_mm, stated_mm, speed_mm_s):
        """The excess is what the axes move while a message is late: a shorter stall does not excuse it."""
        return cls(f"the shafts leave the planned path by {worst_mm:.6f} mm; {stated_mm} mm are stated",
                   max(0.001, (worst_mm - stated_mm) / speed_mm_s / DELAYS))

    @classmethod
    def too_long(cls, took_s, stated_s, what):
        """The excess is what messages were late by: a shorter stall does not excuse it."""
        return cls(f"{took_s:.3f} s {what}, stated {stated_s}", max(0.001, (took_s - stated_s) / DELAYS))


class HostStoodStill(str):
    """What was off time while nothing else was wrong, on a host that stood still meanwhile."""


class HostWatch:
    """While it is entered: by how much [s] a wake-up each other millisecond came late at most, on any processor, or a byte through a
    pseudo-terminal. On a processor that stands still a drive or a cable waits, while a process that may go to another one notices
    nothing. And serial lines are pseudo-terminals here: a thread of the kernel passes their bytes on, which has to wait for its turn, too."""

    PERIOD_S = 0.002

    def __init__(self):
        self.late_s = dict.fromkeys([*os.sched_getaffinity(0), "line"], 0.0)
        self.ends = threading.Event()
        self.threads = [threading.Thread(target=self.watch, args=(cpu,), daemon=True) for cpu in os.sched_getaffinity(0)]
        self.threads.append(threading.Thread(target=self.watch_line, daemon=True))

    @property
    def longest_s(self):
        return max(self.late_s.values())

    def watch(self, cpu):
        os.sched_setaffinity(threading.get_native_id(), {cpu})
        while not self.ends.is_set():
            before = time.monotonic()
            time.sleep(self.PERIOD_S)
            self.late_s[cpu] = max(self.late_s[cpu], time.monotonic() - before - self.PERIOD_S)

    def watch_line(self):
        ours, theirs = os.openpty()
        tty.setraw(theirs)
        while not self.ends.is_set():
            before = time.monotonic()
            os.write(ours, b"u")
            os.read(theirs, 1)
            self.late_s["line"] = max(self.late_s["line"], time.monotonic() - before)
            time.sleep(self.PERIOD_S)
        os.close(ours)
        os.close(theirs)

    def __enter__(self):
        for thread in self.threads:
            thread.start()
        return self

    def __exit__(self, *_):
        self.ends.set()
        for thread in self.threads:
            thread.join()


@dataclasses.dataclass
class Call:
    """How a call of the tool ended, and how late the host was at most meanwhile."""
    status: int
    output: str
    errors: str
    stood_still_s: float

    def excused(self, problems):
        """They as they are, but where all of them are of time and the host stood still for long enough to explain each. How long it
        did is measured here; what the tool says of time excuses nothing."""
        if not all(isinstance(problem, OffTime) and self.stood_still_s >= problem.stall_s for problem in problems):
            return problems
        return [HostStoodStill(f"{problem}; this host stood still for {1000 * self.stood_still_s:.1f} ms") for problem in problems]


def called(command, folder, stall_s=0.0):
    """Runs it to its end. It is made to stand still for stall_s, twice on its way."""
    with HostWatch() as watch, subprocess.Popen(command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                                text=True) as process:
        for _ in range(2 if stall_s else 0):
            time.sleep(1.7)
            process.send_signal(signal.SIGSTOP)
            time.sleep(stall_s)
            process.send_signal(signal.SIGCONT)  # which holds the machine,
            time.sleep(0.1)
            process.send_signal(signal.SIGUSR2)  # until its user resumes it
        try:
            output, errors = process.communicate(timeout=600)
        except subprocess.TimeoutExpired:
            process.kill()
            raise
    print(f"this host stood still for {1000 * watch.longest_s:.1f} ms at most")
    return Call(process.returncode, output, errors, watch.longest_s)


def exit_status(attempt):
    """Of a test. attempt() makes a run and returns its problems; it is made again where the host is to blame for all of them.
    77, skipped: the host never kept time, so that nothing can be said of ours."""
    for _ in range(ATTEMPTS):
        problems = attempt()
        for problem in problems:
            print(problem)
        if not problems:
            return 0
        if not all(isinstance(problem, HostStoodStill) for problem in problems):
            return 1
    print(f"SKIPPED: this host did not keep time, {ATTEMPTS} times: no run in real time can be judged on it")
    return 77
