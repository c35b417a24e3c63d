// SPDX-License-Identifier: MIT
//
// The plan: feasible at every point of every cell, and nowhere slower than it must be.
#include "support/catch.hpp"
#include "support/plan_reference.hpp"
#include "support/rounds.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 41;

/// Speeds chain from rest to rest, with a stop where the cell says so.
template <class S>
void require_chain(const Planned<S>& planned) {
    const std::vector<PlannedCell<S>>& cells = planned.cells;
    REQUIRE(!cells.empty());
    REQUIRE(cells.front().entry_sq == S{});
    REQUIRE(cells.back().exit_sq == S{});
    REQUIRE(cells.back().cell.stop_at_end);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const PlannedCell<S>& c = cells[i];
        REQUIRE((i == 0 || c.entry_sq == cells[i - 1].exit_sq));
        REQUIRE((!c.cell.stop_at_end || c.exit_sq == S{}));
        REQUIRE((c.entry_sq >= S{} && c.exit_sq >= S{}));
    }
    // Time passes, but not for ever: a cell that is entered and left at rest has a speed of its own
    REQUIRE((planned.seconds() > 0.0 && std::isfinite(planned.seconds())));
}

} // namespace

TEMPLATE_TEST_CASE("every limit holds at dense points", "[feed_plan]", double, float, Fixed) {
    Random random(seed);
    for (int run = 0; run < rounds(20); ++run) {
        const int axes = random.integer(1, max_axes);
        const MachineSettings machine = random_machine(random, axes);
        const BezierPath path = random_path(random, axes, 12, random.decades(1.0, 50.0), 0.2, 0.3);
        const auto planned = plan_of<TestType>(path, machine, run % 2 == 0 ? 16 : 4096);
        require_chain(planned);
        CAPTURE(seed, run);
        require_feasible(planned.cells, machine);
    }
}

TEMPLATE_TEST_CASE("no node can be faster", "[feed_plan]", double, float, Fixed) {
    Random random(seed + 1);
    for (int run = 0; run < rounds(20); ++run) {
        const int axes = random.integer(1, max_axes);
        const MachineSettings machine = random_machine(random, axes);
        const auto limits = MotionLimits<TestType>::make(machine).value();
        BezierPath path = random_path(random, axes, 15, random.decades(1.0, 30.0), 0.15, 0.3);
        for (std::size_t i = 0; i < path.size(); i += 3) { // as a synchronous spindle would
            path[i].max_feed_mm_s = 5.0 + 10.0 * static_cast<double>(i);
        }
        const auto planned = plan_of<TestType>(path, machine, 8192);
        REQUIRE(planned.limited == 0);
        CAPTURE(seed, run);
        require_largest_exits(planned.cells, limits);
    }
}

TEMPLATE_TEST_CASE("a larger window changes nothing that was not limited", "[feed_plan]", double, float, Fixed) {
    Random random(seed + 2);
    int unlimited = 0;
    int limited = 0;
    for (int run = 0; run < rounds(20); ++run) {
        const MachineSettings machine = random_machine(random, 3);
        const BezierPath path = random_path(random, 3, 20, random.decades(1.0, 20.0), 0.2, 0.3);
        const auto whole = plan_of<TestType>(path, machine, 16384);
        const auto limits = MotionLimits<TestType>::make(machine).value();
        const std::vector<Real> reachable = reachable_speeds(whole.cells, limits);
        REQUIRE(whole.limited == 0);
        for (const std::size_t window : {16U, 24U, 64U, 200U, 1000U}) {
            const auto part = plan_of<TestType>(path, machine, window);
            require_chain(part);
            REQUIRE(part.cells.size() == whole.cells.size());
            (part.limited == 0 ? unlimited : limited) += 1;
            REQUIRE(part.seconds() >= whole.seconds() * (1.0 - 1e-3));
            for (std::size_t i = 0; i < whole.cells.size(); ++i) {
                // Not always below the whole plan's: with less at the entry of a cell an axis may have more at its exit
                REQUIRE(exact(part.cells[i].exit_sq) <=
                        reachable[i + 1] + tolerance<TestType>(whole.cells.size(), reachable[i + 1]));
                if (part.limited == 0) {
                    REQUIRE(part.cells[i].exit_sq == whole.cells[i].exit_sq);
                }
            }
        }
    }
    CHECK(unlimited > rounds(10));
    CHECK(limited > rounds(10));
}

