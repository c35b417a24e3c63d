// SPDX-License-Identifier: MIT
#include "splinefeed/s3_feed_plan/jerk/jerk_window.hpp"

#include "support/catch.hpp"
#include "support/random_steering.hpp"

#include <array>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

/// A cell along x, with this q'' of y [1/mm] and this direction of y.
Cell<double> cell_with_bend(double bend_per_mm, double length_mm, double turn = 0.0) {
    Cell<double> cell;
    cell.axes = 2;
    cell.length_mm = cell.measured_mm = length_mm;
    cell.shape[0].tangent = {1.0, 1.0};
    cell.shape[1].tangent = {turn, turn};
    cell.shape[1].bend.fill(2.0 * cell.length_mm * bend_per_mm);
    return cell;
}

MachineSettings two_axes() {
    return with_jerk(machine_of(2, 100.0, 1000.0, 100.0), 20000.0);
}

} // namespace

TEST_CASE("two long cells whose bends differ have a stop between them, in each place of the window",
          "[feed_plan][jerk]") {
    const auto limits = MotionLimits<double>::make(two_axes()).value();
    std::array<Cell<double>, 8> cells;
    std::array<JerkNode<double>, 9> nodes;
    std::array<LegNode<double>, 9> scratch;
    JerkWindow<double, double> window(limits, {cells, nodes, scratch});
    const double fast_sq = 50.0 * 50.0;
    for (const double bend_per_mm : {0.0, 0.2, 0.2, 0.2, -0.2, -0.2}) {
        window.append(cell_with_bend(bend_per_mm, 1.0), fast_sq, fast_sq, fast_sq);
    }
    for (std::size_t i = 0; i < window.size(); ++i) {
        CAPTURE(i);
        CHECK(window.cell(i).stop_at_end == (i == 0 || i == 3));
    }
    // What bends as slowly as the jerk allows needs none.
    window.clear();
    const double slow_sq = 0.05;
    for (const double bend_per_mm : {0.0, 0.2}) {
        window.append(cell_with_bend(bend_per_mm, 1.0), slow_sq, slow_sq, slow_sq);
    }
    CHECK(!window.cell(0).stop_at_end);
}

TEST_CASE("beside a kink something of the limits is kept; short cells get a cap, others a stop", "[feed_plan][jerk]") {
    const auto limits = MotionLimits<double>::make(two_axes()).value();
    std::array<Cell<double>, 32> cells;
    std::array<JerkNode<double>, 33> nodes;
    std::array<LegNode<double>, 33> scratch;
    JerkWindow<double, double> window(limits, {cells, nodes, scratch});
    const double fast_sq = 50.0 * 50.0;
    const auto turned = [&](double turn, double length_mm) { // behind the cell 3
        window.clear();
        for (int i = 0; i < 8; ++i) {
            window.append(cell_with_bend(0.0, length_mm, i > 3 ? turn : 0.0), fast_sq, fast_sq, fast_sq);
        }
    };
    turned(2e-5, 0.09); // v d / T^2 = 1000 mm/s^3 of 20000, seen for 2 ms at 50 mm/s
    for (std::size_t i = 0; i < window.size(); ++i) {
        CAPTURE(i);
        const bool beside = i >= 2 && i < 6;
        CHECK(window.node(i).kept == (beside ? Approx(0.05).epsilon(0.01) : Approx(0.0)));
        CHECK(window.limits_of(i).share == Approx(beside ? 0.95 : 1.0).epsilon(0.001));
        CHECK(window.node(i).cap_sq == fast_sq);
        CHECK(!window.cell(i).stop_at_end);
    }
    turned(5e-4, 0.09); // 0.15 of the limits at 6 mm/s
    for (std::size_t i = 0; i < window.size(); ++i) {
        CAPTURE(i);
        const bool beside = i == 3 || i == 4;
        CHECK(std::sqrt(window.node(i).cap_sq) == Approx(beside ? 6.0 : 50.0).epsilon(0.01));
        CHECK(window.node(i).most_sq == window.node(i).cap_sq);
        CHECK(!window.cell(i).stop_at_end);
    }
    turned(5e-4, 1.0);
    CHECK(window.cell(3).stop_at_end);
    turned(1e-9, 0.09); // rounding
    CHECK(window.node(3).kept == 0.0F);
}
