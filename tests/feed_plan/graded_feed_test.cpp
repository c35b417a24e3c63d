// SPDX-License-Identifier: MIT
//
// The parts that a plan with limited jerk gets of the cells of an acceleration-limited one.
#include "splinefeed/s3_feed_plan/acceleration/graded_feed.hpp"

#include "support/catch.hpp"
#include "support/pipeline.hpp"

using namespace splinefeed_test;

namespace {

/// A path with slow bends, beside which cells are cut.
template <Scalar S>
struct Graded {
    explicit Graded(double jerk = 1e4)
        : limits(MotionLimits<S>::make(machine(jerk)).value()), source(segments_of<S>(path())),
          arc_length(source, limits.refinement), plan(arc_length, limits, window), feed(plan, limits, literal<S>(0.3)) {
    }

    static MachineSettings machine(double jerk) { return with_jerk(machine_of(2, 100.0, 1000.0, 100.0), jerk); }
    static BezierPath path() {
        return {line_shape(2, 1, {20.0, 0.0}), cubic_shape(0.03, 0.0, 0.05, 0.02, 0.05, 0.05),
                line_shape(2, 1, {0.0, 20.0}), cubic_shape(0.0, 0.03, -0.02, 0.05, -0.05, 0.05),
                line_shape(2, 1, {-20.0, 0.0})};
    }
    /// The next part; false: there is none.
    bool next(Cell<S>& part) {
        WorkBudget unlimited;
        return feed.next(UnderrunPolicy::wait, unlimited,
                         [&](const Cell<S>& cell, S /*cap_sq*/, S /*exit_sq*/) { part = cell; }) == Pull::item;
    }

    MotionLimits<S> limits;
    ListSource<S> source;
    ArcLength<S> arc_length;
    std::vector<PlannedCell<S>> window = std::vector<PlannedCell<S>>(64);
    FeedPlan<S> plan;
    GradedFeed<S> feed;
};

/// Largest distance from the end of a cell to the start of another one. [mm]
template <Scalar S>
Real gap(const Cell<S>& before, const Cell<S>& after) {
    PerAxis<Position> end{};
    PerAxis<Position> start{};
    before.position_at(from_integer<S>(1), end);
    after.position_at(S{}, start);
    return std::max(std::fabs(exact_mm(end[0]) - exact_mm(start[0])), std::fabs(exact_mm(end[1]) - exact_mm(start[1])));
}

} // namespace

TEMPLATE_TEST_CASE("the parts of cells beside a slow bend follow each other without a gap", "[feed_plan][jerk]", double,
                   Fixed) {
    using S = TestType;
    Graded<S> graded;
    Cell<S> before;
    REQUIRE(graded.next(before));
    Real length = exact(before.length_mm);
    Cell<S> part;
    while (graded.next(part)) {
        CHECK(gap(before, part) < 1e-7L);
        length += exact(part.length_mm);
        before = part;
    }
    ListSource<S> again(Graded<S>::path());
    Real whole = 0.0L;
    for (const Cell<S>& cell : cells_of<S>(again, graded.limits.refinement)) {
        whole += exact(cell.length_mm);
    }
    CHECK(std::fabs(length - whole) < 1e-6L);
}

TEMPLATE_TEST_CASE("where the acceleration binds first, a higher jerk limit hardly cuts more parts",
                   "[feed_plan][jerk]", double, Fixed) {
    const auto parts = [](double jerk) {
        Graded<TestType> graded(jerk);
        Cell<TestType> part;
        int count = 0;
        while (graded.next(part)) {
            ++count;
        }
        return count;
    };
    CHECK(parts(1.9e6) < 1.4 * parts(1e5)); // the acceleration in half a millisecond, in 10 ms
}

TEMPLATE_TEST_CASE("a path behind one that was forgotten begins with the start of its first cell", "[feed_plan][jerk]",
                   double, Fixed) {
    // Wherever the feed was in a cell of the path before
    using S = TestType;
    int cut = 0;
    for (int parts = 1; parts < 400; ++parts) {
        Graded<S> graded;
        Cell<S> part;
        bool goes_on = true;
        for (int i = 0; i < parts && goes_on; ++i) {
            goes_on = graded.next(part);
        }
        if (!goes_on) {
            break;
        }
        cut += part.length_mm < graded.plan.cell().length_mm && part.waypoint == graded.plan.cell().waypoint ? 1 : 0;
        graded.feed.forget();
        const PerAxis<double> elsewhere{7.0, -3.0};
        ListSource<S> next(segments_of<S>(Graded<S>::path(), elsewhere));
        graded.arc_length.start(next, nullptr);
        REQUIRE(graded.next(part));
        PerAxis<Position> start{};
        part.position_at(S{}, start);
        CAPTURE(parts);
        REQUIRE(start[0] == position_from_mm(elsewhere[0]));
        REQUIRE(start[1] == position_from_mm(elsewhere[1]));
    }
    CHECK(cut > 5);
}
