# SPDX-License-Identifier: MIT
"""splinefeed turns waypoints and G-code into smooth motion of machines with one to six axes.

    >>> import splinefeed
    >>> machine = splinefeed.Machine("xy", max_feed_mm_s=100, max_velocity_mm_s=100, max_acceleration_mm_s2=1000)
    >>> motion = splinefeed.plan([[0, 0], [10, 5], [20, 0], [30, 5], [40, 0]], machine)
    >>> motion.time
    0.602

Lengths are in mm, angles of rotary axes in degrees, times in seconds. Arrays of points and samples have the shape (n, axes).
"""
from ._curve import Curve, curve_names
from ._errors import Error, InputError, OutputError, SplinefeedWarning, UsageError
from ._machine import Machine
from ._motion import Motion, Samples, plan, plan_elements, plan_gcode
from ._native import version as __version__
from ._stream import Stream

__all__ = ["Curve", "Error", "InputError", "Machine", "Motion", "OutputError", "Samples", "SplinefeedWarning", "Stream",
           "UsageError", "curve_names", "plan", "plan_elements", "plan_gcode", "__version__"]
