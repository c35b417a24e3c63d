// SPDX-License-Identifier: MIT
//
// What comes behind a stop may be unknown for long (M66 waits for an input): the path up to it is there, and the same.
#include "splinefeed/s1_blended_path/tolerance_path.hpp"
#include "splinefeed/s2_arc_length/arc_length.hpp"
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <vector>

using namespace splinefeed;

namespace {

/// So many lines of a wave; the last one stops.
std::vector<PathElement<double>> wave(int count, double tolerance_mm, double turn) {
    std::vector<PathElement<double>> moves;
    for (int i = 1; i <= count; ++i) {
        PathElement<double>& move = moves.emplace_back();
        move.to[0] = position_from_mm(i);
        move.to[1] = position_from_mm(turn * (i % 2) + std::sin(0.3 * i));
        move.tolerance_mm = tolerance_mm;
        move.mode = tolerance_mm > 0.0 ? PathMode::continuous : PathMode::exact_path;
    }
    moves.back().stop_at_end = true;
    return moves;
}

struct Bench {
    Bench() { REQUIRE(path.start({}).ok()); }
    void push(const std::vector<PathElement<double>>& moves) {
        for (const PathElement<double>& move : moves) {
            if (!path.has_room()) {
                static_cast<void>(pull());
            }
            REQUIRE(path.push(move).ok());
        }
    }
    /// All that there is.
    Pull pull() {
        CurveSegment<double> segment;
        Pull pull = path.next(segment);
        for (; pull == Pull::item; pull = path.next(segment)) {
            segments.push_back(segment);
        }
        return pull;
    }

    TolerancePath<double> path{2, {0.001}};
    std::vector<CurveSegment<double>> segments;
};

} // namespace

TEST_CASE("The path up to a stop needs nothing that comes behind, and does not depend on it") {
    for (const int count : {1, 2, 3, 5, 12, 40}) {
        for (const double tolerance_mm : {0.0, 0.01, 0.2}) {
            for (const double turn : {0.0, 2.0}) {
                CAPTURE(count, tolerance_mm, turn);
                const auto moves = wave(count, tolerance_mm, turn);
                Bench bench;
                bench.push(moves);
                CHECK(bench.pull() == Pull::starved);
                REQUIRE_FALSE(bench.segments.empty());
                const CurveSegment<double> last = bench.segments.back();
                CHECK(last.stop_at_end);
                CHECK(last.end[0] == moves.back().to[0]);
                CHECK(last.end[1] == moves.back().to[1]);
                Bench whole;
                whole.push(moves);
                REQUIRE(whole.path.finish().ok());
                CHECK(whole.pull() == Pull::finished);
                REQUIRE(whole.segments.size() == bench.segments.size());
                for (std::size_t i = 0; i < whole.segments.size(); ++i) {
                    CHECK(whole.segments[i].control == bench.segments[i].control);
                }
                PathElement<double> more; // it goes on from there
                more.to[0] = position_from_mm(100.0);
                bench.push({more, more});
                REQUIRE(bench.path.finish().ok());
                CHECK(bench.pull() == Pull::finished);
                CHECK(bench.segments.back().end[0] == more.to[0]);
            }
        }
    }
}

TEST_CASE("Without a stop the path waits for what comes behind") {
    auto moves = wave(3, 0.01, 2.0);
    moves.back().stop_at_end = false;
    Bench bench;
    bench.push(moves);
    CHECK(bench.pull() == Pull::starved);
    CHECK((bench.segments.empty() || bench.segments.back().end[0] != moves.back().to[0]));
}

TEST_CASE("The cells up to a stop need no segment behind it") {
    Bench bench;
    bench.push(wave(3, 0.0, 0.0));
    MachineSettings machine;
    machine.axes = 2;
    machine.axis[0] = machine.axis[1] = {.max_velocity_mm_s = 100.0, .max_acceleration_mm_s2 = 1000.0};
    const auto limits = MotionLimits<double>::make(machine);
    REQUIRE(limits.has_value());
    ArcLength<double> cells(bench.path, limits->refinement);
    Cell<double> cell;
    Pull pull = cells.next(cell);
    int count = 0;
    for (; pull == Pull::item; pull = cells.next(cell)) {
        ++count;
    }
    CHECK(pull == Pull::starved);
    REQUIRE(count > 0);
    CHECK(cell.stop_at_end);
    CHECK(cell.end[0] == position_from_mm(3.0));
}
