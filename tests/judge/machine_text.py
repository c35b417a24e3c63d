# SPDX-License-Identifier: MIT
"""Machine files: of equal axes, and of axes each with its own limits."""


def machine_text(axes, feed, acceleration, jerk=None, head=""):
    """axes: a letter each; mm and s; jerk None: not limited. head: keys of [path]."""
    text = f'name = "measured"\nsample_period_us = 1000\n[path]\nmax_feed_mm_s = {feed}\n{head}'
    for name in axes:
        text += f'[[axis]]\nname = "{name}"\nmax_velocity_mm_s = {feed}\nmax_acceleration_mm_s2 = {acceleration}\n'
        text += "steps_per_mm = 320\n" + (f"max_jerk_mm_s3 = {jerk}\n" if jerk else "")
    return text


def unequal_machine_text(limits, feed, period_us=1000):
    """limits: velocity, acceleration and jerk or None of each axis, from x on."""
    text = f'name = "measured"\nsample_period_us = {period_us}\n[path]\nmax_feed_mm_s = {feed!r}\n'
    for name, (velocity, acceleration, jerk) in zip("xyzabc", limits):
        text += f'[[axis]]\nname = "{name}"\nmax_velocity_mm_s = {velocity!r}\nmax_acceleration_mm_s2 = {acceleration!r}\n'
        text += f"max_jerk_mm_s3 = {jerk!r}\n" if jerk else ""
    return text
