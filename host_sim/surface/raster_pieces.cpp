// SPDX-License-Identifier: MIT
#include "host_sim/surface/raster.hpp"

#include "splinefeed/splines/knot_insertion.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

namespace {

using PathPiece = BezierPiece<double>;

// The part of a piece from a to b, fractions of it, by two cuts of de Casteljau.
PathPiece between(PathPiece piece, double a, double b) {
    const auto n = static_cast<unsigned>(piece.degree);
    const auto cut = [n](PerDegree<double>& row, double t, bool keep_left) {
        PerDegree<double> left{};
        left[0] = row[0];
        for (unsigned step = 1; step <= n; ++step) {
            for (unsigned i = 0; i + step <= n; ++i) {
                row[i] += t * (row[i + 1] - row[i]);
            }
            left[step] = row[0];
        }
        if (keep_left) {
            row = left;
        }
    };
    for (PerDegree<double>& row : piece.control) {
        if (b < 1.0) {
            cut(row, b, true);
        }
        if (a > 0.0) {
            cut(row, a / b, false);
        }
    }
    return piece;
}

PathPiece reversed(const PathPiece& piece) {
    PathPiece out;
    out.degree = piece.degree;
    for (int i = 0; i <= piece.degree; ++i) {
        out.set_point(i, piece.point(piece.degree - i));
    }
    return out;
}

// An iso-parametric line of the surface itself, from parameter `from` to `to`.
std::vector<PathPiece> exact(const ToolSurface& surface, const CellInterval& stretch) {
    const BSplineSurface<double>& view = surface.view();
    const bool u = (stretch.kind == CellInterval::Kind::along) == (surface.options().along == SurfaceDirection::u);
    const std::span<const double> knots = u ? view.knots_u : view.knots_v;
    const int degree = u ? view.degree_u : view.degree_v;
    std::vector<Point<double>> controls(u ? view.count_u() : view.count_v());
    require(iso_curve<double>(view, u ? SurfaceDirection::u : SurfaceDirection::v, stretch.constant, controls));
    std::vector<PathPiece> all(bezier_piece_count<double>(knots, degree));
    std::vector<double> breaks(all.size() + 1);
    require(bezier_pieces<double>(knots, degree, controls, 3, false, all, breaks));
    const double low = std::min(stretch.from, stretch.to);
    const double high = std::max(stretch.from, stretch.to);
    std::vector<PathPiece> out;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double length = breaks[i + 1] - breaks[i];
        const double a = std::max(0.0, (low - breaks[i]) / length);
        const double b = std::min(1.0, (high - breaks[i]) / length);
        if (a < b) {
            out.push_back(between(all[i], a, b));
        }
    }
    if (stretch.from > stretch.to) {
        std::reverse(out.begin(), out.end());
        std::ranges::transform(out, out.begin(), reversed);
    }
    return out;
}

// Derivative of the tool's place by the parameter, from three places inside the stretch: error of second order.
Point<double> slope(const ToolSurface& surface, const CellInterval& stretch, double t) {
    const double low = std::min(stretch.from, stretch.to);
    const double high = std::max(stretch.from, stretch.to);
    const double h = 1e-5 * (high - low);
    const auto at = [&](double s) {
        return stretch.kind == CellInterval::Kind::along ? surface.tool(s, stretch.constant)
                                                         : surface.tool(stretch.constant, s);
    };
    const double side = t - h < low ? 1.0 : t + h > high ? -1.0 : 0.0;
    Point<double> out{};
    const Point<double> a = at(side == 0.0 ? t - h : t);
    const Point<double> b = at(side == 0.0 ? t + h : t + side * h);
    const Point<double> c = side == 0.0 ? b : at(t + 2.0 * side * h);
    for (std::size_t k = 0; k < 3; ++k) {
        out[k] = side == 0.0 ? (b[k] - a[k]) / (2.0 * h) : side * (4.0 * b[k] - 3.0 * a[k] - c[k]) / (2.0 * h);
    }
    return out;
}

} // namespace

std::vector<BezierPiece<double>> pieces(const ToolSurface& surface, const std::vector<CellInterval>& path) {
    constexpr double no_length_mm = 1e-9;
    std::vector<PathPiece> out;
    const auto add = [&out](const PathPiece& piece) {
        for (int i = 1; i <= piece.degree; ++i) {
            for (std::size_t k = 0; k < 3; ++k) {
                if (std::fabs(piece.point(i)[k] - piece.point(0)[k]) > no_length_mm) {
                    out.push_back(piece);
                    if (out.size() > 1) { // joints are the same numbers: the iso-lines of both directions round apart
                        out.back().set_point(0, out[out.size() - 2].point(out[out.size() - 2].degree));
                    }
                    return;
                }
            }
        }
    };
    for (const CellInterval& stretch : path) {
        if (stretch.kind == CellInterval::Kind::straight) {
            PathPiece line;
            line.degree = 1;
            line.set_point(0, stretch.start);
            line.set_point(1, stretch.end);
            add(line);
        } else if (!(surface.options().ball_radius_mm > 0.0)) {
            for (const PathPiece& piece : exact(surface, stretch)) {
                add(piece);
            }
        } else {
            const std::vector<double> at = stretch_parameters(surface, stretch);
            for (std::size_t i = 0; i + 1 < at.size(); ++i) {
                const bool along = stretch.kind == CellInterval::Kind::along;
                const Point<double> from =
                    along ? surface.tool(at[i], stretch.constant) : surface.tool(stretch.constant, at[i]);
                const Point<double> to =
                    along ? surface.tool(at[i + 1], stretch.constant) : surface.tool(stretch.constant, at[i + 1]);
                const Point<double> leave = slope(surface, stretch, at[i]);
                const Point<double> arrive = slope(surface, stretch, at[i + 1]);
                const double third = (at[i + 1] - at[i]) / 3.0;
                PathPiece piece;
                piece.degree = 3;
                Point<double> second = from;
                Point<double> before = to;
                for (std::size_t k = 0; k < 3; ++k) {
                    second[k] += third * leave[k];
                    before[k] -= third * arrive[k];
                }
                piece.set_point(0, from);
                piece.set_point(1, second);
                piece.set_point(2, before);
                piece.set_point(3, to);
                add(piece);
            }
        }
    }
    return out;
}

} // namespace splinefeed::host
