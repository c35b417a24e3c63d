// SPDX-License-Identifier: MIT
//
// Where the machine must stop, how cells are graded there, and that the source may starve anywhere.
#include "splinefeed/number/path_position.hpp"
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"
#include "support/catch.hpp"
#include "support/cell_reference.hpp"

using namespace splinefeed_test;

namespace {

template <class S>
std::vector<Cell<S>> cut(const BezierPath& path, const MachineSettings& machine = {}, std::uint64_t seed = 0,
                         int patience = 0, int* starvations = nullptr) {
    MachineSettings settings = machine;
    settings.axes = path.front().axes;
    ListSource<S> source(path, seed, patience);
    return cells_of<S>(source, MotionLimits<S>::make(settings).value().refinement, 1U << 18, starvations);
}

/// Waypoints of the segments whose last cell stops.
template <class S>
std::vector<std::uint32_t> stops_of(const std::vector<Cell<S>>& cells) {
    std::vector<std::uint32_t> stops;
    for (const Cell<S>& cell : cells) {
        if (cell.stop_at_end) {
            stops.push_back(cell.waypoint);
        }
    }
    return stops;
}

/// Two straight lines of 10 mm in the plane, the second turned by an angle.
BezierPath bend(double angle) {
    return {line_shape(2, 3, {10.0, 0.0}), line_shape(2, 3, {10.0 * std::cos(angle), 10.0 * std::sin(angle)})};
}

template <class S>
bool equal(const Cell<S>& a, const Cell<S>& b) {
    return a.axes == b.axes && a.degree == b.degree && a.unit_log2 == b.unit_log2 && a.origin == b.origin &&
           a.end == b.end && a.power == b.power && a.inverse == b.inverse && a.length_mm == b.length_mm &&
           a.tangent_max == b.tangent_max && a.curvature_max == b.curvature_max && a.feed_mm_s == b.feed_mm_s &&
           a.stop_at_end == b.stop_at_end && a.waypoint == b.waypoint;
}

} // namespace

TEMPLATE_TEST_CASE("a jump of direction is a stop, a smooth joint is none", "[arc_length]", double, float, Fixed) {
    using Stops = std::vector<std::uint32_t>;
    CHECK(stops_of(cut<TestType>(bend(0.0))) == Stops{1});
    for (const double angle : {1e-3, 0.1, 1.0, 1.5707963267948966, 3.0, 3.141592653589793}) {
        CHECK(stops_of(cut<TestType>(bend(angle))) == Stops{0, 1});
    }
    // What an axis does not feel: at 100 mm/s within 1 ms, a jump of d asks for 1e5 d mm/s2 of the 1000
    CHECK(stops_of(cut<TestType>(bend(1e-7))) == Stops{1});
    CHECK(stops_of(cut<TestType>(bend(1e-5))) == Stops{0, 1});

    Random random(21);
    BezierPath path{random_shape(random, 3, 3, 20.0)};
    for (int i = 0; i < 30; ++i) {
        TestShape next = random_shape(random, 3, random.integer(3, 6), random.decades(2.0, 50.0));
        join_smoothly(path.back(), next);
        path.push_back(next);
    }
    CHECK(stops_of(cut<TestType>(path)) == Stops{30});
    path[7].stop_at_end = path[20].stop_at_end = true;
    CHECK(stops_of(cut<TestType>(path)) == Stops{7, 20, 30});
}

TEMPLATE_TEST_CASE("a segment that starts or ends with a vanishing tangent stops there", "[arc_length]", double,
                   Fixed) {
    const BezierPath path{line_shape(2, 3, {10.0, 0.0}), cubic_shape(0.0, 0.0, 5.0, 1.0, 10.0, 0.0),
                          cubic_shape(3.0, 0.0, 10.0, 0.0, 10.0, 0.0), line_shape(2, 3, {10.0, 0.0})};
    CHECK(stops_of(cut<TestType>(path)) == std::vector<std::uint32_t>{0, 1, 2, 3});
}

TEMPLATE_TEST_CASE("the end of a stopping cell is the target to the last bit", "[arc_length]", double, float, Fixed) {
    Random random(22);
    for (int i = 0; i < 20; ++i) {
        BezierPath path;
        for (int j = 0; j < 4; ++j) {
            path.push_back(random_shape(random, 3, 3, random.decades(0.01, 100.0)));
            path.back().stop_at_end = true;
        }
        const auto segments = segments_of<TestType>(path);
        for (const auto& cell : cut<TestType>(path)) {
            if (cell.stop_at_end) {
                REQUIRE(cell.end == segments[cell.waypoint].end);
            }
        }
    }
}

