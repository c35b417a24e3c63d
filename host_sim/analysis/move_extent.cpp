// SPDX-License-Identifier: MIT
#include "host_sim/analysis/move_extent.hpp"

#include "host_sim/program/element_shapes.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

namespace {

constexpr double chord_unit_mm = 1.0 / 4096.0;
constexpr int chords = 64;

} // namespace

void AxisBox::add(unsigned axis, double from, double to) noexcept {
    low[axis] = std::min({low[axis], from, to});
    high[axis] = std::max({high[axis], from, to});
}

void add_extent(const PerAxis<Position>& from, const PathElement<double>& move, int axes, AxisBox& box) noexcept {
    if (box.empty) {
        for (const unsigned k : indices(axes)) {
            box.low[k] = box.high[k] = to_mm(from[k]);
        }
        box.empty = false;
    }
    for (const unsigned k : indices(axes)) {
        box.add(k, to_mm(from[k]), to_mm(move.to[k]));
        if (move.shape == MoveShape::bezier) {
            for (unsigned i = 1; i < static_cast<unsigned>(move.bezier.degree); ++i) {
                const double value = to_mm(from[k]) + move.bezier.points[k][i] * chord_unit_mm;
                box.add(k, value, value);
            }
        }
    }
    if (move.shape == MoveShape::arc) {
        const ProgrammedArc arc = arc_of(from, move, axes);
        for (const unsigned k : indices(std::min(axes, 3))) {
            const auto [low, high] = arc.range(k);
            box.add(k, low, high);
        }
    }
}

double move_length(const PerAxis<Position>& from, const PathElement<double>& move, int axes,
                   const PerAxis<bool>& counts) noexcept {
    const auto count = static_cast<unsigned>(axes);
    if (move.shape == MoveShape::arc) {
        double others_sq = 0.0;
        for (unsigned k = 3; k < count; ++k) {
            const double d = to_mm(move.to[k]) - to_mm(from[k]);
            others_sq += counts[k] ? d * d : 0.0;
        }
        return arc_of(from, move, axes).length(others_sq);
    }
    double length = 0.0;
    const int parts = move.shape == MoveShape::bezier ? chords : 1;
    PerAxis<double> last{};
    for (int part = 1; part <= parts; ++part) {
        double sq = 0.0;
        for (unsigned k = 0; k < count; ++k) {
            double place = to_mm(move.to[k]) - to_mm(from[k]);
            if (parts > 1 && part < parts) { // de Casteljau
                const double t = static_cast<double>(part) / parts;
                auto points = move.bezier.points[k];
                for (int left = move.bezier.degree; left > 0; --left) {
                    for (const unsigned i : indices(left)) {
                        points[i] += t * (points[i + 1] - points[i]);
                    }
                }
                place = points[0] * chord_unit_mm;
            }
            sq += counts[k] ? (place - last[k]) * (place - last[k]) : 0.0;
            last[k] = place;
        }
        length += std::sqrt(sq);
    }
    return length;
}

} // namespace splinefeed::host
