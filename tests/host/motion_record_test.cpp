// SPDX-License-Identifier: MIT
#include "host_sim/report/motion_record.hpp"

#include "support/catch.hpp"
#include "support/machine_motion.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

// From 0 to 20 mm and back at 100 mm/s, from rest to rest each way: at 1000 mm/s^2 it takes 0.3 s.
std::vector<long double> there_and_back() {
    std::vector<long double> samples;
    const auto way = [](int ms) {
        const long double t = 1e-3L * ms;
        return t < 0.1L   ? 500.0L * t * t
               : t < 0.2L ? 5.0L + 100.0L * (t - 0.1L)
                          : 20.0L - 500.0L * (0.3L - t) * (0.3L - t);
    };
    for (int ms = 0; ms <= 300; ++ms) {
        samples.push_back(way(ms));
    }
    for (int ms = 1; ms <= 300; ++ms) {
        samples.push_back(20.0L - way(ms));
    }
    return samples;
}

struct Recorded {
    MachineDescription machine = machine_of({"x", "y"});
    MotionRecord record{machine, millisecond};
    LimitShare share{machine.settings};

    void run(const Motion& motion) {
        for (const FeedSegment& segment : motion) {
            share.segment(segment);
            record.segment(segment, share);
        }
    }
};

} // namespace

TEST_CASE("a motion there and back: its extremes, its stop and its length") {
    Recorded recorded;
    recorded.record.come_to(0, 1, std::nullopt);
    recorded.run(motion_of(there_and_back()));
    recorded.record.finish();
    const TimeStrips& strips = recorded.record.strips();
    float fastest = 0.0F;
    float hardest = 0.0F;
    for (std::size_t i = 0; i < strips.bins().size(); ++i) {
        fastest = std::max(fastest, strips.range(i, 1).high);
        hardest = std::max(hardest, -strips.range(i, 2).low);
    }
    CHECK(fastest == Approx(1.0).epsilon(1e-3));
    CHECK(hardest == Approx(1.0).epsilon(1e-3));
    REQUIRE(recorded.record.stops().size() >= 1);
    const MotionRecord::Stop& stop = recorded.record.stops().front();
    CHECK(stop.position[0] == Approx(20.0));
    CHECK(stop.turn_deg == Approx(180.0));
    CHECK(stop.why == MotionRecord::Why::turn);
    CHECK(recorded.record.stops().back().why == MotionRecord::Why::end);
    CHECK(recorded.record.totals()[0].length_mm == Approx(40.0));
    CHECK(recorded.record.totals()[0].max_speed_mm_s == Approx(100.0).epsilon(1e-3));
    CHECK(recorded.record.length_mm() == Approx(40.0));
    const auto& points = recorded.record.path().points();
    CHECK(points.front().position[0] == 0.0);
    CHECK(points.back().length_mm == Approx(40.0));
    const bool has_end = std::any_of(points.begin(), points.end(), [](const ThinnedPath::Point& point) {
        return std::fabs(point.position[0] - 20.0) < 1e-3 && point.keep;
    });
    CHECK(has_end);
    double way = 0.0;
    double wanted = 0.0;
    for (const ThinnedPath::Point& point : points) {
        way += static_cast<double>(point.way);
        wanted += static_cast<double>(point.wanted);
    }
    CHECK(way == Approx(40.0).epsilon(1e-4));
    CHECK(wanted == Approx(1000.0 * recorded.record.totals()[0].seconds)); // the machine's feed
}

TEST_CASE("a program: the kinds of its moves, its lines, and a dwell") {
    Recorded recorded;
    MotionRecord& record = recorded.record;
    record.start({});
    PathElement<double> move;
    move.to[0] = position_from_mm(20.0);
    record.move(move, true, 4);
    move.to[0] = position_from_mm(0.0);
    move.mode = PathMode::exact_stop;
    record.move(move, false, 5);
    const Motion motion = motion_of(there_and_back());
    const std::size_t half = motion.size() / 2;
    record.come_to(0, 4, 0);
    recorded.run({motion.begin(), motion.begin() + static_cast<std::ptrdiff_t>(half)});
    record.come_to(1, 5, 1);
    recorded.run({motion.begin() + static_cast<std::ptrdiff_t>(half), motion.end()});
    FeedSegment stands{.duration_ticks = millisecond};
    record.dwells(6);
    recorded.run({stands, stands});
    record.finish();
    CHECK(record.totals()[1].length_mm == Approx(20.0).epsilon(0.01)); // a rapid
    CHECK(record.totals()[0].length_mm == Approx(20.0).epsilon(0.01));
    CHECK(record.lines().lines()[4].seconds == Approx(0.3).epsilon(0.05));
    CHECK(record.lines().lines()[6].seconds == Approx(0.002));
    CHECK(record.programmed().points().size() == 3);
    CHECK(record.stops().back().stood_s >= 0.002);
    CHECK(record.stops().back().why == MotionRecord::Why::end);
}

