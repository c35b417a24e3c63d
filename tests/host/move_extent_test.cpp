// SPDX-License-Identifier: MIT
#include "host_sim/analysis/move_extent.hpp"

#include "support/catch.hpp"

#include <cmath>
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

TEST_CASE("Arcs, helices and spirals of several turns about any axis: random ones against their points") {
    std::mt19937 random(11); // NOLINT: the same arcs each time
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    for (int i = 0; i < 400; ++i) {
        std::array<double, 3> n{any(random), any(random), any(random) + 1.5};
        const double norm = std::hypot(n[0], n[1], n[2]);
        n = {n[0] / norm, n[1] / norm, n[2] / norm};
        if (i % 4 == 0) { // G17, G18 and G19
            n = {};
            n[static_cast<unsigned>(i) / 4U % 3U] = 1.0;
        }
        const double flat = std::hypot(n[0], n[1]);
        const auto u = flat == 0.0 ? std::array{1.0, 0.0, 0.0} : std::array{n[1] / flat, -n[0] / flat, 0.0};
        const std::array<double, 3> v{n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]};
        const double radius = 10.0 * std::fabs(any(random)) + 0.1;
        const double growth = i % 3 == 0 ? radius * std::fabs(any(random)) : 0.0;
        const double begin = 3.0 * any(random);
        const double sweep = (i % 2 == 0 ? 9.0 : 60.0) * any(random);
        const double rise = i % 8 < 4 ? 0.0 : 60.0 * any(random);
        const std::array<double, 3> centre{20.0 * any(random), 20.0 * any(random), 20.0 * any(random)};
        const auto point = [&](double share) {
            std::array<double, 3> p{};
            const double angle = begin + share * sweep;
            for (std::size_t k = 0; k < 3; ++k) {
                p[k] = centre[k] + (radius + share * growth) * (u[k] * std::cos(angle) + v[k] * std::sin(angle)) +
                       share * rise * n[k];
            }
            return p;
        };
        const auto from = point(0.0);
        const auto to = point(1.0);
        PathElement<double> arc;
        arc.shape = MoveShape::arc;
        arc.to = at(to[0], to[1], to[2]);
        arc.arc.centre = at(centre[0], centre[1], centre[2]);
        arc.arc.normal = n;
        arc.arc.sweep_rad = sweep;
        AxisBox box;
        add_extent(at(from[0], from[1], from[2]), arc, 3, box);
        std::array<double, 3> low = from;
        std::array<double, 3> high = from;
        auto last = from;
        double length = 0.0;
        constexpr int steps = 20000;
        for (int j = 1; j <= steps; ++j) {
            const auto p = point(static_cast<double>(j) / steps);
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = std::min(low[k], p[k]);
                high[k] = std::max(high[k], p[k]);
            }
            length += std::hypot(p[0] - last[0], p[1] - last[1], p[2] - last[2]);
            last = p;
        }
        CAPTURE(i, sweep, begin, rise, growth);
        const double coarse = 25.0 * std::pow(sweep / steps, 2); // what the places leave out
        for (unsigned k = 0; k < 3; ++k) {
            CHECK(box.low[k] <= low[k] + 1e-9);
            CHECK(box.low[k] >= low[k] - coarse - 1e-9);
            CHECK(box.high[k] >= high[k] - 1e-9);
            CHECK(box.high[k] <= high[k] + coarse + 1e-9);
        }
        CHECK(move_length(at(from[0], from[1], from[2]), arc, 3, linear) == Approx(length).epsilon(2e-6));
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
