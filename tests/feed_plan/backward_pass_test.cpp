// SPDX-License-Identifier: MIT
//
// What the speeds are is judged by the tests of the feed plan; here, that a pass in parts is the same pass.
#include "splinefeed/s3_feed_plan/acceleration/backward_pass.hpp"

#include "support/catch.hpp"
#include "support/cell_reference.hpp"
#include "support/random_steering.hpp"

using namespace splinefeed_test;

namespace {

template <Scalar S>
std::vector<PlannedCell<S>> planned_cells(const BezierPath& path, const MotionLimits<S>& limits) {
    ListSource<S> source(path);
    std::vector<PlannedCell<S>> cells;
    for (const Cell<S>& cell : cells_of<S>(source, limits.refinement)) {
        PlannedCell<S> planned;
        planned.cell = cell;
        planned.cap = SpeedCaps<S>(limits).cap(cell);
        planned.peak = PeakSpeeds<S>::unknown();
        cells.push_back(planned);
    }
    return cells;
}

template <Scalar S>
struct Passed {
    std::vector<PlannedCell<S>> cells;
    BackwardPass<S> pass;
    unsigned calls = 0;
};

template <Scalar S>
Passed<S> pass_over(std::vector<PlannedCell<S>> cells, const MotionLimits<S>& limits, S ratio, bool open_end,
                    unsigned work) {
    Passed<S> done{std::move(cells), {}, 0};
    CellWindow<S> window(done.cells);
    for (std::size_t i = 0; i < done.cells.size(); ++i) {
        window.add_measured();
        window.take();
    }
    done.pass.begin(window, {ratio}, open_end);
    CHECK(done.pass.running());
    bool complete = false;
    while (!complete) {
        WorkBudget budget(work);
        complete = done.pass.run(window, limits, budget);
        ++done.calls;
    }
    CHECK_FALSE(done.pass.running());
    return done;
}

/// In how many parts the peaks of all cells are found.
template <Scalar S>
std::size_t peak_parts(const std::vector<PlannedCell<S>>& cells, const MotionLimits<S>& limits) {
    std::size_t parts = 0;
    for (const PlannedCell<S>& here : cells) {
        for (auto peak = PeakSpeeds<S>::unknown(); !peak.known(); ++parts) {
            AccelerationBound<S>(here.cell, limits).approach_peak(here.cap, peak);
        }
    }
    return parts;
}

} // namespace

TEMPLATE_TEST_CASE("a pass in parts is the same as a whole one", "[pass]", double, float, Fixed) {
    using S = TestType;
    Random random(20);
    for (int round = 0; round < 20; ++round) {
        const int axes = random.integer(1, max_axes);
        const MachineSettings machine = random_machine(random, axes);
        const auto limits = MotionLimits<S>::make(machine);
        if (!limits.has_value()) {
            continue;
        }
        const BezierPath path = random_path(random, axes, 6, random.decades(0.3, 20.0), 0.1, 0.3);
        const std::vector<PlannedCell<S>> cells = planned_cells<S>(path, *limits);
        const S ratio = from_double<S>(random.between(0.1, 2.0));
        const bool open_end = random.chance(0.5);
        CAPTURE(round, cells.size());
        const Passed<S> whole = pass_over<S>(cells, *limits, ratio, open_end, WorkBudget::unlimited);
        CHECK(whole.calls == 1);
        for (const unsigned work : {1U, 2U, 7U}) {
            const Passed<S> parts = pass_over<S>(cells, *limits, ratio, open_end, work);
            CHECK(parts.pass.last_final() == whole.pass.last_final());
            // Each part of the search for a peak, which is not known yet, may take a call of its own.
            CHECK(parts.calls * work + 1 >= cells.size());
            CHECK(parts.calls <= cells.size() + peak_parts(cells, *limits) + 1);
            for (std::size_t i = 0; i < cells.size(); ++i) {
                REQUIRE(parts.cells[i].entry_sq == whole.cells[i].entry_sq);
                REQUIRE(parts.cells[i].exit_sq == whole.cells[i].exit_sq);
                REQUIRE(parts.cells[i].peak.entry_sq == whole.cells[i].peak.entry_sq);
            }
        }
    }
}

TEST_CASE("a pass over nothing is complete at once", "[pass]") {
    std::vector<PlannedCell<double>> none;
    MachineSettings machine;
    machine.axes = 1;
    const auto limits = MotionLimits<double>::make(machine).value();
    CellWindow<double> window(none);
    BackwardPass<double> pass;
    pass.begin(window, {}, false);
    WorkBudget budget(1);
    CHECK(pass.run(window, limits, budget));
    CHECK(pass.last_final() == 0);
}
