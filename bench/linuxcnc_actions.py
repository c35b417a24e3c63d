# SPDX-License-Identifier: MIT
"""What an operator does at random times while LinuxCNC runs a program, for bench/linuxcnc_driver.py."""
import random


def random_actions(seed, seconds):
    chance = random.Random(seed)
    actions, t = [], 0.0
    for _ in range(chance.randint(2, 10)):
        t += chance.uniform(0.02, 0.3 * seconds)
        what = chance.choice(["hold", "step", "override", "rapid", "limit", "adaptive"])
        value = {"override": chance.choice([0.0, 0.3, 1.2, 2.0, chance.uniform(0.1, 2.0)]), "rapid": chance.uniform(0.1, 1.0),
                 "limit": chance.uniform(5.0, 150.0), "adaptive": chance.uniform(0.0, 1.0)}.get(what, 0)
        actions.append([t, what, value])
        if what in ("hold", "step"):
            t += chance.uniform(0.01, 0.4)
            actions.append([t, "resume", 0])
            if what == "step": # it only steps a program that pauses
                actions[-2][1] = "hold"
                actions.insert(-1, [t - 0.005, "step", 0])
        elif value < 0.05:
            t += chance.uniform(0.1, 0.4)
            actions.append([t, what, 1.0])
    actions += [[t + 0.05, "resume", 0], [t + 0.06, "override", 1.0], [t + 0.07, "adaptive", 1.0], [t + 0.08, "limit", 1000.0]]
    if chance.random() < 0.33:
        t += chance.uniform(0.05, 0.2 * seconds)
        actions += [[t, "abort", 0], [t + 0.01, "mdi", "G1 X1 Y2 Z3 F3000"], [t + 0.02, "mdi", "G0 X0 Y0 Z0"]]
    return actions
