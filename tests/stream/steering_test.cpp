// SPDX-License-Identifier: MIT
//
// Steering while it runs, judged on what was emitted: every limit, the path in space, the places and times of rest.
#include "support/catch.hpp"
#include "support/emitted.hpp"
#include "support/random_steering.hpp"
#include "support/rounds.hpp"

#include <atomic>
#include <limits>
#include <thread>

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 4711;

struct Case {
    MachineSettings machine;
    BezierPath path;
};

Case random_case(Random& random) {
    const int axes = random.integer(1, max_axes);
    Case made{random_quick_machine(random, axes), {}};
    made.path = random_path(random, axes, 10, random.decades(0.5, 50.0), 0.15, 0.3);
    return made;
}

template <Scalar S>
void require_on_track(const SteeredRun& run, const Track<S>& track) {
    typename Track<S>::Place place;
    const Real close = std::same_as<S, float> ? 1e-4L : 1e-7L;
    Real before = 0.0L;
    for (std::size_t i = 1; i < run.segments.size(); ++i) {
        const Real off = track.find(run.segments[i], place);
        CAPTURE(i, static_cast<double>(off), static_cast<double>(track.s_of(place)), static_cast<double>(before));
        REQUIRE(off <= close);
        REQUIRE(track.s_of(place) >= before - close);
        before = track.s_of(place);
    }
}

void require_end(const SteeredRun& run, const SteeredRun& plain, int axes) {
    for (const unsigned k : splinefeed::indices(axes)) {
        REQUIRE(run.segments.back().end[k] == plain.segments.back().end[k]);
    }
}

template <Scalar S>
constexpr Real slack = std::same_as<S, float> ? 5e-2L : 0.0L;

} // namespace

TEMPLATE_TEST_CASE("steered motions keep limits and path and end exactly", "[stream][steering]", double, float, Fixed) {
    using S = TestType;
    const int wanted = rounds(10);
    int steered = 0;
    for (std::uint64_t round = 0; steered < wanted; ++round) {
        REQUIRE(round < 20 * static_cast<std::uint64_t>(wanted)); // most are too long to be judged
        Random random(seed + round);
        Case made = random_case(random);
        while (!MotionLimits<S>::make(made.machine).has_value()) {
            made = random_case(random);
        }
        const std::size_t window = random.chance(0.5) ? 16 : 512;
        const SteeredRun plain = run_steered<S>(made.path, made.machine, window, {});
        CAPTURE(seed, round, window, plain.segments.size());
        if (plain.endless || plain.segments.size() > 20'000) {
            continue;
        }
        const auto events = random_events(random, plain.segments.size());
        std::string text;
        for (const Event& e : events) {
            text += std::to_string(e.segment) + " " + std::to_string(static_cast<int>(e.order)) + " " +
                    std::to_string(e.value) + "; ";
        }
        CAPTURE(text);
        const SteeredRun run = run_steered<S>(made.path, made.machine, window, events);
        require_limits(run, made.machine, slack<S>);
        REQUIRE(run.finished);
        require_end(run, plain, made.machine.axes);
        ++steered;
        if (run.segments.size() < 6'000) {
            require_on_track<S>(run, Track<S>(made.path, made.machine));
        }
    }
}