TEMPLATE_TEST_CASE("cells carry feed and waypoint of their segment", "[arc_length]", double, float, Fixed) {
    Random random(23);
    BezierPath path;
    for (int i = 0; i < 10; ++i) {
        path.push_back(random_shape(random, 2, 3, 10.0));
        path.back().feed_mm_s = i % 3 == 0 ? 0.0 : 10.0 + i;
        path.back().max_feed_mm_s = i % 2 == 0 ? 0.0 : 20.0 + i;
    }
    std::uint32_t last = 0;
    for (const auto& cell : cut<TestType>(path)) {
        REQUIRE((cell.waypoint == last || cell.waypoint == last + 1));
        last = cell.waypoint;
        REQUIRE(to_double(cell.feed_mm_s) == path[last].feed_mm_s);
        REQUIRE(to_double(cell.max_feed_mm_s) == path[last].max_feed_mm_s);
    }
    REQUIRE(last == 9);
}

TEMPLATE_TEST_CASE("cells are graded towards stops", "[arc_length]", double, Fixed) {
    // From a stop the first cell is at most 1/7.3 of the braking distance feed^2 / (2 A), as far as a segment can be
    // halved: 18 times.
    for (const double feed : {1.0, 10.0, 100.0}) {
        for (const double acceleration : {100.0, 1000.0, 10000.0}) {
            MachineSettings machine;
            for (AxisSettings& axis : machine.axis) {
                axis.max_acceleration_mm_s2 = acceleration;
            }
            BezierPath path{cubic_shape(7.0, 3.0, 13.0, 7.0, 20.0, 10.0),
                            cubic_shape(1.5, -5.0, 3.5, -10.0, 5.0, -15.0)};
            path[0].feed_mm_s = feed;
            path[1].feed_mm_s = feed * 2.0;
            const auto cells = cut<TestType>(path, machine);
            for (std::size_t i = 0; i < cells.size(); ++i) {
                const bool from_rest = i == 0 || cells[i - 1].stop_at_end;
                if (from_rest || cells[i].stop_at_end) {
                    const double own = std::min(100.0, path[cells[i].waypoint].feed_mm_s);
                    const double grade = own * own / (7.3 * 2.0 * acceleration);
                    // 2 %: the reciprocal of the largest acceleration has few bits in Fixed
                    CHECK(to_double(cells[i].length_mm) <= std::max(grade, 22.4 / (1 << 18)) * 1.02);
                }
            }
        }
    }
    // Between two stops there are cells enough to get going, however short the move. A line needs them only with a jerk
    // limit in Fixed, where rounding needs short cells: else the speed has its peak within a cell.
    MachineSettings jerky;
    jerky.axis[0].max_jerk_mm_s3 = 30000.0;
    for (const double length : {2e-4, 1e-3, 0.1, 1.0}) {
        CHECK(cut<TestType>({cubic_shape(length / 3.0, length / 9.0, length / 1.5, 0.0, length, 0.0)}).size() >= 8);
        CHECK(cut<TestType>({line_shape(1, 3, {length})}).size() ==
              (length > 0.01 ? 1 : 8)); // of a short one few digits
        const std::size_t jerk_limited = cut<TestType>({line_shape(1, 1, {length})}, jerky).size();
        CHECK((std::same_as<TestType, double> ? jerk_limited == 1 : jerk_limited >= 8));
        CHECK(cut<TestType>({line_shape(1, 1, {length})}).size() == 1);
    }
}

TEMPLATE_TEST_CASE("a smooth joint costs three halvings, not a grading", "[arc_length]", double, Fixed) {
    const auto cells =
        cut<TestType>({line_shape(2, 3, {20.0, 0.0}), line_shape(2, 3, {20.0, 0.0}), line_shape(2, 3, {20.0, 0.0})});
    for (std::size_t i = 1; i < cells.size(); ++i) {
        if (cells[i].waypoint == 1) {
            CHECK(to_double(cells[i].length_mm) > 20.0 / 8.5);
        }
    }
}

