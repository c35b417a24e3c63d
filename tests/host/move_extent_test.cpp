// SPDX-License-Identifier: MIT
#include "host_sim/analysis/move_extent.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <numbers>
#include <random>

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

constexpr PerAxis<bool> linear{true, true, true};

PerAxis<Position> at(double x, double y, double z) {
    return {position_from_mm(x), position_from_mm(y), position_from_mm(z)};
}

} // namespace

TEST_CASE("The box and the length of a line are those of its ends") {
    PathElement<double> line;
    line.to = at(4.0, -3.0, 0.0);
    AxisBox box;
    add_extent(at(0.0, 0.0, 0.0), line, 3, box);
    CHECK(box.low[1] == -3.0);
    CHECK(box.high[0] == 4.0);
    CHECK(move_length(at(0.0, 0.0, 0.0), line, 3, linear) == 5.0);
}

TEST_CASE("The box of an arc has its extremes, and no more: random arcs against their points") {
    std::mt19937 random(7); // NOLINT: the same arcs each time
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int i = 0; i < 300; ++i) {
        PathElement<double> arc;
        arc.shape = MoveShape::arc;
        const unsigned plane = static_cast<unsigned>(i) % 3U;
        arc.arc.normal[plane] = 1.0;
        const double radius = 10.0 * std::fabs(any(random)) + 0.1;
        const double begin = 3.0 * any(random);
        const double sweep = 9.0 * any(random);
        arc.arc.sweep_rad = sweep;
        const double rise = i % 2 == 0 ? 0.0 : 2.0;
        const auto point = [&](double share) {
            std::array<double, 3> p{};
            const double angle = begin + share * sweep;
            p[(plane + 1) % 3] = radius * std::cos(angle);
            p[(plane + 2) % 3] = radius * std::sin(angle);
            p[plane] = share * rise;
            return p;
        };
        const auto from = point(0.0);
        const auto to = point(1.0);
        arc.to = at(to[0], to[1], to[2]);
        AxisBox box;
        add_extent(at(from[0], from[1], from[2]), arc, 3, box);
        std::array<double, 3> low{1e9, 1e9, 1e9};
        std::array<double, 3> high{-1e9, -1e9, -1e9};
        constexpr int steps = 4000;
        for (int j = 0; j <= steps; ++j) {
            const auto p = point(static_cast<double>(j) / steps);
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], p[k]);
                high[k] = std::max(high[k], p[k]);
            }
        }
        CAPTURE(i, plane, sweep, begin);
        for (unsigned k = 0; k < 3; ++k) {
            CHECK(std::fabs(box.low[k] - low[k]) < 1e-4);
            CHECK(std::fabs(box.high[k] - high[k]) < 1e-4);
        }
        CHECK(std::fabs(move_length(at(from[0], from[1], from[2]), arc, 3, linear) - std::hypot(radius * sweep, rise)) <
              1e-6);
    }
}

TEST_CASE("A Bezier segment is as long as its chords, and lies within its points") {
    PathElement<double> curve;
    curve.shape = MoveShape::bezier;
    curve.bezier.degree = 2;
    curve.to = at(10.0, 0.0, 0.0);
    curve.bezier.points[0] = {0.0, 5.0 * 4096.0, 10.0 * 4096.0};
    curve.bezier.points[1] = {0.0, 10.0 * 4096.0, 0.0};
    AxisBox box;
    add_extent({}, curve, 3, box);
    CHECK(box.high[1] == 10.0);
    // y = 2 x (1 - x / 10): the length of a parabola
    const double s = 2.0;
    const double exact = 10.0 * (std::sqrt(1.0 + s * s) + std::asinh(s) / s) / 2.0;
    CHECK(std::fabs(move_length({}, curve, 3, linear) / exact - 1.0) < 1e-3);
}
