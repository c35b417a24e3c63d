// SPDX-License-Identifier: MIT
#include "splinefeed/s3_feed_plan/jerk/jerk_window.hpp"

#include "support/catch.hpp"
#include "support/random_steering.hpp"

#include <array>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

/// A cell of 0.1 mm along x, with this q'' of y [1/mm].
Cell<double> cell_with_bend(double bend_per_mm) {
    Cell<double> cell;
    cell.axes = 2;
    cell.length_mm = cell.measured_mm = 0.1;
    cell.shape[0].tangent = {1.0, 1.0};
    cell.shape[1].bend.fill(2.0 * cell.length_mm * bend_per_mm);
    return cell;
}

} // namespace

TEST_CASE("two cells whose bends differ have a stop between them, in each place of the window", "[feed_plan][jerk]") {
    MachineSettings machine;
    machine.axes = 2;
    machine.max_feed_mm_s = 100.0;
    for (AxisSettings& axis : machine.axis) {
        axis = {.max_velocity_mm_s = 100.0, .max_acceleration_mm_s2 = 1000.0, .max_jerk_mm_s3 = 20000.0};
    }
    const auto limits = MotionLimits<double>::make(machine).value();
    std::array<Cell<double>, 8> cells;
    std::array<JerkNode<double>, 9> nodes;
    std::array<LegNode<double>, 9> scratch;
    JerkWindow<double, double> window(limits, {cells, nodes, scratch});
    const double fast_sq = 50.0 * 50.0;
    for (const double bend_per_mm : {0.0, 0.2, 0.2, 0.2, -0.2, -0.2}) {
        window.append(cell_with_bend(bend_per_mm), fast_sq, fast_sq, fast_sq);
    }
    for (std::size_t i = 0; i < window.size(); ++i) {
        CAPTURE(i);
        CHECK(window.cell(i).stop_at_end == (i == 0 || i == 3));
    }
    // What bends as slowly as the jerk allows needs none.
    window.clear();
    const double slow_sq = 0.05;
    for (const double bend_per_mm : {0.0, 0.2}) {
        window.append(cell_with_bend(bend_per_mm), slow_sq, slow_sq, slow_sq);
    }
    CHECK(!window.cell(0).stop_at_end);
}
