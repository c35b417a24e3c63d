// SPDX-License-Identifier: MIT
//
// Holds, and overrides of 0, within 12 segments of a stop: where the rest of a cell has few digits. None hangs, each
// stands no later than the plan would have stood at the stop, and what follows takes no longer than a run that begins
// there.
#include "support/catch.hpp"
#include "support/curve_harness.hpp"
#include "support/emitted.hpp"
#include "support/random_steering.hpp"
#include "support/rounds.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 35'001;
constexpr int holds_a_program = 5;
constexpr std::size_t near_stop = 12;        // segments
constexpr std::size_t most_planned = 20'000; // of a program without a hold; longer ones only take time
constexpr std::size_t late = 3;              // segments behind the stop where a hold may stand; 1 was seen
constexpr std::size_t restart = 100;         // segments that braking and beginning again may take; 49 were seen
constexpr std::size_t tried_again = 500;     // by a jerk plan, which may take a leg from stop to stop for a while
template <Scalar S>
constexpr Real slack = std::same_as<S, float> ? 5e-2L : 0.0L; // of an acceleration

MachineSettings machine_for(Random& random, bool jerk_limited, int axes) {
    MachineSettings machine = random_quick_machine(random, axes);
    if (jerk_limited) {
        limit_jerk(random, machine);
        machine.axis[0].max_jerk_mm_s3 = std::min(20.0 * machine.axis[0].max_acceleration_mm_s2, 1e9);
    }
    return machine;
}

/// Short moves, most of which end at a stop; some are as short as a sample.
Program short_moves(Random& random, int axes) {
    Program program;
    program.axes = axes;
    program.polyline = random.chance(0.7);
    const double size = random.decades(0.002, 10.0);
    Point point;
    const int points = random.integer(2, 5);
    for (int i = 0; i < points; ++i) {
        point.corner = random.chance(0.7) ? Corner::forced : Corner::automatic;
        program.points.push_back(point);
        const auto axis = static_cast<unsigned>(random.integer(0, axes - 1));
        const bool alone = random.chance(0.5); // as in a program, along one axis
        for (const unsigned k : splinefeed::indices(axes)) {
            const double way = size * random.decades(0.1, 10.0) * random.between(-1.0, 1.0);
            const double least = k == axis ? 0.001 : 0.0; // points within 0.1 um would be one
            point.mm[k] += alone && k != axis ? 0.0 : std::copysign(std::max(std::fabs(way), least), way);
        }
    }
    return program;
}

struct Held {
    SteeredRun run;
    std::size_t held = 0;    // segments when it stood
    std::size_t resumed = 0; // and when it went on
};

/// @param most  segments; where there are more it hangs
template <Scalar S, Floating R = double>
Held hold_at(const std::vector<CurveSegment<S>>& path, const MotionLimits<S>& limits, std::size_t at, bool by_override,
             std::size_t pause, std::size_t most) {
    ListSource<S> source(path);
    AnyTrajectory<S, R> any(source, limits, 64);
    Trajectory<S>& trajectory = any.trajectory();
    Held out;
    FeedSegment segment;
    const auto steer = [&](bool stop) {
        give(trajectory, by_override ? Event{0, Order::override_feed, stop ? 0.0 : 1.0}
                                     : Event{0, stop ? Order::hold : Order::resume});
    };
    bool given = false;
    while (!out.run.endless) {
        if (!given && out.run.segments.size() == at) {
            steer(true);
            given = true;
        }
        const bool stops = given && out.resumed == 0;
        if (stops && out.held == 0 && trajectory.activity() == Activity::held) {
            out.held = out.run.segments.size();
        }
        if (stops && out.run.segments.size() >= at + pause) { // it may still be braking
            steer(false);
            out.resumed = out.run.segments.size();
        }
        if (trajectory.next(segment) != Pull::item &&
            !(trajectory.state() == Pull::held && trajectory.stand(segment))) {
            break;
        }
        out.run.segments.push_back(segment);
        out.run.endless = out.run.segments.size() >= most;
    }
    out.run.finished = trajectory.state() == Pull::finished;
    return out;
}

/// From `at` on, the first segment after which the machine stands.
std::size_t next_rest(const std::vector<FeedSegment>& segments, std::size_t at, unsigned axes) {
    while (at < segments.size() && !ends_at_rest(segments[at], axes)) {
        ++at;
    }
    return at + 1;
}

