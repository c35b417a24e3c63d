// SPDX-License-Identifier: MIT
//
// A straight leg in motion: where it rests, and what it cuts for that.
#include "splinefeed/s3_feed_plan/jerk/straight_leg.hpp"

#include "support/catch.hpp"
#include "support/pipeline.hpp"

#include <optional>

using namespace splinefeed_test;

namespace {

/// A line of one leg in a window, and memory for it.
struct Line {
    explicit Line(std::size_t spare) : machine(machine_of(1, 100.0, 1000.0, 100.0)) {
        machine.axis[0].max_jerk_mm_s3 = 1e5;
        limits = MotionLimits<double>::make(machine).value();
        ListSource<double> source(BezierPath(8, line_shape(1, 3, {0.5})));
        planned = plan_of<double>(source, limits, 256);
        cells.resize(planned.cells.size() + spare);
        nodes.resize(cells.size() + 1);
        scratch.resize(nodes.size());
        window.emplace(limits, JerkStorage<double, double>{cells, nodes, scratch});
        for (const PlannedCell<double>& c : planned.cells) {
            window->append(c.cell, c.cap.least_sq(), c.cap.least_sq(), c.exit_sq);
        }
        for (std::size_t i = 0; i < window->size(); ++i) {
            window->node(i).travel = Travel::line;
            end_mm.push_back((i > 0 ? end_mm.back() : 0.0) + window->node(i).length_mm);
        }
    }

    MachineSettings machine;
    MotionLimits<double> limits{};
    Planned<double> planned;
    std::vector<Cell<double>> cells;
    std::vector<JerkNode<double>> nodes;
    std::vector<LegNode<double>> scratch;
    std::optional<JerkWindow<double, double>> window;
    std::vector<double> end_mm; ///< of each cell
};

/// A steady speed that is braked from over so many millimetres.
SpeedState braked_over(double length_mm, const MoveLimits& limits) {
    double low = 0.0;
    double high = 100.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (SCurveProfile::to_rest({0.0, middle, 0.0}, limits).length_mm() > length_mm ? high : low) = middle;
    }
    return {low * low, 0.0};
}

} // namespace

TEST_CASE("a straight leg rests where a cell ends, and cuts nothing off that is next to nothing", "[feed_plan][jerk]") {
    constexpr double from = 0.25;
    const std::size_t size = Line(1).window->size();
    REQUIRE(size > 5);
    for (const double beyond : {-1e-6, -1e-8, 1e-6}) {
        for (std::size_t i = 1; i < size; ++i) {
            Line line(0); // nor is there room for a cut
            StraightLeg<double, double> leg(*line.window);
            REQUIRE(leg.cells() == size);
            const double way = line.end_mm[i] - from * line.end_mm[0];
            CAPTURE(beyond, i, size, way);
            const bool rests = leg.to_rest(from, braked_over(way + beyond, leg.limits()));
            if (i + 1 == size) {
                CHECK_FALSE(rests); // there the leg ends anyway
            } else if (beyond < 0.0) {
                REQUIRE(rests);
                CHECK(leg.cells() == i + 1);
                CHECK(leg.move().length_mm() == Approx(way).epsilon(1e-6));
            } else {
                CHECK_FALSE(rests); // a little farther is a cell that has to be cut
            }
            CHECK(line.window->size() == size);
        }
    }
}

TEST_CASE("a straight leg rests as near as it can, and cuts the cell there", "[feed_plan][jerk]") {
    constexpr double from = 0.25;
    const std::size_t size = Line(1).window->size();
    for (std::size_t i = 1; i < size; ++i) {
        for (const std::size_t spare : {0U, 1U}) {
            Line line(spare);
            StraightLeg<double, double> leg(*line.window);
            const double cell = line.end_mm[i] - line.end_mm[i - 1];
            const double way = line.end_mm[i] - 0.3 * cell - from * line.end_mm[0];
            CAPTURE(i, spare, way);
            const SpeedState state = braked_over(way, leg.limits());
            REQUIRE(leg.to_rest(from, state) == (spare > 0));
            if (spare > 0) {
                CHECK(leg.cells() == i + 1);
                CHECK(leg.move().length_mm() == Approx(way).epsilon(1e-6));
                CHECK(line.window->size() == size + 1);
                CHECK(line.window->node(i).length_mm == Approx(0.7 * cell).epsilon(1e-4));
                CHECK(line.window->node(i + 1).length_mm == Approx(0.3 * cell).epsilon(1e-4));
            }
        }
    }
}
