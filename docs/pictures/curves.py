#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Draws every curve method on the same points, with curvature combs, as SVG.

    docs/pictures/curves.py build/release/bin/splinefeed > docs/pictures/curves.svg
    docs/pictures/curves.py build/release/bin/splinefeed --table build/release/bin > table.md      (with the benchmarks built)

A tooth of the comb is normal to the curve and as long as the curvature there: a step in the comb is a step in the
curvature, which a machine feels as a jerk. Python's standard library only.
"""
import json
import math
import subprocess
import sys
import tempfile

from drawing import BLACK, BLUE, FRAME, ORANGE, VERMILLION, document, legend, line, text, thinned

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
    ("beta-chain, degree 5, control points", "--curve beta-chain --degree 5"),
    ("polyline", "--curve polyline"),
]
WIDTH, HEIGHT, COLUMNS, TOP = 330, 214, 3, 44
SCALE, TOOTH = 2.2, 44.0  # pixels a mm, mm of tooth for a curvature of 1/mm
SHARPEST = 0.5            # per mm: longer teeth would leave the frame, and are cut
PER_SEGMENT = 60


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
        return left + 52 + SCALE * p[0], top + 136 - SCALE * p[1]

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
                kappa = max(-SHARPEST, min(SHARPEST, kappa))
                tip = (p[0] + TOOTH * kappa * d[1] / speed, p[1] - TOOTH * kappa * d[0] / speed)
                tips[-1].append(at(tip))
                if i % 5 == 0:
                    teeth.append("M{:.1f},{:.1f}L{:.1f},{:.1f}".format(*at(p), *at(tip)))
    for x, y in curve + [tip for run in tips for tip in run]:
        if not (left < x < left + WIDTH - 10 and top < y < top + HEIGHT - 10):
            sys.exit(f"{title}: the drawing leaves its frame at {x - left:.0f}, {y - top:.0f}")
    out = [f'<rect x="{left}" y="{top}" width="{WIDTH - 10}" height="{HEIGHT - 10}" fill="none" stroke="{FRAME}"/>',
           text(left + 8, top + 17, title, size=13),
           f'<path d="{"".join(teeth)}" stroke="{ORANGE}" stroke-width="0.6" fill="none"/>']
    out += [line(thinned(run), VERMILLION, 1) for run in tips if run]
    out.append(line(thinned(curve), BLUE, 2))
    return out + [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.6" fill="{BLACK}"/>' for x, y in map(at, POINTS)]


# method, what is proved of a joint, benchmark of its cost, when to use it
METHODS = [
    ("g2", "", "G2", "C2 in the knot parameter", "g2", "the default: smooth motion through points, endless input"),
    ("g2-bezier", "--beta2 8", "G2", "G2", "g2_bezier", "through points, with a tension that pulls the curve towards the chords"),
    ("catmull-rom", "", "G1", "C1 in the knot parameter", "catmull_rom", "local: a point changes only four segments; the curvature jumps at points"),
    ("catmull-rom", "--smooth", "G2", "G2", "catmull_rom_smooth", "local and G2: a point changes six segments, degree 5"),
    ("catmull-rom-modified", "", "G1", "C1 by chord length", "catmull_rom_modified",
     "local, unevenly spaced points"),
    ("bspline", "", "C2", "C2 (degree 2: C1)", "bspline", "the points are a control polygon; the curve stays in its hull"),
    ("bspline-interpolation", "--degree 3", "G2", "C^(k-1) in t", "interpolate_bspline<3>/1000", "any degree from 1 to 9; all points must be known"),
    ("bspline-interpolation", "--degree 5", "G2", "C^(k-1) in t", "interpolate_bspline<5>/1000", "cams and motions that are differentiated twice"),
    ("ferguson", "", "G2", "C2 at lambda 1, mu 0; otherwise G2", "ferguson_curve", "tangent length and tension of single joints; evenly spaced points"),
    ("ferguson", "--curvature-sign -1 --mu 8", "G1+|k|", "G1, only the modulus of the curvature", "ferguson_curve", "almost never: the curvature changes its sign at every point"),
    ("beta-chain", "--degree 5 --beta2 4", "G2", "G2 (order 1: G1)", "beta_chain_curve", "shapes drawn by hand; bias and tension for each joint"),
    ("polyline", "", "C0", "C0, a stop at each corner", "polyline", "straight lines"),
]
RANK = ["C0", "G1", "G1+|k|", "G2", "C2"]


def segments_of(tool, points, options):
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as csv:
        csv.write("\n".join(f"{x!r},{y!r}" for x, y in points) + "\n")
        csv.flush()
        made = subprocess.run([tool, "curve", csv.name, *options.split(), "--scalar", "double"], capture_output=True,
                              text=True, check=True).stdout
    return [[tuple(p[:2]) for p in s["control_points"]] for s in json.loads(made)["segments"]]


def least_class(curve):
    """The least of the joints' classes, by unit parameter."""
    least = len(RANK) - 1
    for before, after in zip(curve, curve[1:]):
        (_, a1, a2), (_, b1, b2) = jet(before, 1.0), jet(after, 0.0)
        na, nb = math.hypot(*a1), math.hypot(*b1)
        ka, kb = [(d[0] * dd[1] - d[1] * dd[0]) / n**3 for d, dd, n in ((a1, a2, na), (b1, b2, nb))]
        if math.hypot(a1[0] / na - b1[0] / nb, a1[1] / na - b1[1] / nb) > 1e-6:
            rank = 0
        elif abs(ka - kb) <= 1e-6 * (abs(ka) + 1e-3):
            same = math.hypot(a1[0] - b1[0], a1[1] - b1[1]) < 1e-9 * na and \
                math.hypot(a2[0] - b2[0], a2[1] - b2[1]) < 1e-7 * (math.hypot(*a2) + na)
            rank = 4 if same else 3
        else:
            rank = 2 if abs(abs(ka) - abs(kb)) <= 1e-6 * (abs(ka) + 1e-3) else 1
        least = min(least, rank)
    return RANK[least]