TEMPLATE_TEST_CASE("a hold stops within the time that braking needs and 2 ms", "[stream][steering]", double, Fixed) {
    using S = TestType;
    int holds = 0;
    for (std::uint64_t round = 0; round < static_cast<std::uint64_t>(rounds(12)); ++round) {
        Random random(seed + round);
        Case made = random_case(random);
        made.machine.sample_period_us = random.integer(250, 1000);
        const SteeredRun plain = run_steered<S>(made.path, made.machine, 512, {});
        const auto at = static_cast<std::size_t>(random.between(1.0, static_cast<double>(plain.segments.size())));
        if (plain.endless || plain.segments.size() > 20'000 || at + 1 >= plain.segments.size()) {
            continue;
        }
        const SteeredRun run = run_steered<S>(made.path, made.machine, 512, {{at, Order::hold}});
        if (run.finished) {
            continue; // it was about to stop anyway
        }
        REQUIRE(run.activity == Activity::held);
        // The motion can change from its last sample on, a segment after the event; braking is judged from there.
        const auto axes = static_cast<unsigned>(made.machine.axes);
        const Track<S> track(made.path, made.machine);
        typename Track<S>::Place place;
        for (std::size_t i = 1; i <= at + 1; ++i) {
            track.find(plain.segments[i], place);
        }
        const Real segment_s = static_cast<Real>(plain.segments[0].duration_ticks) / 8e6L;
        Real speed_sq = 0.0L;
        for (unsigned k = 0; k < axes; ++k) {
            const Real v = static_cast<Real>(plain.segments[at + 1].start_velocity[k]) /
                           (units_per_mm(made.machine.axis[k]) * segment_s);
            speed_sq += v * v;
        }
        std::size_t rest = at;
        while (rest < run.segments.size() && !ends_at_rest(run.segments[rest], axes)) {
            ++rest;
        }
        const Real needed = track.braking_s(place, std::sqrt(speed_sq));
        const Real took = static_cast<Real>(rest + 1 - at) * segment_s;
        CAPTURE(seed, round, at, static_cast<double>(needed), static_cast<double>(took),
                static_cast<double>(segment_s));
        CHECK(took - needed < 0.002L);
        CHECK(took > needed * 0.98L);
        ++holds;
    }
    CHECK(4 * holds >= rounds(12));
}

TEMPLATE_TEST_CASE("on a straight line a hold costs one to two segments more than braking", "[stream][steering]",
                   double, Fixed) {
    // 100 mm/s at 1000 mm/s2 and 1 ms: from any sample of the acceleration, of the cruise
    const MachineSettings machine = machine_of(1, 100.0, 1000.0, 100.0);
    const BezierPath path{line_shape(1, 3, {200.0})};
    const SteeredRun plain = run_steered<TestType>(path, machine, 512, {});
    for (const std::size_t at : {5U, 20U, 37U, 64U, 95U, 120U, 121U, 122U, 300U, 777U, 1500U, 1950U}) {
        const SteeredRun run = run_steered<TestType>(path, machine, 512, {{at, Order::hold}});
        REQUIRE(run.activity == Activity::held);
        require_limits(run, machine, slack<TestType>);
        const Real v =
            static_cast<Real>(plain.segments[at].start_velocity[0]) / (units_per_mm(machine.axis[0]) * 1e-3L);
        std::size_t rest = at;
        while (!ends_at_rest(run.segments[rest], 1)) {
            ++rest;
        }
        const Real excess_ms = static_cast<Real>(rest + 1 - at) - v;
        CAPTURE(at, static_cast<double>(v), static_cast<double>(excess_ms));
        CHECK(excess_ms <= 2.02L); // a fiftieth of half a segment is kept for rounding
        CHECK(excess_ms >= 0.9L);
    }
}

TEMPLATE_TEST_CASE("an override takes effect on micrometre-short segments", "[stream][steering]", double, float,
                   Fixed) {
    const MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0);
    BezierPath path;
    Random random(seed);
    for (int i = 0; i < 4000; ++i) {
        path.push_back(line_shape(2, 3, {random.between(0.001, 0.003), 0.0}));
        path.back().feed_mm_s = 10.0;
    }
    const auto speed = [&](const FeedSegment& s) {
        return static_cast<Real>(s.start_velocity[0]) / (units_per_mm(machine.axis[0]) * 1e-3L);
    };
    for (const double ratio : {0.3, 0.9, 1.5, 2.0}) {
        const SteeredRun run = run_steered<TestType>(path, machine, 1024, {{200, Order::override_feed, ratio}});
        require_limits(run, machine, slack<TestType>);
        CAPTURE(ratio);
        CHECK(std::fabs(speed(run.segments[200]) / 10.0L - 1.0L) < 2e-3L);
        std::size_t settled = 200;
        while (std::fabs(speed(run.segments[settled]) / (10.0L * real(ratio)) - 1.0L) > 0.01L) {
            REQUIRE(++settled < run.segments.size());
        }
        CHECK(settled - 200 <= 2 + static_cast<std::size_t>(10.0 * std::fabs(ratio - 1.0) + 1.0)); // 1 mm/s a segment
    }
}

