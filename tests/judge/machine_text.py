# SPDX-License-Identifier: MIT
"""A machine file of equal axes."""


def machine_text(axes, feed, acceleration, jerk=None, head=""):
    """axes: a letter each; mm and s; jerk None: not limited. head: keys of [path]."""
    text = f'name = "measured"\nsample_period_us = 1000\n[path]\nmax_feed_mm_s = {feed}\n{head}'
    for name in axes:
        text += f'[[axis]]\nname = "{name}"\nmax_velocity_mm_s = {feed}\nmax_acceleration_mm_s2 = {acceleration}\n'
        text += "steps_per_mm = 320\n" + (f"max_jerk_mm_s3 = {jerk}\n" if jerk else "")
    return text
