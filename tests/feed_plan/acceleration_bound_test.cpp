// SPDX-License-Identifier: MIT
//
// The polygon of the speeds that a cell allows against its definition, evaluated in long double.
#include "splinefeed/s3_feed_plan/acceleration/acceleration_bound.hpp"

#include "support/catch.hpp"
#include "support/pipeline.hpp"
#include "support/plan_reference.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr std::uint32_t seed = 51;

/// Exits that a part of a cell allows for an entry, tried one by one. Below zero an exit is the slope of a line that
/// ends before; what a shape leaves its polynomials by goes with |b|.
class SmallestExits {
public:
    template <Scalar S>
    SmallestExits(const Cell<S>& cell, const MotionLimits<S>& limits, const CellInterval<S>& stretch, Real entry)
        : planes_(half_planes_of(cell, limits, exact(stretch.from), exact(stretch.to))), entry_(entry) {
        for (const unsigned k : indices(limits.axes)) {
            spread_.push_back(exact(cell.shape[k].error_bound) * exact(stretch.length()));
        }
    }

    /// The smallest from at_least to at_most; at_most where there is none. One that is bounded above zero from below
    /// it is looked for from zero on.
    [[nodiscard]] Real find(Real at_least, Real at_most) const {
        const Real found = search(at_least, at_most);
        return at_least < 0.0L && found > 0.0L ? search(0.0L, std::max(at_most, 0.0L)) : found;
    }

private:
    /// Too low for a half-plane that bounds it from below.
    [[nodiscard]] bool too_low(Real exit) const {
        for (std::size_t i = 0; i < planes_.size(); ++i) {
            const Real factor = planes_[i].exit - (exit < 0.0L ? 2.0L * spread_[i / 8] : 0.0L);
            if (factor < 0.0L && planes_[i].entry * entry_ + factor * exit > planes_[i].limit) {
                return true;
            }
        }
        return false;
    }
    [[nodiscard]] Real search(Real low, Real high) const {
        if (!too_low(low)) {
            return low;
        }
        const Real at_most = high;
        for (int step = 0; step < 120; ++step) {
            const Real middle = (low + high) / 2.0L;
            (too_low(middle) ? low : high) = middle;
        }
        return high == at_most ? at_most : high;
    }

    std::vector<HalfPlane> planes_;
    std::vector<Real> spread_; // of an axis
    Real entry_;
};

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
        const PeakSpeeds<S> peak = bound.peak({cap, cap});
        const Real entry = exact(peak.entry_sq);
        const Real scale = exact(cap);
        CAPTURE(round, axes, static_cast<double>(scale), static_cast<double>(entry));
        // The peak is reached, and nothing beyond it is.
        const auto planes = half_planes_of(cell, limits);
        const Real best = fastest_entry(planes, scale, scale);
        CAPTURE(static_cast<double>(best), to_double(peak.smallest_exit_sq));
        REQUIRE(std::fabs(entry - best) <= close * scale);
        bool more = peak.largest_exit_sq < cap; // a larger exit is allowed
        for (const HalfPlane& plane : planes) {
            const Real rounding = close * scale * (std::fabs(plane.entry) + std::fabs(plane.exit));
            const auto excess = [&](S exit) {
                return plane.entry * entry + plane.exit * exact(exit) - plane.limit;
            };
            REQUIRE(excess(peak.smallest_exit_sq) <= rounding);
            REQUIRE(excess(peak.largest_exit_sq) <= rounding);
            more = more && !(plane.exit > 0.0L && excess(peak.largest_exit_sq) >= -rounding);
        }
        REQUIRE(!more);
        REQUIRE((peak.smallest_exit_sq >= S{} && peak.smallest_exit_sq <= peak.largest_exit_sq));
        REQUIRE(peak.largest_exit_sq <= cap);
        // Below it, what can be reached and from where.
        const S exit = peak.smallest_exit_sq * from_double<S>(random.between(0.0, 0.99));
        const Real from = exact(bound.largest_entry(exit, peak.entry_sq));
        REQUIRE(std::fabs(from - std::min(entry, entry_for(planes, exact(exit), scale))) <= close * scale);
        const S start = peak.entry_sq * from_double<S>(random.between(0.0, 1.0));
        const Exits reach = exits_of(planes, exact(start), scale);
        REQUIRE(std::fabs(exact(bound.largest_exit(start, cap)) - reach.high) <= close * scale);
    }
}