TEMPLATE_TEST_CASE("a window that is too short says so, and stays feasible", "[feed_plan]", double, Fixed) {
    // 2 s of braking from 2000 mm/s within cells of 16 mm at most: 16 of them are an eighth of the way
    const MachineSettings machine = machine_of(2, 2000.0, 1000.0, 2000.0);
    BezierPath path(45, line_shape(2, 3, {400.0, 0.0}));
    const auto small = plan_of<TestType>(path, machine, FeedPlan<TestType>::smallest_window);
    CHECK(small.limited > 0);
    require_chain(small);
    require_feasible(small.cells, machine);
    const auto large = plan_of<TestType>(path, machine, 1U << 15);
    CHECK(large.limited == 0);
    CHECK(large.seconds() < small.seconds());
    // 2000 mm/s after 2 s, 18 m in all
    CHECK(large.seconds() == Approx(18000.0 / 2000.0 + 2.0).epsilon(0.005));
}

TEMPLATE_TEST_CASE("underrun changes no plan", "[feed_plan]", double, float, Fixed) {
    Random random(seed + 3);
    const MachineSettings machine = random_machine(random, 2);
    const auto limits = MotionLimits<TestType>::make(machine).value();
    const BezierPath path = random_path(random, 2, 30, 10.0, 0.2, 0.3);
    for (const std::size_t window : {16U, 100U}) {
        const auto reference = plan_of<TestType>(path, machine, window);
        for (std::uint64_t pattern = 1; pattern < 6; ++pattern) {
            ListSource<TestType> source(path, pattern, 4);
            const auto planned = plan_of<TestType>(source, limits, window);
            CHECK(planned.starvations > 0);
            CHECK(planned.limited == reference.limited);
            REQUIRE(planned.cells.size() == reference.cells.size());
            for (std::size_t i = 0; i < planned.cells.size(); ++i) {
                REQUIRE(planned.cells[i].exit_sq == reference.cells[i].exit_sq);
            }
        }
    }
}

TEMPLATE_TEST_CASE("the work per cell does not depend on the window", "[feed_plan]", double, Fixed) {
    // A pass visits every cell of the window once backward; only the cells that it commits once forward. Passes times
    // window over cells is therefore a bound of the backward visits per cell: four, plus the first and last window.
    Random random(seed + 4);
    for (int run = 0; run < 10; ++run) {
        const MachineSettings machine = random_machine(random, 3);
        const BezierPath path = random_path(random, 3, 40, random.decades(1.0, 100.0), run % 2 == 0 ? 0.0 : 0.2, 0.2);
        for (const std::size_t window : {16U, 17U, 50U, 200U}) {
            const auto planned = plan_of<TestType>(path, machine, window);
            CAPTURE(planned.passes, window, planned.cells.size());
            CHECK(planned.passes * window <= 4 * planned.cells.size() + 2 * window);
        }
    }
}

TEMPLATE_TEST_CASE("the plan stops at a cusp and nowhere else", "[feed_plan]", double, Fixed) {
    const MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0);
    for (const TestShape& shape :
         {cubic_shape(10.0, 10.0, 0.0, 10.0, 10.0, 0.0), cubic_shape(1.0, 0.0, 1.0, 0.0, 0.0, 0.0),
          cubic_shape(0.0, 0.0, 5.0, 10.0, 10.0, 0.0)}) {
        const auto planned = plan_of<TestType>({shape}, machine, 4096);
        require_chain(planned);
        int stops = 0;
        for (const auto& c : planned.cells) {
            stops += c.exit_sq == TestType{} ? 1 : 0;
        }
        // One stop at the end, and one on each side of what is left of the cusp
        CHECK(stops >= 2);
        CHECK(stops <= 3);
        CHECK(planned.seconds() < 1.5);
    }
}