def moved(curve, other, least):
    count = 0
    for a, b in zip(curve, other):
        count += any(math.hypot(p[0] - q[0], p[1] - q[1]) > least for p, q in zip(a, b))
    return count


def miss(curve, points):
    worst = 0.0
    for point in points:
        def distance(segment, u):
            p = jet(segment, u)[0]
            return math.hypot(p[0] - point[0], p[1] - point[1])
        samples = sorted((distance(s, u / 32), i, u / 32) for i, s in enumerate(curve) for u in range(33))
        nearest = math.inf
        for _, i, u in samples[:4]:  # the nearest point may be on either side of a joint
            low, high = max(0.0, u - 1 / 32), min(1.0, u + 1 / 32)
            for _ in range(60):
                a, b = low + (high - low) / 3, high - (high - low) / 3
                low, high = (low, b) if distance(curve[i], a) < distance(curve[i], b) else (a, high)
            nearest = min(nearest, distance(curve[i], low))
        worst = max(worst, nearest)
    return worst


def costs(folder):
    out = {}
    for program in ("curve_bench", "interpolation_bench"):
        made = subprocess.run([f"{folder}/{program}", "--benchmark_format=json", "--benchmark_min_time=0.2"],
                              capture_output=True, text=True, check=True).stdout
        for row in json.loads(made)["benchmarks"]:
            out[row["name"].replace("<double>", "")] = 1e9 / row["items_per_second"]
    return out


def table(tool, folder):
    cost = costs(folder)
    points = [(2.5 * i + 0.3 * math.sin(2.0 * i), 10 * math.sin(0.35 * i) + 2 * math.sin(1.3 * i)) for i in range(39)]
    print("| method | continuity | measured at least | passes the points within | moving one point by 1 mm changes | "
          "ns a waypoint | when to use |")
    print("|---|---|---|---|---|---|---|")
    for name, options, expected, proved, bench, use in METHODS:
        both = f"--curve {name} {options}"
        if name in ("g2", "g2-bezier", "catmull-rom", "catmull-rom-modified", "bspline"):
            both += " --corner-angle 180"
        curve = segments_of(tool, points, both)
        changed = segments_of(tool, [(x, y + (i == 20)) for i, (x, y) in enumerate(points)], both)
        found = least_class(curve)
        if RANK.index(found) < RANK.index(expected):
            sys.exit(f"{name} {options}: joints are {found}, not {expected}")
        nearest = miss(curve, points)
        passes = "1 nm" if nearest < 1e-6 else "does not"
        some, many = moved(curve, changed, 1e-3), moved(curve, changed, 1e-12)
        reach = f"{many} segments" if some == many else f"{some} segments by more than 1 um"
        print(f"| `{name}{' ' + options if options else ''}` | {proved} | {found.replace('|', chr(92) + '|')} | {passes} | {reach} | "
              f"{cost.get(bench, math.nan):.0f} | {use} |")


def main():
    if len(sys.argv) == 4 and sys.argv[2] == "--table":
        table(sys.argv[1], sys.argv[3])
        return
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    tooth = TOOTH * SCALE
    out = legend(10, 24, [("curve", BLUE, ""), ("ends of the teeth", VERMILLION, "")], 80)
    out += [f'<circle cx="250" cy="20" r="2.6" fill="{BLACK}"/>', text(258, 24, "waypoint"),
            line([(340, 20), (340 + 0.1 * tooth, 20)], ORANGE, 2), text(346 + 0.1 * tooth, 24, "tooth of curvature 0.1/mm"),
            text(525, 24, f"(cut at {SHARPEST:g}/mm)"),
            line([(660, 20), (660 + 10 * SCALE, 20)], BLACK, 2), text(666 + 10 * SCALE, 24, "10 mm")]
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as csv, tempfile.NamedTemporaryFile("w", suffix=".csv") as nine:
        for file, points in ((csv, POINTS), (nine, POINTS[:9])):
            file.write("\n".join(f"{x},{y}" for x, y in points) + "\n")
            file.flush()
        for i, (title, options) in enumerate(PANELS):
            left, top = 10 + WIDTH * (i % COLUMNS), TOP + HEIGHT * (i // COLUMNS)
            # A chain of degree 5 takes 6 points and 3 for each further polygon: 9.
            out += panel(sys.argv[1], nine.name if "beta-chain" in options else csv.name, title, options, left, top)
    print(document(WIDTH * COLUMNS + 10, TOP + HEIGHT * -(-len(PANELS) // COLUMNS), out))


if __name__ == "__main__":
    main()
