// SPDX-License-Identifier: MIT
//
// What a path asks for against the derivatives of its cells at many points.
#include "splinefeed/s3_feed_plan/jerk_filtered/path_derivative_bounds.hpp"

#include "support/catch.hpp"
#include "support/pipeline.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 1311;

template <Scalar S>
std::vector<Cell<S>> random_cells(const MotionLimits<S>& limits) {
    Random random(seed);
    ListSource<S> source(random_path(random, 3, 20, 5.0, 0.1, 0.2));
    return cells_of<S>(source, limits.refinement);
}

/// q'' of an axis by the parabola of its shape at x.
template <Scalar S>
Real second_at(const Cell<S>& cell, unsigned k, Real x) {
    const auto& c = cell.shape[k].bend;
    const Real y = 1.0L - x;
    return (exact(c[0]) * y * y + 2.0L * exact(c[1]) * x * y + exact(c[2]) * x * x) / (2.0L * exact(cell.length_mm));
}

} // namespace

TEMPLATE_TEST_CASE("a demand is no less than the derivatives, sign by sign", "[feed_plan][smooth]", double, float,
                   Fixed) {
    using S = TestType;
    const auto limits = MotionLimits<S>::make(machine_of(3, 100.0, 1000.0, 100.0)).value();
    const Real slack = std::same_as<S, float> ? 1e-4L : 1e-6L;
    for (const Cell<S>& cell : random_cells<S>(limits)) {
        const auto demand = PathDerivativeBounds<S>::of(cell, S{}, S{});
        for (unsigned k = 0; k < 3; ++k) {
            const AxisDemand<S>& at = demand.axis[k];
            for (int i = 0; i <= 16; ++i) {
                const Real x = static_cast<Real>(i) / 16.0L;
                const Real second = second_at(cell, k, x);
                const Real step = 1e-4L;
                const Real third = (second_at(cell, k, x + step) - second_at(cell, k, x - step)) /
                                   (2.0L * step * exact(cell.length_mm));
                REQUIRE(exact(at.second) * (1.0L + slack) + slack >= std::fabs(second));
                const S bound = second * third > 0.0L ? at.third_with : at.third_against;
                REQUIRE(exact(bound) * (1.0L + slack) + slack >= std::fabs(third));
            }
        }
    }
}

TEST_CASE("a joined demand is that of both parts", "[feed_plan][smooth]") {
    const auto limits = MotionLimits<double>::make(machine_of(3, 100.0, 1000.0, 100.0)).value();
    const auto cells = random_cells<double>(limits);
    auto first = PathDerivativeBounds<double>::of(cells[0], 100.0, 50.0);
    const auto alone = first;
    const auto second = PathDerivativeBounds<double>::of(cells[5], 90.0, 60.0);
    first.join(second, 3);
    CHECK(first.cap_sq == 90.0);
    CHECK(first.programmed_sq == 50.0);
    for (unsigned k = 0; k < 3; ++k) {
        CHECK(first.axis[k].first == std::max(alone.axis[k].first, second.axis[k].first));
        CHECK(first.axis[k].second == std::max(alone.axis[k].second, second.axis[k].second));
        CHECK(first.axis[k].third_with == std::max(alone.axis[k].third_with, second.axis[k].third_with));
        CHECK(first.axis[k].third_against == std::max(alone.axis[k].third_against, second.axis[k].third_against));
    }
}
