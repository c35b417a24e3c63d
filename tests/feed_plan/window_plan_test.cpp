// SPDX-License-Identifier: MIT
#include "splinefeed/s3_feed_plan/jerk/window_plan.hpp"

#include "support/catch.hpp"
#include "support/pipeline.hpp"

#include <array>

using namespace splinefeed;
using namespace splinefeed_test;

// The input is late: the leg ends with the window, and more of it may come.
TEST_CASE("of a leg of any length that ends with the window, a part is final", "[feed_plan][jerk]") {
    const auto limits = MotionLimits<double>::make(with_jerk(machine_of(2, 100.0, 1000.0, 100.0), 20000.0)).value();
    std::array<Cell<double>, 16> cells;
    std::array<JerkNode<double>, 17> nodes;
    std::array<LegNode<double>, 17> scratch;
    for (std::size_t length = LegPlan<double>::fewest_cells; length < 12; ++length) {
        JerkWindow<double, double> window(limits, {cells, nodes, scratch});
        WindowPlan<double, double> plan(window);
        for (std::size_t i = 0; i < length; ++i) {
            Cell<double> cell;
            cell.axes = 2;
            cell.length_mm = cell.measured_mm = 0.1;
            cell.shape[0].tangent = {1.0, 1.0};
            cell.shape[1].bend.fill(2.0 * cell.length_mm * 0.01); // q'' = 0.01 / mm
            window.append(cell, 400.0, 400.0, 400.0);
        }
        plan.begin(false);
        bool done = false;
        for (int call = 0; call < 100 && !done; ++call) {
            WorkBudget work(1000);
            done = plan.run(work);
        }
        CAPTURE(length);
        CHECK(done);
        CHECK(plan.searched_legs() == 1);
        CHECK(plan.planned() == length);
        CHECK((plan.committed() > 0 && plan.committed() < length));
        CHECK((plan.complete() && !plan.running()));
    }
}
