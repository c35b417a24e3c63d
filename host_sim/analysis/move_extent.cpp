// SPDX-License-Identifier: MIT
#include "host_sim/analysis/move_extent.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace splinefeed::host {

namespace {

constexpr double chord_unit_mm = 1.0 / 4096.0;
constexpr int chords = 64;

// The way of an arc in the plane, as u cos + v sin about its centre.
struct ArcWay {
    std::array<double, 3> u{};
    std::array<double, 3> v{};
    double radius = 0.0;
    double rise_sq = 0.0;

    ArcWay(const PerAxis<Position>& from, const PathElement<double>& move) noexcept {
        const auto& n = move.arc.normal;
        double along = 0.0;
        double rise = 0.0;
        for (unsigned k = 0; k < 3; ++k) {
            u[k] = to_mm(from[k]) - to_mm(move.arc.centre[k]);
            along += u[k] * n[k];
            rise += (to_mm(move.to[k]) - to_mm(from[k])) * n[k];
        }
        for (unsigned k = 0; k < 3; ++k) {
            u[k] -= along * n[k];
        }
        for (unsigned k = 0; k < 3; ++k) {
            v[k] = n[(k + 1) % 3] * u[(k + 2) % 3] - n[(k + 2) % 3] * u[(k + 1) % 3];
        }
        radius = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
        rise_sq = rise * rise;
    }
};

void add_arc(const PerAxis<Position>& from, const PathElement<double>& move, int axes, AxisBox& box) noexcept {
    const ArcWay way(from, move);
    const double sweep = move.arc.sweep_rad;
    for (unsigned k = 0; k < static_cast<unsigned>(std::min(axes, 3)); ++k) {
        const double peak = std::hypot(way.u[k], way.v[k]);
        const double at = std::atan2(way.v[k], way.u[k]);
        for (const double side : {0.0, std::numbers::pi}) {
            // The first time that the angle is reached in the sense of the arc.
            const double turn = std::fmod(std::fmod(at + side, 2.0 * std::numbers::pi) + 2.0 * std::numbers::pi,
                                          2.0 * std::numbers::pi);
            const double angle = sweep >= 0.0 ? turn : 2.0 * std::numbers::pi - turn;
            if (angle <= std::fabs(sweep)) {
                const double share = sweep != 0.0 ? angle / std::fabs(sweep) : 0.0;
                // The centre's plane rises with the arc.
                const double start = to_mm(from[k]);
                const double base = start - way.u[k];
                const double end = to_mm(move.to[k]) - (way.u[k] * std::cos(sweep) + way.v[k] * std::sin(sweep));
                const double value = base + share * (end - base) + (side > 0.0 ? -peak : peak);
                box.add(k, value, value);
            }
        }
    }
}

} // namespace

void AxisBox::add(unsigned axis, double from, double to) noexcept {
    low[axis] = std::min({low[axis], from, to});
    high[axis] = std::max({high[axis], from, to});
}

void add_extent(const PerAxis<Position>& from, const PathElement<double>& move, int axes, AxisBox& box) noexcept {
    if (box.empty) {
        for (unsigned k = 0; k < static_cast<unsigned>(axes); ++k) {
            box.low[k] = box.high[k] = to_mm(from[k]);
        }
        box.empty = false;
    }
    for (unsigned k = 0; k < static_cast<unsigned>(axes); ++k) {
        box.add(k, to_mm(from[k]), to_mm(move.to[k]));
        if (move.shape == MoveShape::bezier) {
            for (unsigned i = 1; i < static_cast<unsigned>(move.bezier.degree); ++i) {
                const double value = to_mm(from[k]) + move.bezier.points[k][i] * chord_unit_mm;
                box.add(k, value, value);
            }
        }
    }
    if (move.shape == MoveShape::arc) {
        add_arc(from, move, axes, box);
    }
}

double move_length(const PerAxis<Position>& from, const PathElement<double>& move, int axes,
                   const PerAxis<bool>& counts) noexcept {
    const auto count = static_cast<unsigned>(axes);
    if (move.shape == MoveShape::arc) {
        const ArcWay way(from, move);
        double others_sq = way.rise_sq;
        for (unsigned k = 3; k < count; ++k) {
            const double d = to_mm(move.to[k]) - to_mm(from[k]);
            others_sq += counts[k] ? d * d : 0.0;
        }
        return std::sqrt(way.radius * way.radius * move.arc.sweep_rad * move.arc.sweep_rad + others_sq);
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
                    for (unsigned i = 0; i < static_cast<unsigned>(left); ++i) {
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
