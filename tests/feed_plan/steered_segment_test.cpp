// SPDX-License-Identifier: MIT
//
// Steered profile segments: in closed form on straight cells, within the polygon of the part that they travel on any.
#include "splinefeed/s3_feed_plan/acceleration/steered_segment.hpp"

#include "support/catch.hpp"
#include "support/plan_reference.hpp"
#include "support/rounds.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 91;

/// A straight cell along one axis.
template <Scalar S>
Cell<S> straight_cell(double length_mm) {
    Cell<S> cell;
    cell.axes = 1;
    cell.length_mm = from_double<S>(length_mm);
    cell.shape[0].tangent[0] = cell.shape[0].tangent[1] = from_integer<Ratio<S>>(1);
    cell.heading[0] = 1;
    return cell;
}

template <Scalar S>
SteeringTarget<S> aim_of(double from, double entry, double level, double exit, double most) {
    return {.from = from_double<S>(from),
            .entry_sq = from_double<S>(entry),
            .max_steady_sq = from_double<S>(level),
            .level_sq = from_double<S>(level),
            .exit_sq = from_double<S>(exit),
            .most_sq = from_double<S>(most),
            .known_sq = from_integer<S>(-1)};
}

/// One after another to the end of a cell or to rest; what is wanted changes from one to the next.
template <Scalar S>
class Drive {
public:
    Drive(const Cell<S>& cell, const MotionLimits<S>& limits, S cap_sq)
        : cell_(&cell), limits_(&limits), cap_(cap_sq) {}

    /// How many profile segments it took.
    int go(Random& random, S entry_sq, S most_sq, double holds) {
        SteeringTarget<S> aim;
        aim.entry_sq = entry_sq;
        aim.most_sq = most_sq;
        aim.level_sq = cap_;
        aim.known_sq = from_integer<S>(-1);
        for (int profile_segments = 1;; ++profile_segments) {
            REQUIRE(profile_segments < 40);
            if (profile_segments < 16) {
                aim.rest = random.chance(holds);
                aim.max_steady_sq = cap_ * all_or_part(random);
                aim.exit_sq = smaller(aim.max_steady_sq, most_sq) * all_or_part(random);
            } else { // on at this speed
                aim.rest = false;
                aim.max_steady_sq = cap_;
                aim.exit_sq = smaller(aim.entry_sq, most_sq);
            }
            const ProfileSegment<S> profile_segment = steered_segment(*cell_, *limits_, aim);
            require_what_was_asked(profile_segment, aim);
            require_allowed(profile_segment);
            if (profile_segment.stops || profile_segment.stretch.to == from_integer<S>(1)) {
                return profile_segments;
            }
            aim.from = profile_segment.stretch.to;
            aim.entry_sq = profile_segment.exit_sq;
        }
    }

private:
    static S all_or_part(Random& random) {
        return random.chance(0.5) ? from_integer<S>(1) : from_double<S>(random.between(0.0, 1.0));
    }

    void require_what_was_asked(const ProfileSegment<S>& profile_segment, const SteeringTarget<S>& aim) const {
        const bool to_end = profile_segment.stretch.to == from_integer<S>(1);
        CAPTURE(to_double(aim.from), to_double(profile_segment.stretch.to), to_double(aim.entry_sq),
                to_double(aim.max_steady_sq), to_double(aim.exit_sq), to_double(aim.most_sq), aim.rest,
                to_double(profile_segment.exit_sq));
        REQUIRE(profile_segment.stretch.from == aim.from);
        REQUIRE(profile_segment.stretch.to >= aim.from); // a small change may take less than the last digit
        REQUIRE(profile_segment.stretch.to <= from_integer<S>(1));
        REQUIRE(profile_segment.entry_sq == aim.entry_sq);
        REQUIRE(profile_segment.exit_sq >= S{});
        REQUIRE((!to_end || profile_segment.exit_sq <= aim.most_sq));
        REQUIRE((!profile_segment.stops || (aim.rest && profile_segment.exit_sq == S{})));
        if (!to_end && !aim.rest) { // it ends before the cell where what was wanted is reached
            REQUIRE(profile_segment.exit_sq == (aim.entry_sq > aim.max_steady_sq ? aim.max_steady_sq : aim.exit_sq));
        }
    }

