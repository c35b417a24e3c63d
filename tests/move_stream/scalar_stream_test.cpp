// SPDX-License-Identifier: MIT
//
// What a stream of moves promises whoever drives a motion. The judge of its path is TolerancePath, given the same moves
// with the stops that were asked for.
#include "splinefeed/move_stream/scalar_stream.hpp"

#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_path_rules.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <cmath>
#include <random>
#include <vector>

using namespace splinefeed;

namespace {

MachineSettings two_axes() {
    MachineSettings out;
    out.axes = 2;
    out.axis[0] = out.axis[1] = {200.0, 2000.0, 0.0, 320.0};
    return out;
}

template <Scalar S>
struct Streamed {
    Streamed() { REQUIRE(stream.place({}).ok()); }

    [[nodiscard]] PathElement<double> line(double x, double y = 0.0) const {
        PathElement<double> out;
        out.to[0] = position_from_mm(x);
        out.to[1] = position_from_mm(y);
        out.feed_mm_s = 50.0;
        out.tolerance_mm = 0.05;
        return out;
    }
    /// Segments until there is none; they follow each other.
    std::size_t take(Supply supply) {
        std::size_t count = 0;
        for (FeedSegment next; stream.next(next, supply, WorkBudget::unlimited) == Pull::item; ++count) {
            if (has_last) {
                REQUIRE(next.start == last.end);
                REQUIRE(next.start_velocity == last.end_velocity);
            }
            last = next;
            has_last = true;
        }
        return count;
    }
    [[nodiscard]] double x() const {
        return static_cast<double>(last.end[0]) / static_cast<double>(units_per_count) / 320.0;
    }

    MachineSettings settings = two_axes();
    MotionLimits<S> limits = *MotionLimits<S>::make(settings);
    std::vector<PlannedCell<S>> window = std::vector<PlannedCell<S>>(128);
    AccelerationPlanner<S> planner{window};
    PathRules<S> rules = rules_cast<S>(path_rules(settings));
    ScalarStream<S> stream{limits, planner, rules};
    FeedSegment last;
    bool has_last = false;
};

} // namespace

TEMPLATE_TEST_CASE("the newest move is kept back until a pause, a stop or the end", "[move_stream]", double, float,
                   Fixed) {
    Streamed<TestType> of;
    REQUIRE(of.stream.push(of.line(10.0)).value());
    CHECK(of.stream.keeps_back());
    CHECK(of.take(Supply::flows) == 0);
    CHECK(of.take(Supply::late) == 0);
    CHECK_FALSE(of.stream.exhausted());
    SECTION("a pause") {
        CHECK(of.take(Supply::pauses) > 0);
    }
    SECTION("a stop") {
        REQUIRE(of.stream.stop());
        CHECK_FALSE(of.stream.has_room());
        CHECK_FALSE(of.stream.stands());
        CHECK(of.stream.closed());
        CHECK(of.stream.early(Supply::flows) == Supply::late);
        CHECK(of.stream.push(of.line(20.0)).error() == Error::no_room);
        CHECK(of.take(Supply::late) > 0);
        CHECK(of.stream.stands());
        REQUIRE(of.stream.stop()); // one more thing to do there
        CHECK(of.stream.stands());
        of.stream.go_on();
        CHECK_FALSE(of.stream.stands());
        CHECK(of.stream.push(of.line(20.0)).value());
    }
    SECTION("the end") {
        REQUIRE(of.stream.finish().ok());
        CHECK(of.take(Supply::flows) > 0);
        CHECK(of.stream.state() == Pull::finished);
    }
    CHECK(of.x() == Approx(10.0).margin(1e-5));
    CHECK(of.last.ends_at_rest());
    CHECK(of.stream.passed(1));
}

TEST_CASE("a move that is too short is none, and its stop is one of the move before", "[move_stream]") {
    Streamed<double> of;
    REQUIRE(of.stream.push(of.line(10.0)).value());
    auto again = of.line(10.0);
    again.stop_at_end = true;
    CHECK_FALSE(of.stream.push(again).value());
    CHECK(of.stream.moves() == 1);
    CHECK(of.stream.end()[0] == position_from_mm(10.0));
    REQUIRE(of.stream.push(of.line(20.0, 5.0)).value());
    REQUIRE(of.stream.finish().ok());
    bool stood = false;
    for (FeedSegment next; of.stream.next(next, Supply::flows, WorkBudget::unlimited) == Pull::item;) {
        stood = stood || (next.waypoint == 0 && next.ends_at_rest());
    }
    CHECK(stood);
}

TEST_CASE("what is refused changes nothing", "[move_stream]") {
    Streamed<double> of;
    REQUIRE(of.stream.push(of.line(10.0)).value());
    auto wrong = of.line(20.0);
    wrong.shape = MoveShape::arc;
    wrong.arc.normal[2] = 1.0;
    wrong.arc.sweep_rad = 1.0;
    wrong.arc.centre[0] = position_from_mm(500.0);
    CHECK(of.stream.push(wrong).error() == Error::arc_invalid);
    CHECK(of.stream.moves() == 1);
    CHECK(of.take(Supply::pauses) > 0);
    CHECK(of.x() == Approx(10.0));
}

