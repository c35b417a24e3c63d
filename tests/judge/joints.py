# SPDX-License-Identifier: MIT
"""Joints: how well the pieces of a curve fit together."""
import numpy as np

FLAT_1_MM = 1e-3  # curvatures below this count as this: a jump relative to nothing says nothing
CORNER_RAD = 1e-3  # where the direction jumps by more the machine stops, and curvature does not matter


def joint_jumps(chain):
    """The largest gap [mm], turn of the tangent [rad] and jump of the curvature vector (relative, and in 1/mm) over the joints.

    A joint that turns by more than CORNER_RAD is a corner: it is counted, and its turn and curvature are not judged."""
    gap = turn = curvature = relative = 0.0
    corners = 0
    pairs = list(zip(chain.pieces, chain.pieces[1:]))
    if chain.closed:
        pairs.append((chain.pieces[-1], chain.pieces[0]))
    for before, after in pairs:
        end, t0, k0, _, _ = before.along(1.0)
        start, t1, k1, _, _ = after.along(0.0)
        gap = max(gap, float(np.linalg.norm(start - end)))
        here = float(np.linalg.norm(t1 - t0))
        if here > CORNER_RAD:
            corners += 1
            continue
        turn = max(turn, here)
        size = max(FLAT_1_MM, np.linalg.norm(k0), np.linalg.norm(k1))
        jump = float(np.linalg.norm(k1 - k0))
        curvature, relative = max(curvature, jump), max(relative, jump / size)
    return {"gap_mm": gap, "turn_rad": turn, "curvature_jump": relative, "curvature_jump_1_mm": curvature, "corners": corners}