    /// Within the half-planes of the part that is travelled. The profile segment was cut from a longer one, whose end
    /// may be slower: what q' and q'' leave their polynomials by was allowed for by less than twice the faster end.
    void require_allowed(const ProfileSegment<S>& profile_segment) const {
        const Real length = std::max(exact(profile_segment.stretch.length()), rounding<S>());
        const Real b0 = exact(profile_segment.entry_sq);
        const Real b1 = exact(profile_segment.exit_sq);
        const Real close = (std::same_as<S, double> ? 1e-11L : std::same_as<S, float> ? 1e-4L : 1e-8L) * exact(cap_);
        // Of a length by the rounding of its end, and in Fixed of the length in mm
        const Real coarse =
            4.0L * rounding<S>() / length / (std::same_as<S, Fixed> ? std::min(1.0L, exact(cell_->length_mm)) : 1.0L);
        const auto planes =
            half_planes_of(*cell_, *limits_, exact(profile_segment.stretch.from), exact(profile_segment.stretch.to));
        for (std::size_t i = 0; i < planes.size(); ++i) {
            const HalfPlane& plane = planes[i];
            const Real spread = exact(cell_->shape[i / 8].error_bound);
            const Real excess = plane.entry * b0 + plane.exit * b1 - plane.limit;
            CAPTURE(i, to_double(profile_segment.stretch.from), to_double(profile_segment.stretch.to),
                    static_cast<double>(b0), static_cast<double>(b1));
            REQUIRE(excess <= close * (std::fabs(plane.entry) + std::fabs(plane.exit)) + coarse * plane.limit +
                                  spread * length * std::max(b0, b1));
        }
    }

    const Cell<S>* cell_;
    const MotionLimits<S>* limits_;
    S cap_;
};

} // namespace

TEMPLATE_TEST_CASE("on a straight cell profile_segments are those of constant acceleration",
                   "[feed_plan][profile_segment]", double, Fixed) {
    using S = TestType;
    MachineSettings machine = machine_of(1, 1000.0, 1000.0, 1000.0);
    machine.axis[0].max_braking_mm_s2 = 400.0;
    const auto limits = MotionLimits<S>::make(machine).value();
    const double up = 2.0 * to_double(limits.acceleration_mm_s2[0]); // of v^2, per mm
    const double down = 2.0 * to_double(limits.braking_mm_s2[0]);
    const double length = GENERATE(0.02, 0.5, 12.0); // 12 mm: many braking distances of the slower ones
    const Cell<S> cell = straight_cell<S>(length);
    for (const double from : {0.0, 0.3, 0.9}) {
        const double left = (1.0 - from) * length;
        CAPTURE(length, from);
        const double some = 0.4 * left * down; // that much is lost on 0.4 of what is left
        const auto close = [](double value) {
            return Approx(value).epsilon(1e-5).margin(1e-7);
        };

        const auto to_level = steered_segment(cell, limits, aim_of<S>(from, 2.0 * some, some, some, 3.0 * some));
        CHECK(to_double(to_level.exit_sq) == close(some));
        CHECK(to_double(to_level.stretch.to) == close(from + 0.4 * (1.0 - from)));
        CHECK_FALSE(to_level.stops);

        const auto too_fast = steered_segment(cell, limits, aim_of<S>(from, 9.0 * some, some, some, 9.0 * some));
        CHECK(to_double(too_fast.stretch.to) == 1.0);
        CHECK(to_double(too_fast.exit_sq) == close(9.0 * some - left * down));

        const double more = 0.3 * left * up;
        const auto faster = steered_segment(cell, limits, aim_of<S>(from, more, 3.0 * more, 2.0 * more, 9.0 * more));
        CHECK(to_double(faster.exit_sq) == close(2.0 * more));
        CHECK(to_double(faster.stretch.to) == close(from + 0.3 * (1.0 - from)));

        const auto all_the_way =
            steered_segment(cell, limits, aim_of<S>(from, more, 9.0 * more, 9.0 * more, 9.0 * more));
        CHECK(to_double(all_the_way.stretch.to) == 1.0);
        CHECK(to_double(all_the_way.exit_sq) == close(more + left * up));

        const auto steady = steered_segment(cell, limits, aim_of<S>(from, more, more, more, more));
        CHECK(to_double(steady.stretch.to) == 1.0);
        CHECK(to_double(steady.exit_sq) == close(more));

        // To rest: at once where that takes less than a step, else in steps of a quarter of the cell
        SteeringTarget<S> rest = aim_of<S>(from, 0.15 * length * down, 1e6, 1e6, 1e6);
        rest.rest = true;
        const bool within = from + 0.15 < 1.0;
        const auto stop = steered_segment(cell, limits, rest);
        CHECK(stop.stops == within);
        CHECK(to_double(stop.stretch.to) == close(within ? from + 0.15 : 1.0));
        CHECK(to_double(stop.exit_sq) == close(within ? 0.0 : 0.05 * length * down));
        rest.entry_sq = from_double<S>(2.0 * length * down);
        const auto part = steered_segment(cell, limits, rest);
        const double end = std::min(1.0, from + 0.25);
        CHECK_FALSE(part.stops);
        CHECK(to_double(part.stretch.to) == close(end));
        CHECK(to_double(part.exit_sq) == close((2.0 - (end - from)) * length * down));
    }
}