TEMPLATE_TEST_CASE("an override of a long straight line is followed at once", "[stream][steering]", double, Fixed) {
    // Cells of 16 mm: 1.6 s each, while the change takes 10 ms
    const MachineSettings machine = machine_of(1, 100.0, 1000.0, 100.0);
    BezierPath path{line_shape(1, 3, {120.0})};
    path[0].feed_mm_s = 10.0;
    for (const double ratio : {0.2, 1.8}) {
        const SteeredRun run = run_steered<TestType>(
            path, machine, 64, {{3000, Order::override_feed, ratio}, {6000, Order::hold}, {6500, Order::resume}});
        REQUIRE(run.finished);
        require_limits(run, machine, slack<TestType>);
        for (const std::size_t at : {3013U, 5999U, 6530U}) {
            const Real v =
                static_cast<Real>(run.segments[at].start_velocity[0]) / (units_per_mm(machine.axis[0]) * 1e-3L);
            CAPTURE(ratio, at);
            CHECK(std::fabs(v / (10.0L * real(ratio)) - 1.0L) < 0.01L);
        }
    }
}

TEMPLATE_TEST_CASE("an override of 1 is no override", "[stream][steering]", double, float, Fixed) {
    for (std::uint64_t round = 0; round < 20; ++round) {
        Random random(seed + round);
        const Case made = random_case(random);
        if (!MotionLimits<TestType>::make(made.machine).has_value()) {
            continue;
        }
        const SteeredRun plain = run_steered<TestType>(made.path, made.machine, 64, {});
        const SteeredRun run =
            run_steered<TestType>(made.path, made.machine, 64, {{0, Order::override_feed, 1.0}, {9, Order::resume}});
        REQUIRE(plain.segments.size() == run.segments.size());
        for (std::size_t i = 0; i < run.segments.size(); ++i) {
            REQUIRE(plain.segments[i].end == run.segments[i].end);
        }
    }
}

TEMPLATE_TEST_CASE("after an abort a new program starts where the machine stands", "[stream][steering]", double, float,
                   Fixed) {
    using S = TestType;
    int aborts = 0;
    for (std::uint64_t round = 0; round < static_cast<std::uint64_t>(rounds(10)); ++round) {
        Random random(seed + round);
        const Case made = random_case(random);
        const auto limits = MotionLimits<S>::make(made.machine);
        if (!limits.has_value()) {
            continue;
        }
        ListSource<S> source(segments_of<S>(made.path, {}), 0, 0);
        std::vector<PlannedCell<S>> window(64);
        AccelerationPlanner<S> planner(window);
        auto trajectory = Trajectory<S>::make(source, *limits, planner).value();
        SteeredRun run;
        const bool held = random.chance(0.3);
        const auto at = static_cast<std::size_t>(random.integer(1, 2000));
        std::vector<Event> events{{at, Order::abort}};
        if (held) {
            events = {{at, Order::hold}, {at + 10000, Order::abort}};
        }
        CAPTURE(seed, round, at);
        run_steered<S>(trajectory, events, run);
        if (run.segments.size() > 100'000) {
            continue;
        }
        REQUIRE(run.finished);
        aborts += run.activity == Activity::aborted ? 1 : 0;
        const auto axes = static_cast<unsigned>(made.machine.axes);
        REQUIRE(ends_at_rest(run.segments.back(), axes));
        trajectory.resume(); // does not bring the program back
        FeedSegment segment;
        REQUIRE(trajectory.next(segment) != Pull::item);
        PerAxis<double> start{};
        for (unsigned k = 0; k < axes; ++k) {
            start[k] = to_mm(run.position[k]);
        }
        const BezierPath path = random_path(random, made.machine.axes, 4, 2.0, 0.2, 0.0);
        ListSource<S> next(segments_of<S>(path, start), 0, 0);
        REQUIRE(trajectory.start(next).ok());
        CHECK(trajectory.activity() == Activity::running);
        const std::size_t before = run.segments.size();
        SteeredRun second = run;
        run_steered<S>(trajectory, {}, second);
        REQUIRE(second.finished);
        REQUIRE(second.segments.size() > before);
        std::vector<FeedSegment>& all = second.segments;
        const std::uint32_t offset = all[before - 1].waypoint;
        for (std::size_t i = before; i < all.size(); ++i) {
            all[i].waypoint += offset; // each program counts its own
        }
        require_limits(second, made.machine, slack<S>);
        for (unsigned k = 0; k < axes; ++k) {
            double end = start[k];
            for (const TestShape& shape : path) {
                end += shape.offset[k][static_cast<unsigned>(shape.degree)];
            }
            CHECK(std::fabs(static_cast<Real>(all.back().end[k]) / units_per_mm(made.machine.axis[k]) - real(end)) <
                  1e-9L + 1e-9L * std::fabs(real(end)));
        }
    }
    CHECK(2 * aborts >= rounds(10));
}

