# SPDX-License-Identifier: MIT
"""What the samples of a run in LinuxCNC say, a row a servo period: the axes, and OTHERS behind them."""
import pathlib
import re

VELOCITY, ACCELERATION = 100.0, 1000.0
OTHERS = ["current-vel", "program-line", "in-position", "digital-out-00", "controller-clocks"]  # columns behind the axes


def limits_used(samples, axes, period_us, jerk):
    """Cycle time, and the largest use of velocity, acceleration and jerk."""
    import numpy

    q = samples[:, : len(axes)]
    moved = numpy.flatnonzero(numpy.abs(numpy.diff(q, axis=0)).max(axis=1) > 1e-9)
    if len(moved) == 0:
        return 0.0, 0.0, 0.0, 0.0
    t = period_us * 1e-6
    peak = [numpy.abs(numpy.diff(q, n, axis=0)).max() / t**n for n in (1, 2, 3)]
    return (moved[-1] - moved[0] + 1) * t, peak[0] / VELOCITY, peak[1] / ACCELERATION, peak[2] / jerk if jerk else 0.0


def controller_us(samples, axes):
    """What LinuxCNC's motion-controller took as a whole, in periods with motion: the mean, and 99.9 per cent take less."""
    import numpy

    moving = numpy.flatnonzero(numpy.abs(numpy.diff(samples[:, :axes], axis=0)).max(axis=1) > 0) + 1
    mhz = re.search(r"cpu MHz\s*:\s*([\d.]+)", pathlib.Path("/proc/cpuinfo").read_text())
    if len(moving) == 0 or not mhz:
        return "-"
    took = samples[moving, -1] / float(mhz[1])
    return f"{took.mean():.1f}, {numpy.quantile(took, 0.999):.0f}"


def indexer_problem(samples, axes):
    import numpy

    moves = numpy.abs(numpy.diff(samples[:, : len(axes)], axis=0)) > 1e-9
    unlocked = samples[1:, len(axes) + OTHERS.index("digital-out-00")] != 0
    a = axes.index("A")
    return ("" if unlocked.any() and moves[:, a].any() else " the indexer was not unlocked") + (
        " it moves while it is locked" if (moves[:, a] & ~unlocked).any() else "") + (
        " another axis moves beside it" if (numpy.delete(moves, a, 1).any(axis=1) & unlocked).any() else "")


def step_problem(samples, axes):
    import numpy

    q = samples[:, : len(axes)]
    begins = numpy.flatnonzero(numpy.abs(numpy.diff(q, axis=0)).max(axis=1) > 1e-9)
    stands = q[begins[:-1][numpy.diff(begins) > 100] + 1] # of 100 periods; the first is the pause
    off = numpy.abs(stands[1:] - numpy.round(stands[1:])).max(axis=1) > 1e-3
    return ("" if len(stands) == 5 else f" it stood {len(stands)} times") + "".join(f" a step ends at {place}" for place in stands[1:][off])


def back_problem(samples, axes, said):
    """What is wrong with a run that goes back to where it began, and how far the way back is from the way there, in um."""
    import numpy

    q = samples[:, : len(axes)]
    away = numpy.linalg.norm(q - q[0], axis=1)
    left = numpy.flatnonzero(away > 1.0)
    came = left[0] + numpy.flatnonzero(away[left[0] :] < 1e-6) if len(left) else []
    if len(came) == 0:
        return " it did not come back to where it began", 0.0
    step = numpy.abs(numpy.diff(q[left[0] : came[0]], axis=0)).max(axis=1)
    turn = left[0] + int(step.argmin())
    a, b = q[:turn], q[1 : turn + 1]
    way, worst = b - a, 0.0
    for place in q[turn : came[0] + 1 : 7]:
        along = numpy.clip(((place - a) * way).sum(axis=1) / numpy.maximum((way**2).sum(axis=1), 1e-30), 0.0, 1.0)
        worst = max(worst, numpy.linalg.norm(a + along[:, None] * way - place, axis=1).min())
    problem = "" if worst < 0.001 else f" the way back is {1e3 * worst:.1f} um from the way there"
    return problem + ("" if said == ["splinefeed_tp: the way back ends here"] else f" it says {said}"), 1e3 * worst


def standing(samples, axes, period_us):
    """Time without motion between the first and the last motion, and the lines that begin behind it."""
    import numpy

    moves = numpy.abs(numpy.diff(samples[:, : len(axes)], axis=0)).max(axis=1) > 1e-9
    moved = numpy.flatnonzero(moves)
    if len(moved) == 0:
        return 0.0, []
    within = moves[moved[0] : moved[-1] + 1]
    begins = numpy.minimum(numpy.flatnonzero(~within[:-1] & within[1:]) + moved[0] + 5, len(samples) - 1)  # the line is told later
    lines = samples[begins, len(axes) + OTHERS.index("program-line")].astype(int)
    return float((~within).sum()) * period_us * 1e-6, sorted(set(lines.tolist()))
