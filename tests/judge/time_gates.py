# SPDX-License-Identifier: MIT
"""Plans held against times that are known without a planner, and against each other."""
from statistics import median

from known_motions import FORMS, KnownMotion
from monotone_pairs import SLOWER, monotone_pair
from planning import Refused
from straight_moves import StraightMove

KNOWN_SEEDS, STRAIGHT_SEEDS, MONOTONE_SEEDS = range(1, 31), range(1, 61), range(1, 101)
# Beyond these: those of some thousand others with which planners fell short once.
KNOWN_FOUND = (1019, 1078, 1186, 1259, 1276, 2285, 2404, 2656, 2821, 2864)
STRAIGHT_FOUND = (1000, 1020, 1025, 1148, 1191, 1195, 1217, 1291)
MONOTONE_FOUND = (1088, 1096, 1123, 1309, 1360, 1384)
# Of the known time: the median without what sampling costs, and not of those found; the worst with both.
KNOWN = {"curve": (1.01, 1.05), "elements": (1.01, 1.05), "g5": (1.01, 1.05)}
DECIMALS = 1.01  # what those of G5 may cost besides, at worst
# Without a jerk limit: the median and the worst of them all, both without what sampling costs.
KNOWN_WITHOUT_JERK = (1.0, 1.005)
STRAIGHT = 1.01  # of seven phases, and what sampling costs
# What falls short of these gates still, and may not become longer.
KNOWN_SHORT = {1019: 1.051, 1186: 1.13, 1259: 1.066, 1276: 1.2, 2656: 1.068}
STRAIGHT_SHORT = {9: 1.013}
STRAIGHT_REFUSED = {31}  # the rounding of positions alone is a third of its jerk limit
MONOTONE_SHORT = {92: 1.021, 1123: 1.005, 1360: 1.035, 1384: 1.027}


def known_ratios(tool, motion, folder):
    """{form: (time over the known one, the same without what sampling costs, its case)}; the ratios are None where the tool refuses, and the case is why."""
    found = {}
    for form, case in motion.cases(folder).items():
        try:
            planned = case.planned(tool)
            found[form] = (planned.seconds / motion.seconds, (planned.seconds - planned.sampling_s()) / motion.seconds, case)
        except Refused as refused:
            found[form] = (None, None, f"{case}: {refused}")
    return found


def known_problems(tool, folder):
    failed, rows = [], {form: [] for form in FORMS}
    for seed in (*KNOWN_SEEDS, *KNOWN_FOUND):
        motion = KnownMotion(seed)
        for form, row in known_ratios(tool, motion, folder).items():
            most = max(KNOWN[form][1], KNOWN_SHORT.get(seed, 1.0)) * (DECIMALS if form == "g5" else 1.0)
            rows[form].append((*row, seed))
            if row[0] is None or not row[0] <= most:
                failed.append(f"{'no plan' if row[0] is None else f'{row[0]:.4f}'} of the known {motion.seconds:.4f} s, not at most {most}: {row[2]}")
    for form, of_form in rows.items():
        planned = [row for row in of_form if row[0] is not None]
        middle, worst = median(row[1] for row in planned if row[3] in KNOWN_SEEDS), max(row[0] for row in planned)
        print(f"as {form}: {len(of_form)} motions, time without sampling over the known one {middle:.4f} in the median, at most {KNOWN[form][0]}; "
              f"time over the known one {worst:.4f} at most, {KNOWN[form][1]} but for {len(KNOWN_SHORT)} of them")
        if not middle <= KNOWN[form][0]:
            failed.append(f"median {middle:.4f} as {form}, not at most {KNOWN[form][0]}")
    return failed


def known_without_jerk_problems(tool, folder):
    failed, ratios = [], []
    for seed in KNOWN_SEEDS:
        motion = KnownMotion(seed, jerk=False)
        for planned, without_sampling, case in known_ratios(tool, motion, folder).values():
            if planned is None or not without_sampling <= KNOWN_WITHOUT_JERK[1]:
                failed.append(f"{'no plan' if planned is None else f'{without_sampling:.4f}'} of the known {motion.seconds:.4f} s, not at most {KNOWN_WITHOUT_JERK[1]}: {case}")
            if planned is not None:
                ratios.append(without_sampling)
    print(f"{len(ratios)} motions without a jerk limit, time without sampling over the known one {median(ratios):.4f} in the median, at most {KNOWN_WITHOUT_JERK[0]}; "
          f"{max(ratios):.4f} at most, at most {KNOWN_WITHOUT_JERK[1]}")
    if not median(ratios) <= KNOWN_WITHOUT_JERK[0]:
        failed.append(f"median {median(ratios):.4f}, not at most {KNOWN_WITHOUT_JERK[0]}")
    return failed


def straight_ratio(tool, move, case):
    """The time over that of seven phases; and by what factor it is longer than it may be."""
    planned = case.planned(tool)
    return planned.seconds / move.seconds, planned.seconds / (STRAIGHT * move.seconds + planned.sampling_s())


def straight_problems(tool, folder):
    failed, over = [], []
    for seed in (*STRAIGHT_SEEDS, *STRAIGHT_FOUND):
        move = StraightMove(seed)
        case = move.case(folder)
        try:
            ratio, excess = straight_ratio(tool, move, case)
        except Refused as refused:
            if seed not in STRAIGHT_REFUSED:
                failed.append(f"no plan, {refused}: {case}")
            continue
        over.append(ratio)
        if not excess <= STRAIGHT_SHORT.get(seed, 1.0):
            failed.append(f"{ratio:.4f} of seven phases of {move.seconds:.4f} s, {excess:.4f} of what is allowed: {case}")
    print(f"{len(over)} straight moves, time over that of seven phases {median(over):.4f} in the median, {max(over):.4f} at most; "
          f"{len(failed)} refused or longer than {STRAIGHT} and the sampling")
    return failed


def monotone_problems(tool, folder):
    failed, worst = [], 0.0
    for seed in (*MONOTONE_SEEDS, *MONOTONE_FOUND):
        pair = monotone_pair(seed, folder)
        try:
            first, second, allowed = pair.seconds(tool)
        except Refused as refused:
            failed.append(f"no plan, {refused}: pair {seed}")
            continue
        worst = max(worst, second / first)
        if not second <= max(allowed, MONOTONE_SHORT.get(seed, 1.0) * first):
            failed.append(f"{second / first:.4f} of the time, {first:.4f} -> {second:.4f} s, with {pair.says}: {pair.first} -> {pair.second}")
    print(f"{len(MONOTONE_SEEDS) + len(MONOTONE_FOUND)} pairs, the second time over the first {worst:.4f} at most; {len(failed)} longer than {SLOWER} and the sampling")
    return failed


TIME_GATES = {"known": known_problems, "known_without_jerk": known_without_jerk_problems, "straight": straight_problems, "monotone": monotone_problems}