TEMPLATE_TEST_CASE("a stop in a small part of a long cell is found", "[feed_plan][profile_segment]", double, Fixed) {
    using S = TestType;
    const MachineSettings machine = machine_of(1, 1000.0, 1000.0, 1000.0);
    const auto limits = MotionLimits<S>::make(machine).value();
    const Cell<S> cell = straight_cell<S>(16.0);
    for (const double part : {1e-1, 1e-2, 1e-3, 1e-4}) {
        SteeringTarget<S> rest = aim_of<S>(0.5, part * 16.0 * 2.0 * to_double(limits.braking_mm_s2[0]), 1e6, 1e6, 1e6);
        rest.rest = true;
        const auto stop = steered_segment(cell, limits, rest);
        CAPTURE(part);
        CHECK(stop.stops);
        CHECK(stop.exit_sq == S{});
        CHECK(to_double(stop.stretch.to) == Approx(0.5 + part).epsilon(1e-6));
    }
}

TEMPLATE_TEST_CASE("what a profile_segment asks of the axes its cell allows, and what follows can be travelled",
                   "[feed_plan][profile_segment]", double, float, Fixed) {
    using S = TestType;
    Random random(seed);
    int profile_segments = 0;
    const int runs = rounds(2000);
    for (int run = 0; run < runs; ++run) {
        const int axes = random.integer(1, max_axes);
        const MachineSettings machine = changed_machine<S>(random, axes, brake_differently);
        const auto limits = MotionLimits<S>::make(machine).value();
        Cell<S> cell = random_cell(random, limits);
        // Some axis has inertia, as on every path
        cell.shape[0].tangent[0] = from_integer<Ratio<S>>(random.chance(0.5) ? 1 : -1);
        const S cap = limits.feed_mm_s * limits.feed_mm_s * from_double<S>(random.decades(1e-3, 1.0));
        const auto peak = AccelerationBound<S>(cell, limits).peak({cap, cap});
        // A part of the peak is allowed, as (0, 0) is; then every larger exit will do for most_sq
        const S share = from_double<S>(random.between(0.01, 0.98));
        const S least = share * peak.smallest_exit_sq;
        const S most = least + (cap - least) * from_double<S>(random.decades(1e-4, 1.0));
        CAPTURE(seed, run, scalar_name<S>());
        profile_segments +=
            Drive<S>(cell, limits, cap).go(random, share * peak.entry_sq, most, random.chance(0.5) ? 0.5 : 0.0);
    }
    CHECK(profile_segments > runs + runs / 10); // some ended within the cell
}
