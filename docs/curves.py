#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws every curve method on the same points, with curvature combs, as SVG.

    docs/curves.py build/release/bin/splinefeed > docs/curves.svg

A tooth of the comb is normal to the curve and as long as the curvature there: a step in the comb is a step in the
curvature, which a machine feels as a jerk. Python's standard library only.
"""
import json
import math
import subprocess
import sys
import tempfile

POINTS = [(0, 0), (8, 20), (26, 26), (36, 14), (41, 11), (47, 14), (60, 30), (78, 26), (84, 2), (100, 8)]
PANELS = [  # title, options, what is measured at the joints
    ("g2", "--corner-angle 180"),
    ("g2-bezier, beta2 = 8", "--curve g2-bezier --beta2 8 --corner-angle 180"),
    ("catmull-rom", "--curve catmull-rom --corner-angle 180"),
    ("catmull-rom --smooth", "--curve catmull-rom --smooth --corner-angle 180"),
    ("catmull-rom-modified", "--curve catmull-rom-modified --corner-angle 180"),
    ("bspline (points are control points)", "--curve bspline --corner-angle 180"),
    ("bspline-interpolation, degree 5", "--curve bspline-interpolation --degree 5"),
    ("ferguson", "--curve ferguson"),
    ("ferguson, curvature sign -1, mu = 8", "--curve ferguson --curvature-sign -1 --mu 8"),
    ("beta-chain, beta1 = 1, beta2 = 4", "--curve beta-chain --beta2 4"),
    ("polyline", "--curve polyline"),
]
WIDTH, HEIGHT, COLUMNS = 320, 210, 3
SCALE, TOOTH = 2.6, 60.0  # pixels a mm, mm of tooth for a curvature of 1/mm
PER_SEGMENT = 36


def jet(points, u):
    """Point and two derivatives of a Bezier segment."""
    n = len(points) - 1
    levels = [points]
    while len(levels[-1]) > 1:
        last = levels[-1]
        levels.append([tuple(a + u * (b - a) for a, b in zip(p, q)) for p, q in zip(last, last[1:])])
    first = tuple(n * (b - a) for a, b in zip(*levels[n - 1]))
    second = (0.0, 0.0)
    if n > 1:
        a, b, c = levels[n - 2]
        second = tuple(n * (n - 1) * (x - 2 * y + z) for x, y, z in zip(a, b, c))
    return levels[n][0], first, second


def panel(tool, csv, title, options, left, top):
    made = subprocess.run([tool, "curve", csv, *options.split(), "--scalar", "double"], capture_output=True, text=True,
                          check=True).stdout

    def at(p):
        return f"{left + 30 + SCALE * p[0]:.1f},{top + 140 - SCALE * p[1]:.1f}"

    curve, teeth, tips = [], [], []
    for segment in json.loads(made)["segments"]:
        points = [tuple(p[:2]) for p in segment["control_points"]]
        tips.append([])
        for i in range(PER_SEGMENT + 1):
            p, d, dd = jet(points, i / PER_SEGMENT)
            curve.append(at(p))
            speed = math.hypot(*d)
            if speed > 1e-9:
                kappa = (d[0] * dd[1] - d[1] * dd[0]) / speed**3
                kappa = max(-0.5, min(0.5, kappa))  # a cusp would fill the page
                tip = (p[0] + TOOTH * kappa * d[1] / speed, p[1] - TOOTH * kappa * d[0] / speed)
                tips[-1].append(at(tip))
                if i % 3 == 0:
                    teeth.append(f"M{at(p)}L{at(tip)}")
    out = [f'<text x="{left + 12}" y="{top + 18}" font-size="13">{title}</text>',
           f'<path d="{"".join(teeth)}" stroke="#e0a458" stroke-width="0.6" fill="none"/>']
    for run in tips:
        out.append(f'<polyline points="{" ".join(run)}" fill="none" stroke="#d1495b" stroke-width="0.9"/>')
    out.append(f'<polyline points="{" ".join(curve)}" fill="none" stroke="#2a4d6e" stroke-width="1.8"/>')
    out += [f'<circle cx="{c.split(",")[0]}" cy="{c.split(",")[1]}" r="2.6" fill="#222"/>' for c in map(at, POINTS)]
    return out


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    rows = -(-len(PANELS) // COLUMNS)
    size = f"{WIDTH * COLUMNS} {HEIGHT * rows}"
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size}" font-family="sans-serif">',
           '<rect width="100%" height="100%" fill="white"/>']
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as csv:
        csv.write("\n".join(f"{x},{y}" for x, y in POINTS) + "\n")
        csv.flush()
        for i, (title, options) in enumerate(PANELS):
            out.append("<g>")
            out += panel(sys.argv[1], csv.name, title, options, WIDTH * (i % COLUMNS), HEIGHT * (i // COLUMNS))
            out.append("</g>")
    print("\n".join(out + ["</svg>"]))


if __name__ == "__main__":
    main()
