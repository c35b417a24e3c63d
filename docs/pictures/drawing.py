# SPDX-License-Identifier: MIT
"""What all pictures share: colours, text, and a frame with scales. Python's standard library only."""
import math

# Okabe and Ito's colours, which colour-blind people can tell apart.
BLACK, ORANGE, SKY, GREEN, BLUE, VERMILLION, PURPLE = "#000000", "#e69f00", "#56b4e9", "#009e73", "#0072b2", "#d55e00", "#cc79a7"
GREY, FRAME, GRID = "#555555", "#999999", "#e4e4e4"


def document(width, height, body):
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif">'
    return "\n".join([head, f'<rect width="{width}" height="{height}" fill="white"/>', *body, "</svg>"])


def text(x, y, content, anchor="start", colour="#222222", size=12, bold=False):
    weight = ' font-weight="bold"' if bold else ""
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}" fill="{colour}" font-size="{size}"{weight}>{content}</text>'


def line(points, colour, width=1.4, dash=""):
    path = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
    style = f' stroke-dasharray="{dash}"' if dash else ""
    return f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{width}" stroke-linejoin="round"{style}/>'


def thinned(points, off=0.15):
    """The points of a line without those that lie on it to a fraction of a pixel."""
    kept = points[:1]
    for (x, y), (x1, y1) in zip(points[1:], points[2:]):
        x0, y0 = kept[-1]
        if abs((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)) > off * math.hypot(x1 - x0, y1 - y0) or math.hypot(x - x0, y - y0) > 6:
            kept.append((x, y))
    return kept + points[-1:]


def ticks(low, high, count=5):
    """Round numbers from low to high, about so many."""
    raw = (high - low) / count
    unit = 10.0 ** math.floor(math.log10(raw))
    step = unit * next(m for m in (1, 2, 5, 10) if m * unit >= raw * 0.999)
    return [i * step for i in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


class Frame:
    """A rectangle with a scale in each direction."""

    def __init__(self, box, xs, ys):
        self.box, (self.x0, self.x1), (self.y0, self.y1) = box, xs, ys

    def at(self, x, y):
        left, top, width, height = self.box
        return left + width * (x - self.x0) / (self.x1 - self.x0), top + height * (self.y1 - y) / (self.y1 - self.y0)

    def drawn(self, title, x_name="", count_y=4, count_x=6):
        """Frame, grid, numbers at both scales, title above."""
        left, top, width, height = self.box
        out = []
        for value in ticks(self.y0, self.y1, count_y):
            y = self.at(self.x0, value)[1]
            out += [line([(left, y), (left + width, y)], GRID, 1), text(left - 5, y + 4, f"{value:g}", "end", GREY, 11)]
        for value in ticks(self.x0, self.x1, count_x):
            x = self.at(value, self.y0)[0]
            out += [line([(x, top), (x, top + height)], GRID, 1)]
            if x_name:
                out.append(text(x, top + height + 14, f"{value:g}", "middle", GREY, 11))
        if x_name:
            out.append(text(left + width, top + height + 29, x_name, "end", GREY, 11))
        out.append(f'<rect x="{left}" y="{top}" width="{width}" height="{height}" fill="none" stroke="{FRAME}"/>')
        return out + [text(left, top - 7, title)]

    def curve(self, points, colour, width=1.4):
        return line(thinned([self.at(*p) for p in points]), colour, width)

    def limit(self, value, name=""):
        """A dashed line over the whole width, with its name at its right end."""
        (x0, y), (x1, _) = self.at(self.x0, value), self.at(self.x1, value)
        return [line([(x0, y), (x1, y)], BLACK, 1, "6 4")] + ([text(x1 - 4, y - 4, name, "end", BLACK, 10)] if name else [])


def legend(x, y, entries, step):
    """Short lines with their names, one after the other."""
    out = []
    for i, (name, colour, dash) in enumerate(entries):
        left = x + i * step
        out += [line([(left, y - 4), (left + 22, y - 4)], colour, 2.5 if not dash else 1, dash), text(left + 28, y, name)]
    return out