// Where numbers are small, what rounding may change is a part of the limit that would show.
TEST_CASE("in Fixed no half-plane is broken by rounding, not in its last digit", "[feed_plan]") {
    Random random(seed + 2);
    int bounded = 0;
    for (int round = 0; round < 4000; ++round) {
        const MotionLimits<Fixed> limits = MotionLimits<Fixed>::make(random_machine(random, 2)).value();
        Cell<Fixed> cell = random_cell(random, limits);
        cell.length_mm = from_double<Fixed>(random.decades(1e-6, 1e-5));
        const AccelerationBound<Fixed> bound(cell, limits);
        const Fixed cap = from_double<Fixed>(random.decades(1e-3, 1.0));
        const PeakSpeeds<Fixed> peak = bound.peak({cap, cap});
        const Fixed entry = peak.entry_sq * from_double<Fixed>(random.between(0.0, 1.0));
        const Fixed exit = bound.largest_exit(entry, cap);
        bounded += exit < cap ? 1 : 0;
        CAPTURE(round, to_double(entry), to_double(exit));
        for (const HalfPlane& plane : half_planes_of(cell, limits)) {
            if (plane.exit > 0.0L) {
                const Real excess = plane.entry * exact(entry) + plane.exit * exact(exit) - plane.limit;
                REQUIRE(static_cast<double>(excess) <= 0.0);
            }
        }
    }
    CHECK(bounded > 500);
}

TEMPLATE_TEST_CASE("the smallest exits of a cell and of parts of it, down to slopes that end before", "[feed_plan]",
                   double, float, Fixed) {
    using S = TestType;
    Random random(seed + 1);
    const Real close = std::same_as<S, double> ? 1e-9L : std::same_as<S, float> ? 2e-2L : 2e-4L;
    std::array<int, 4> seen{}; // bounded above zero, below it, at_least, at_most
    for (int round = 0; round < 4000; ++round) {
        const int axes = random.integer(1, max_axes);
        const MachineSettings machine = changed_machine<S>(random, axes, brake_differently);
        const MotionLimits<S> limits = MotionLimits<S>::make(machine).value();
        const Cell<S> cell = random_cell(random, limits);
        CellInterval<S> stretch;
        if (random.chance(0.5)) {
            stretch.from = from_double<S>(random.between(0.0, 0.9));
            stretch.to = stretch.from + (stretch.to - stretch.from) * from_double<S>(random.between(0.1, 1.0));
        }
        const AccelerationBound<S> bound(cell, limits, stretch);
        const S cap = limits.feed_mm_s * limits.feed_mm_s * from_double<S>(random.decades(1e-3, 1.0));
        const S entry = bound.peak({cap, cap}).entry_sq * from_double<S>(random.between(0.0, 1.0));
        const S at_most = cap * from_double<S>(random.between(0.0, 1.0));
        const S at_least = random.chance(0.5) ? at_most * from_double<S>(random.between(0.0, 0.5))
                                              : -(entry * from_double<S>(random.between(0.0, 1.0)));
        const Real least = exact(at_least);
        const Real most = exact(at_most);
        const SmallestExits by_search(cell, limits, stretch, exact(entry));
        const Real expected = by_search.find(least, most);
        const Real found = exact(bound.smallest_exit(entry, at_least, at_most));
        CAPTURE(seed, round, axes, static_cast<double>(least), static_cast<double>(most), to_double(entry),
                static_cast<double>(expected), static_cast<double>(found));
        REQUIRE(std::fabs(found - expected) <= close * exact(cap));
        seen[expected == least ? 2 : expected == most ? 3 : expected > 0.0L ? 0 : 1] += 1;
    }
    for (const int times : seen) {
        CHECK(times > 50);
    }
}