TEST_CASE("a pause makes no stop at a move that the path has no room for", "[move_stream]") {
    Streamed<double> of;
    of.stream.hold(); // so nothing is taken
    double x = 0.0;
    const auto fill = [&] {
        while (of.stream.push(of.line(x + 0.5, std::sin(0.1 * x))).has_value()) {
            x += 0.5;
        }
    };
    fill();
    of.take(Supply::pauses); // the newest one is still kept back
    REQUIRE(of.stream.keeps_back());
    of.stream.resume();
    bool stood = false;
    for (int i = 0; i < 400; ++i) {
        FeedSegment next;
        fill();
        REQUIRE(of.stream.next(next, Supply::flows, WorkBudget::unlimited) == Pull::item);
        stood = stood || (i > 0 && next.ends_at_rest());
    }
    CHECK_FALSE(stood);
}

TEST_CASE("a hold ends no wait: the machine does not stand where it was asked to", "[move_stream]") {
    Streamed<double> of;
    REQUIRE(of.stream.push(of.line(10.0)).value());
    REQUIRE(of.stream.stop());
    FeedSegment segment;
    REQUIRE(of.stream.next(segment, Supply::late, WorkBudget::unlimited) == Pull::item);
    of.stream.hold();
    of.take(Supply::late);
    CHECK(of.stream.at_rest());
    CHECK_FALSE(of.stream.stands());
    CHECK_FALSE(of.stream.passed(1));
    of.stream.resume();
    of.take(Supply::late);
    CHECK(of.stream.stands());
}

TEST_CASE("a restart goes on from where the motion stands, a place begins elsewhere", "[move_stream]") {
    Streamed<double> of;
    of.stream.override_feed(from_integer<Fixed>(1) / from_integer<Fixed>(2));
    REQUIRE(of.stream.push(of.line(10.0)).value());
    REQUIRE(of.stream.push(of.line(20.0)).value());
    FeedSegment segment;
    for (int i = 0; i < 20; ++i) {
        REQUIRE(of.stream.next(segment, Supply::pauses, WorkBudget::unlimited) == Pull::item);
    }
    of.stream.abort();
    of.take(Supply::flows);
    CHECK_FALSE(of.stream.exhausted()); // what is behind the moves of an aborted motion does not happen
    CHECK_FALSE(of.stream.passed(2));
    of.stream.restart();
    CHECK(of.stream.exhausted());
    CHECK(of.stream.moves() == 0);
    const double here = of.x();
    CHECK(here > 0.0);
    CHECK(to_mm(of.stream.end()[0]) == Approx(here).margin(1e-4));
    REQUIRE(of.stream.push(of.line(-5.0)).value());
    CHECK(of.take(Supply::pauses) > 0); // and begins where the one before ended
    CHECK(of.x() == Approx(-5.0));
    PerAxis<Position> there{};
    there[0] = position_from_mm(100.0);
    REQUIRE(of.stream.place(there).ok());
    of.has_last = false;
    REQUIRE(of.stream.push(of.line(101.0)).value());
    CHECK(of.take(Supply::pauses) > 0);
    CHECK(of.x() == Approx(101.0));
}

TEST_CASE("a path is that of its moves and stops, however they are passed on", "[move_stream]") {
    const unsigned seed = Catch::rngSeed();
    CAPTURE(seed);
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int round = 0; round < splinefeed_test::rounds(40); ++round) {
        Streamed<double> of;
        std::vector<PathElement<double>> expected;
        PerAxis<double> at{};
        ScalarStream<double> looked(2, of.rules, nullptr);
        REQUIRE(looked.place({}).ok());
        TolerancePath<double> judge(2, of.rules);
        REQUIRE(judge.start({}).ok());
        std::vector<CurveSegment<double>> made;
        const auto look = [&](CurveSource<double>& curve, auto&& see) {
            CurveSegment<double> segment;
            while (curve.next(segment) == Pull::item) {
                see(segment);
            }
        };
        const auto keep = [&](const CurveSegment<double>& segment) {
            made.push_back(segment);
        };
        const int steps = 3 + static_cast<int>(random() % 40);
        for (int i = 0; i < steps; ++i) {
            look(looked.curve(), keep);
            const auto kind = random() % 10;
            if (kind < 7) {
                at[0] += number(-8.0, 8.0);
                at[1] += number(-8.0, 8.0);
                auto move = of.line(at[0], at[1]);
                move.stop_at_end = random() % 8 == 0;
                REQUIRE(looked.push(move).value());
                expected.push_back(move);
            } else if (kind < 8) { // the same place again
                auto move = of.line(at[0], at[1]);
                move.stop_at_end = random() % 2 == 0;
                if (!expected.empty()) {
                    CHECK_FALSE(looked.push(move).value());
                    expected.back().stop_at_end = expected.back().stop_at_end || move.stop_at_end;
                }
            } else {
                REQUIRE(looked.stop());
                looked.go_on();
                if (!expected.empty()) {
                    expected.back().stop_at_end = true;
                }
            }
        }
        static_cast<void>(looked.finish());
        look(looked.curve(), keep);
        std::size_t next = 0;
        const auto compare = [&](const CurveSegment<double>& segment) {
            REQUIRE(next < made.size());
            REQUIRE(made[next].degree == segment.degree);
            for (unsigned k = 0; k < 2; ++k) {
                for (unsigned i = 0; i <= static_cast<unsigned>(segment.degree); ++i) {
                    REQUIRE(made[next].control[k][i] == segment.control[k][i]);
                }
            }
            REQUIRE(made[next].waypoint == segment.waypoint);
            REQUIRE(made[next].stop_at_end == segment.stop_at_end);
            ++next;
        };
        for (const PathElement<double>& move : expected) {
            look(judge, compare);
            REQUIRE(judge.push(move).ok());
        }
        static_cast<void>(judge.finish());
        look(judge, compare);
        CHECK(next == made.size());
    }
}