template <Scalar S>
std::vector<CurveSegment<S>> path_of(const Program& program) {
    std::vector<Feed<S>> feeds;
    for (const Point& point : program.points) {
        Waypoint<S> waypoint;
        for (const unsigned k : splinefeed::indices(program.axes)) {
            waypoint.position[k] = position_from_mm(point.mm[k]);
        }
        waypoint.corner = point.corner;
        feeds.push_back({waypoint, Role::path});
    }
    CurveOptions<S> options;
    options.axes = program.axes;
    Polyline<S> polyline(options);
    G2Spline<S> spline(options);
    return program.polyline ? run_curve<S>(polyline, feeds) : run_curve<S>(spline, feeds);
}

template <Scalar S, Floating R>
void hold_near_stops(Random& random, bool jerk_limited, int& holds) {
    const int axes = random.integer(1, 3);
    MachineSettings machine;
    do {
        machine = machine_for(random, jerk_limited, axes);
    } while (!limits_for<S, R>(machine).has_value());
    const Program program = short_moves(random, axes);
    const auto limits = limits_for<S, R>(machine).value();
    const std::vector<CurveSegment<S>> path = path_of<S>(program);
    const Held plain = hold_at<S, R>(path, limits, most_planned, false, 0, most_planned);
    const std::size_t planned = plain.run.segments.size();
    if (plain.run.endless || planned < 4) {
        return;
    }
    for (int i = 0; i < holds_a_program; ++i) {
        const auto at = [&] {
            const std::size_t rest = next_rest(
                plain.run.segments, static_cast<std::size_t>(random.integer(0, static_cast<int>(planned) - 1)),
                static_cast<unsigned>(axes));
            return rest - std::min(rest, static_cast<std::size_t>(random.integer(0, near_stop)));
        }();
        const bool by_override = random.chance(0.3);
        const auto pause = static_cast<std::size_t>(random.chance(0.5) ? random.integer(1, 15) : 1000);
        const std::size_t stop = next_rest(plain.run.segments, at, static_cast<unsigned>(axes));
        const Held held = hold_at<S, R>(path, limits, at, by_override, pause, 2 * planned + pause + 2 * tried_again);
        const std::size_t took = held.run.segments.size();
        CAPTURE(i, at, by_override, pause, stop, planned, took, held.held, held.resumed);
        ++holds;
        REQUIRE_FALSE(held.run.endless);
        REQUIRE(held.run.finished);
        require_limits(held.run, machine, slack<S>);
        REQUIRE(held.held <= stop + late); // 0 where it had gone on before it stood
        REQUIRE(took <= planned + pause + (jerk_limited ? planned + tried_again : restart));
    }
}

template <class Kind>
void hold_rounds(bool jerk_limited, std::uint64_t first) {
    const int count = rounds(400, 20'000) / holds_a_program;
    int holds = 0;
    for (int round = static_cast<int>(first_round()); round < std::max(count, static_cast<int>(first_round()) + 1);
         ++round) {
        CAPTURE(first, round);
        Random random(first + static_cast<std::uint64_t>(round));
        hold_near_stops<typename Kind::S, typename Kind::R>(random, jerk_limited, holds);
    }
    CAPTURE(first, holds);
    CHECK((first_round() > 0 || 10 * holds > 9 * count * holds_a_program));
}

} // namespace

TEMPLATE_TEST_CASE("a hold beside a stop of an acceleration-limited motion", "[stream][steering][beside]", double,
                   float, Fixed) {
    hold_rounds<Planning<TestType, double>>(false, seed);
}

TEMPLATE_TEST_CASE("a hold beside a stop of a jerk-limited motion", "[stream][steering][beside][jerk]", DoubleInDouble,
                   FixedInDouble, FixedInFloat) {
    hold_rounds<TestType>(true, seed + 1'000'000);
}

TEST_CASE("a hold that ends exactly on a stop goes on", "[stream][steering][beside]") {
    const MachineSettings machine = machine_of(2, 100.0, 1000.0, 320.0);
    Program program;
    program.axes = 2;
    program.polyline = true;
    program.points = {{{0.0, 0.0}}, {{13.340326134, 0.0}}, {{13.340326134, 1.122113594}}};
    const auto limits = MotionLimits<Fixed>::make(machine).value();
    for (std::size_t at = 215; at < 240; ++at) {
        const Held held = hold_at<Fixed>(path_of<Fixed>(program), limits, at, false, 100, 2000);
        CAPTURE(at, held.held, held.run.segments.size());
        REQUIRE(held.run.finished);
        require_limits(held.run, machine);
    }
}
