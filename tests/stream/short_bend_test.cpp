// SPDX-License-Identifier: MIT
//
// Bends that are short beside the way in which a jerk limit changes the speed: corners that are blended within a
// tolerance. They have to be passed faster than the corners with a stop at each.
#include "support/catch.hpp"
#include "support/emitted.hpp"
#include "support/pipeline.hpp"

using namespace splinefeed_test;

namespace {

struct Corners {
    BezierPath sharp;
    BezierPath blended;
};

/// A zigzag of equal legs. In `blended` the cubic with both inner control points on the corner replaces each corner:
/// its middle is sin(turn / 2) / 4 of the trim away from the corner.
Corners zigzag(int legs, double length_mm, double turn_degrees, double tolerance_mm) {
    const double half = turn_degrees * std::acos(-1.0) / 360.0;
    const double trim = 4.0 * tolerance_mm / std::sin(half);
    Corners out;
    for (int i = 0; i < legs; ++i) {
        const double side = i % 2 == 0 ? 1.0 : -1.0;
        const double x = std::cos(half);
        const double y = side * std::sin(half);
        const double straight = length_mm - trim * (i == 0 || i + 1 == legs ? 1.0 : 2.0);
        out.sharp.push_back(line_shape(2, 1, {length_mm * x, length_mm * y}));
        out.sharp.back().stop_at_end = true;
        out.blended.push_back(line_shape(2, 1, {straight * x, straight * y}));
        if (i + 1 < legs) {
            out.blended.push_back(cubic_shape(trim * x, trim * y, trim * x, trim * y, 2.0 * trim * x, 0.0));
        }
    }
    return out;
}

double seconds(const Stream& stream) {
    return static_cast<double>(stream.segments.size()) * stream.segments[0].duration_ticks / 8e6;
}

} // namespace

TEMPLATE_TEST_CASE("blended corners are faster than stops", "[stream][jerk]", DoubleInDouble, FixedInDouble,
                   FixedInFloat) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    const MachineSettings machine = with_jerk(machine_of(2, 100.0, 1000.0, 100.0), 30000.0);
    for (const double turn : {90.0, 126.0, 170.0}) {
        for (const double tolerance : {0.01, 0.05, 0.1}) {
            const Corners corners = zigzag(8, 10.0, turn, tolerance);
            const Stream stream = stream_of<S, R>(corners.blended, machine, 1024);
            require_limits(stream, machine);
            const double stops = seconds(stream_of<S, R>(corners.sharp, machine, 1024));
            CAPTURE(turn, tolerance, seconds(stream), stops);
            CHECK(seconds(stream) < stops);
        }
    }
}