TEMPLATE_TEST_CASE("a line behind a curve is straight", "[arc_length]", double, float, Fixed) {
    const BezierPath path{cubic_shape(1.0, 3.0, 2.0, -3.0, 4.0, 0.0), line_shape(2, 1, {10.0, 5.0})};
    for (const auto& cell : cut<TestType>(path)) {
        if (cell.waypoint == 1) {
            // What rounding may be: 1e-8 of the unit (float: 0.2), seen over cells of more than 1e-4 mm
            CHECK(to_double(cell.curvature_max[0]) < (std::same_as<TestType, float> ? 1.0 : 1e-3));
        }
    }
}

TEMPLATE_TEST_CASE("a cusp inside of a segment is a stop", "[arc_length]", double, Fixed) {
    for (const TestShape& shape :
         {cubic_shape(10.0, 10.0, 0.0, 10.0, 10.0, 0.0), cubic_shape(1.0, 0.0, 1.0, 0.0, 0.0, 0.0)}) {
        const auto cells = cut<TestType>({shape, line_shape(2, 1, {-5.0, 0.0})});
        std::size_t chords = 0;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            // What is left of the cusp is one chord, a nothing, with a stop on both sides
            if (is_chord(cells[i])) {
                ++chords;
                REQUIRE(i + 1 < cells.size());
                CHECK(cells[i].stop_before);
                CHECK(cells[i + 1].stop_before);
                CHECK(to_double(cells[i].length_mm) < 1e-3);
            }
        }
        CHECK(chords == 1);
        CHECK(stops_of(cells).back() == 1);
    }
}

TEMPLATE_TEST_CASE("cells keep to the longest length and the largest turn", "[arc_length]", double, Fixed) {
    Random random(24);
    for (int i = 0; i < 30; ++i) {
        MachineSettings machine;
        machine.axes = 3;
        machine.sample_period_us = random.integer(50, 2000);
        const auto limits = MotionLimits<TestType>::make(machine).value();
        ListSource<TestType> source(BezierPath{random_shape(random, 3, random.integer(3, 9), 200.0)});
        for (const auto& cell : cells_of<TestType>(source, limits.refinement)) {
            const Direction from = direction_at(cell, 0.0L);
            const Direction middle = direction_at(cell, 0.5L);
            const Direction to = direction_at(cell, 1.0L);
            for (unsigned k = 0; k < 3; ++k) {
                const Real way = exact(cell.length_mm) * std::fabs(middle.tangent[k]);
                REQUIRE(way <= 1.000001L * exact(limits.refinement.longest_mm[k]));
                REQUIRE(std::fabs(to.tangent[k] - from.tangent[k]) < 0.0614L);
                REQUIRE(std::fabs(to.curvature[k] - from.curvature[k]) * exact(cell.length_mm) < 0.0128L);
            }
            REQUIRE(evaluate(cell, 0.0L).speed(3) < 1.49L * evaluate(cell, 1.0L).speed(3));
            REQUIRE(evaluate(cell, 1.0L).speed(3) < 1.49L * evaluate(cell, 0.0L).speed(3));
        }
    }
}

TEMPLATE_TEST_CASE("underrun changes no cell", "[arc_length]", double, float, Fixed) {
    Random random(25);
    BezierPath path;
    for (int i = 0; i < 12; ++i) {
        path.push_back(random_shape(random, 3, 3, 10.0));
        if (i > 0 && i % 4 != 0) {
            join_smoothly(path[path.size() - 2], path.back());
        }
    }
    const auto reference = cut<TestType>(path);
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        int starvations = 0;
        const auto cells = cut<TestType>(path, {}, seed, 3, &starvations);
        REQUIRE(starvations > 0);
        REQUIRE(cells.size() == reference.size());
        for (std::size_t i = 0; i < cells.size(); ++i) {
            REQUIRE(equal(cells[i], reference[i]));
        }
    }
}

TEMPLATE_TEST_CASE("lengths and segments are counted", "[arc_length]", double, float, Fixed) {
    ListSource<TestType> source(BezierPath{line_shape(2, 3, {3.0, 4.0}), line_shape(2, 1, {-6.0, 8.0})});
    const auto limits = MotionLimits<TestType>::make({.axes = 2}).value();
    ArcLength<TestType> arc_length(source, limits.refinement);
    Cell<TestType> cell;
    REQUIRE(arc_length.segments() == 0);
    while (arc_length.next(cell) == Pull::item) {
    }
    REQUIRE(arc_length.segments() == 2);
    REQUIRE(length_to_mm(arc_length.travelled()) == Approx(15.0).epsilon(1e-6));
    REQUIRE(arc_length.next(cell) == Pull::finished);
    REQUIRE(arc_length.next(cell) == Pull::finished);
}