TEMPLATE_TEST_CASE("what the motion does about its steering", "[stream][steering]", double, float, Fixed) {
    using S = TestType;
    const auto limits = MotionLimits<S>::make({.axes = 1}).value();
    const BezierPath path{line_shape(1, 3, {50.0})};
    ListSource<S> source(segments_of<S>(path, {}), 0, 0);
    std::vector<PlannedCell<S>> window(32);
    AccelerationPlanner<S> planner(window);
    auto trajectory = Trajectory<S>::make(source, limits, planner).value();
    FeedSegment segment;
    const auto run = [&](int segments) {
        for (int i = 0; i < segments; ++i) {
            if (trajectory.next(segment) != Pull::item) {
                return;
            }
        }
    };
    trajectory.hold(); // before it starts
    CHECK(trajectory.activity() == Activity::held);
    run(1);
    CHECK(trajectory.state() == Pull::held);
    trajectory.resume();
    CHECK(trajectory.activity() == Activity::running);
    run(100);
    trajectory.hold();
    CHECK(trajectory.activity() == Activity::holding);
    run(1000);
    CHECK(trajectory.activity() == Activity::held);
    if constexpr (!std::same_as<S, Fixed>) {
        trajectory.override_feed(std::numeric_limits<S>::quiet_NaN()); // no number is no way to go on
        trajectory.resume();
        run(10);
        CHECK(trajectory.activity() == Activity::held);
    }
    trajectory.override_feed(S{});
    trajectory.resume(); // the override still says 0
    run(10);
    CHECK(trajectory.activity() == Activity::held);
    CHECK(trajectory.state() == Pull::held);
    const std::uint64_t index = segment.index;
    const auto end = segment.end;
    REQUIRE(trajectory.stand(segment));
    CHECK(segment.index == index + 1);
    CHECK((segment.start == end && segment.end == end && segment.start_velocity[0] == 0));
    trajectory.override_feed(from_double<S>(7.0)); // 2
    CHECK(trajectory.activity() == Activity::running);
    CHECK(to_double(trajectory.feed_plan().steering().wish().ratio) == 2.0);
    run(50);
    trajectory.override_feed(from_double<S>(-1.0)); // 0
    run(20);
    CHECK(trajectory.activity() == Activity::holding);
    trajectory.override_feed(from_double<S>(1.0)); // before it stands
    run(3);
    CHECK(trajectory.activity() == Activity::running);
    CHECK(segment.end_velocity[0] > 0);
    trajectory.abort();
    CHECK(trajectory.activity() == Activity::aborting);
    run(1000);
    CHECK(trajectory.activity() == Activity::aborted);
    CHECK(trajectory.state() == Pull::finished);
}

TEMPLATE_TEST_CASE("another thread may steer at any time", "[stream][steering]", double, Fixed) {
    using S = TestType;
    Random random(seed);
    Case made = random_case(random);
    const auto limits = MotionLimits<S>::make(made.machine).value();
    ListSource<S> source(segments_of<S>(made.path, {}), 0, 0);
    AnyTrajectory<S> any(source, limits, 64);
    std::atomic<bool> over{false};
    std::thread operating([&] {
        for (int i = 0; !over.load(); ++i) {
            any.trajectory().override_feed(from_double<S>(i % 3 == 0 ? 0.0 : 1.7));
            any.trajectory().hold();
            std::this_thread::yield();
            any.trajectory().resume();
            any.trajectory().override_feed(from_integer<S>(1));
        }
    });
    SteeredRun run;
    FeedSegment segment;
    std::size_t held = 0;
    while (run.segments.size() < 100'000) {
        if (run.segments.size() >= 2000) {
            over = true; // then it goes to its end
        }
        const Pull pull = any.trajectory().next(segment);
        if (pull == Pull::finished) {
            break;
        }
        if (pull == Pull::held) {
            ++held;
            REQUIRE(any.trajectory().stand(segment));
        }
        run.segments.push_back(segment);
    }
    over = true;
    operating.join();
    CAPTURE(held, run.segments.size());
    require_limits(run, made.machine);
}