TEST_CASE("the lines of a chain share its time by their length") {
    Recorded recorded;
    MotionRecord& record = recorded.record;
    record.start({});
    double at_mm = 0.0;
    for (const auto& [line, way_mm] : {std::pair{3U, 5.0}, {4U, 10.0}, {5U, 0.0}, {6U, 5.0}, {7U, -20.0}}) {
        PathElement<double> move;
        move.to[0] = position_from_mm(at_mm += way_mm);
        record.move(move, false, line);
    }
    const Motion motion = motion_of(there_and_back());
    const auto half = motion.begin() + static_cast<std::ptrdiff_t>(motion.size() / 2);
    record.come_to(3, 6, 3);
    recorded.run({motion.begin(), half});
    record.come_to(4, 7, 4);
    recorded.run({half, motion.end()});
    record.finish();
    // 5 mm of speeding up at 1000 mm/s^2, 10 mm at 100 mm/s, 5 mm of braking.
    const auto& lines = record.lines().lines();
    CHECK(lines[3].seconds == Approx(0.1).margin(0.003));
    CHECK(lines[4].seconds == Approx(0.1).margin(0.003));
    CHECK(lines[5].seconds == Approx(0.0).margin(1e-9));
    CHECK(lines[6].seconds == Approx(0.1).margin(0.003));
    CHECK(lines[4].start_s == Approx(0.1).margin(0.003));
    CHECK(lines[6].start_s == Approx(0.2).margin(0.003));
    CHECK(lines[4].way_mm == 10.0F);
    double seconds = 0.0;
    for (const LineTimes::Line& line : lines) {
        seconds += line.seconds;
    }
    CHECK(seconds == Approx(1e-3 * static_cast<double>(motion.size())).epsilon(1e-9));
}

TEST_CASE("tools have their time, and of very many events the first ones are kept") {
    Recorded recorded;
    MotionRecord& record = recorded.record;
    const Motion motion = motion_of(there_and_back());
    recorded.run({motion.begin(), motion.begin() + 100});
    record.happened({0.1, 1, "change_tool", 3, 0.0, {}}, EventKind::tool_change);
    recorded.run({motion.begin() + 100, motion.end()});
    for (std::size_t i = 0; i < MotionRecord::most_events; ++i) {
        record.happened({1.0, 2, "spindle_speed", 0, 1000.0, {}}, EventKind::spindle_speed);
    }
    REQUIRE(record.tools().size() == 2);
    CHECK(record.tools().at(0) == Approx(0.1));
    CHECK(record.tools().at(3) == Approx(0.001 * static_cast<double>(motion.size() - 100)));
    CHECK(record.events().size() == MotionRecord::most_events);
    CHECK(record.events().front().number == 3);
}

TEST_CASE("waypoints that would cover the path are not kept, and deviations are kept in bounded memory") {
    Recorded recorded;
    for (std::size_t i = 0; i < MotionRecord::most_waypoints; ++i) {
        recorded.record.waypoint({});
    }
    CHECK(recorded.record.waypoints().size() == MotionRecord::most_waypoints);
    recorded.record.waypoint({});
    CHECK(recorded.record.waypoints().empty());
    for (std::uint64_t row = 0; row < 500'000; ++row) {
        recorded.record.deviates(row, row == 300'000 ? 0.5 : 0.001);
    }
    const auto& deviations = recorded.record.deviations();
    CHECK(deviations.size() <= MotionRecord::most_rows);
    CHECK(deviations[300'000 / recorded.record.rows_together()] == 0.5F);
    CHECK(deviations[0] == 0.001F);
}
