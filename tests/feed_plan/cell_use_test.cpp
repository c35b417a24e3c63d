// SPDX-License-Identifier: MIT
//
// The use of the limits in a cell against their values at many points, in long double, errors of the shape included.
#include "splinefeed/s3_feed_plan/jerk/cell_use.hpp"

#include "support/catch.hpp"
#include "support/jerk_reference.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr std::uint32_t seed = 92;

struct Ends {
    LegNode<double> from;
    LegNode<double> to;
};

Ends ends_of(const JerkCell<double>& cell, double b0, double middle, double b1) {
    Ends ends;
    const double l = cell.length_mm;
    ends.from.length_mm = l;
    ends.from.b = b0;
    ends.from.middle_sq = middle;
    ends.to.b = b1;
    ends.from.slope = 2.0 * (middle - b0) / l;
    ends.to.slope = 2.0 * (b1 - middle) / l;
    ends.from.curvature = (ends.to.slope - ends.from.slope) / l;
    for (const unsigned k : indices(cell.limits.axes)) {
        for (unsigned e = 0; e < 2; ++e) {
            const AxisEnd<double>& at = cell.end[e][k];
            LegAxis<double>& axis = (e == 0 ? ends.from : ends.to).axis[k];
            axis.first = at.first;
            axis.second = at.second;
            axis.third = Pair<double>{at.third, at.third};
            axis.second_spread = Pair<double>{at.second_spread, at.second_spread};
            axis.third_spread = Pair<double>{at.third_spread, at.third_spread};
        }
    }
    return ends;
}

} // namespace

TEST_CASE("what is proved of a cell is kept everywhere in it, and little is given away", "[feed_plan][jerk]") {
    std::mt19937 random{seed};
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    double least = 1.0; // use of a motion that is just proved
    for (int trial = 0; trial < 2000; ++trial) {
        const JerkLimits limits{1000.0, 1000.0 * std::exp2(10.0 * unit(random)), 1e9};
        const Wave wave{{unit(random), 0.5 * unit(random)}, {unit(random), 2.0 * unit(random)}};
        JerkCell<double> cell = wave.cell(20.0 * unit(random), 0.01 + 0.3 * unit(random), limits);
        for (const unsigned k : indices(cell.limits.axes)) {
            const double second = 0.3 * unit(random);
            const double third = 0.3 * unit(random);
            for (auto& end : cell.end) {
                end[k].second_spread = second;
                end[k].third_spread = third;
            }
        }
        const double shape[] = {0.5 + unit(random), 0.5 + unit(random), 0.5 + unit(random)};
        double low = 0.0;
        double high = 1e6;
        for (int i = 0; i < 60; ++i) { // the fastest motion of this shape that is proved
            const double b = 0.5 * (low + high);
            const Ends ends = ends_of(cell, b * shape[0], b * shape[1], b * shape[2]);
            const CellUse<double> use = cell_use(ends.from, ends.to, cell.limits);
            (use.acceleration.most <= 1.0 && use.jerk.most <= 1.0 ? low : high) = b;
        }
        const double l = cell.length_mm;
        const JerkUse use = use_of(cell, wide(low * shape[0]), wide(2.0 * low * (shape[1] - shape[0]) / l),
                                   wide(2.0 * low * (shape[0] - 2.0 * shape[1] + shape[2]) / (l * l)));
        CAPTURE(seed, trial, low);
        REQUIRE(use.acceleration <= 1.0L + 1e-9L);
        REQUIRE(use.jerk <= 1.0L + 1e-9L);
        least = std::min(least, static_cast<double>(std::max(use.acceleration, use.jerk)));
    }
    CHECK(least > 0.9);
}
