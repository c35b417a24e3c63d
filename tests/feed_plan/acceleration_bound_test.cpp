// SPDX-License-Identifier: MIT
//
// The polygon of the speeds that a cell allows against its definition, evaluated in long double.
#include "splinefeed/s3_feed_plan/acceleration_bound.hpp"

#include "support/catch.hpp"
#include "support/pipeline.hpp"
#include "support/plan_reference.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr std::uint32_t seed = 51;

/// A cell of any shape: straight axes, axes that turn round, and one without inertia now and then.
template <Scalar S>
Cell<S> random_cell(Random& random, const MotionLimits<S>& limits) {
    Cell<S> cell;
    cell.axes = limits.axes;
    cell.length_mm = from_double<S>(random.decades(1e-3, 1.0));
    const double unit = std::ldexp(1.0, limits.refinement.shape_log2);
    for (unsigned k = 0; k < static_cast<unsigned>(limits.axes); ++k) {
        const double bend = random.integer(0, 3) == 0 ? 0.0 : random.decades(1e-4, 0.4);
        const double tangent = random.integer(0, 5) == 0 ? 0.0 : random.between(-1.0, 1.0);
        AxisShape<S>& shape = cell.shape[k];
        for (unsigned j = 0; j < 3; ++j) {
            shape.bend[j] = from_double<S>(unit * bend * random.between(-1.0, 1.0));
        }
        shape.tangent = {from_double<S>(unit * tangent),
                         from_double<S>(unit * (tangent + bend * random.between(-0.5, 0.5)))};
        shape.spread = from_double<S>(unit * random.decades(1e-8, 1e-5));
    }
    return cell;
}

/// The largest entry that leaves an exit up to at_most, by bisection.
Real largest_entry(const std::vector<HalfPlane>& planes, Real at_most, Real cap) {
    const auto allowed = [&](Real entry) {
        const Exits exits = exits_of(planes, entry, at_most);
        return exits.low <= exits.high;
    };
    Real low = 0.0L;
    Real high = cap;
    if (allowed(high)) {
        return high;
    }
    for (int step = 0; step < 100; ++step) {
        const Real middle = (low + high) / 2.0L;
        (allowed(middle) ? low : high) = middle;
    }
    return low;
}

} // namespace

TEMPLATE_TEST_CASE("the polygon of a cell: its peak, its largest exits and entries", "[feed_plan]", double, float,
                   Fixed) {
    using S = TestType;
    Random random(seed);
    // Nearly parallel half-planes magnify rounding.
    const Real close = std::same_as<S, double> ? 1e-9L : std::same_as<S, float> ? 2e-2L : 2e-4L;
    for (int round = 0; round < 4000; ++round) {
        const int axes = random.integer(1, max_axes);
        const MachineSettings machine = random_machine(random, axes);
        const MotionLimits<S> limits = MotionLimits<S>::make(machine).value();
        const Cell<S> cell = random_cell(random, limits);
        const AccelerationBound<S> bound(cell, limits);
        const S cap = limits.feed_mm_s * limits.feed_mm_s * from_double<S>(random.decades(1e-3, 1.0));
        const EndSpeeds<S> peak = bound.peak(cap);
        const Real entry = exact(peak.entry_sq);
        const Real scale = exact(cap);
        CAPTURE(round, axes, static_cast<double>(scale), static_cast<double>(entry));
        // The peak is reached, and nothing beyond it is.
        const auto planes = half_planes_of(cell, limits);
        const Real best = largest_entry(planes, scale, scale);
        CAPTURE(static_cast<double>(best), to_double(peak.exit_sq));
        REQUIRE(std::fabs(entry - best) <= close * scale);
        for (const HalfPlane& plane : planes) {
            const Real excess = plane.entry * entry + plane.exit * exact(peak.exit_sq) - plane.limit;
            REQUIRE(excess <= close * scale * (std::fabs(plane.entry) + std::fabs(plane.exit)));
        }
        REQUIRE((peak.exit_sq >= S{} && peak.exit_sq <= cap));
        // Below it, what can be reached and from where.
        const S exit = peak.exit_sq * from_double<S>(random.between(0.0, 0.99));
        const Real from = exact(bound.largest_entry(exit, peak.entry_sq));
        REQUIRE(std::fabs(from - std::min(entry, largest_entry(planes, exact(exit), scale))) <= close * scale);
        const S start = peak.entry_sq * from_double<S>(random.between(0.0, 1.0));
        const Exits reach = exits_of(planes, exact(start), scale);
        REQUIRE(std::fabs(exact(bound.largest_exit(start, cap)) - reach.high) <= close * scale);
    }
}
