// SPDX-License-Identifier: MIT
//
// A motion that is planned in parts: the same segments, whatever the parts are and whatever is measured ahead.
#include "support/catch.hpp"
#include "support/curve_harness.hpp"
#include "support/emitted.hpp"
#include "support/random_steering.hpp"
#include "support/rounds.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 5757;

struct Round {
    MachineSettings machine;
    bool jerk_limited = false;
    BezierPath path;
    std::size_t window = 16;
    std::vector<Event> events;
};

template <Scalar S>
Round random_round(Random& random) {
    Round round;
    const int axes = random.integer(1, max_axes);
    do {
        round.machine = random_quick_machine(random, axes);
        if (random.chance(0.4)) {
            limit_jerk(random, round.machine);
        }
        if (random.chance(0.3)) { // two limits: the way that an axis goes is found out later (Turning)
            round.machine.axis[0].max_braking_mm_s2 = 3.0 * round.machine.axis[0].max_acceleration_mm_s2;
        }
    } while (!MotionLimits<S>::make(round.machine).has_value());
    round.jerk_limited = MotionLimits<S>::make(round.machine)->jerk_limited;
    round.path = random_path(random, axes, 12, random.decades(0.3, 20.0), 0.1, 0.3);
    round.window = random.chance(0.5) ? 16 : 64;
    return round;
}

/// @param ahead  chance of a call of measure_ahead() before a call of next()
template <Scalar S>
SteeredRun run_in_parts(const Round& round, unsigned work, double ahead, std::uint64_t choices) {
    const auto limits = MotionLimits<S>::make(round.machine).value();
    ListSource<S> source(segments_of<S>(round.path, {}), choices,
                         work == WorkBudget::unlimited || !round.events.empty() ? 0 : 2);
    AnyTrajectory<S> any(source, limits, round.window);
    Random random(choices);
    SteeredRun run;
    const auto wait = [] { // the source has one after some more calls
    };
    run_steered<S>(any.trajectory(), round.events, run, wait, UnderrunPolicy::wait, [&] {
        if (random.chance(ahead)) {
            any.trajectory().measure_ahead(work);
        }
        return work;
    });
    return run;
}

} // namespace

TEMPLATE_TEST_CASE("a motion planned in parts is the same motion", "[stream][work]", double, float, Fixed) {
    using S = TestType;
    int judged = 0;
    for (std::uint64_t n = first_round(); n < static_cast<std::uint64_t>(rounds(24)); ++n) {
        Random random(seed + n);
        Round round = random_round<S>(random);
        const SteeredRun plain = run_in_parts<S>(round, WorkBudget::unlimited, 0.0, 0);
        if (plain.endless || plain.segments.size() > 20'000) {
            continue;
        }
        ++judged;
        REQUIRE(plain.finished);
        CHECK(plain.busy == 0);
        for (const bool steered : {false, true}) {
            round.events = steered ? random_events_and_abort(random, plain.segments.size()) : std::vector<Event>{};
            const SteeredRun whole = run_in_parts<S>(round, WorkBudget::unlimited, 0.0, n);
            if (whole.endless) {
                continue;
            }
            for (const unsigned work : {1U, 3U, 20U}) {
                const SteeredRun parts = run_in_parts<S>(round, work, random.chance(0.5) ? 0.5 : 0.0, n);
                CAPTURE(seed, n, steered, work, round.window);
                REQUIRE(parts.segments.size() == whole.segments.size());
                for (std::size_t i = 0; i < whole.segments.size(); ++i) {
                    REQUIRE(parts.segments[i].start == whole.segments[i].start);
                    REQUIRE(parts.segments[i].end_velocity == whole.segments[i].end_velocity);
                }
                CHECK(parts.finished == whole.finished);
                CHECK(parts.activity == whole.activity);
                CHECK((parts.busy > 0 || work > 1 || round.jerk_limited));
            }
        }
    }
    CHECK((judged > 0 || first_round() > 0));
}

namespace {

/// Counts what is asked of it.
template <Scalar S>
class CountingSource final : public CurveSource<S> {
public:
    explicit CountingSource(ListSource<S>& list) : list_(&list) {}
    Pull next(CurveSegment<S>& out) noexcept override {
        ++asked;
        return list_->next(out);
    }
    unsigned asked = 0;

private:
    ListSource<S>* list_;
};

} // namespace

TEST_CASE("a call does no more than it may, and measuring ahead leaves less for next()", "[stream][work]") {
    MachineSettings machine;
    machine.axes = 2;
    const auto limits = MotionLimits<double>::make(machine).value();
    Random random(seed);
    const BezierPath path = random_path(random, 2, 60, 5.0, 0.0, 0.0);
    std::size_t busy[2] = {};
    for (const bool ahead : {false, true}) {
        ListSource<double> list(segments_of<double>(path, {}), 0, 0);
        CountingSource<double> source(list);
        std::vector<PlannedCell<double>> window(32);
        AccelerationPlanner<double> planner(window);
        auto trajectory = Trajectory<double>::make(source, limits, planner).value();
        FeedSegment segment;
        while (trajectory.state() != Pull::finished) {
            const unsigned before = source.asked;
            static_cast<void>(trajectory.next(segment, UnderrunPolicy::wait, 4));
            REQUIRE(source.asked - before <= 2); // a segment and the one behind it
            busy[ahead ? 1 : 0] += trajectory.state() == Pull::busy ? 1U : 0U;
            while (ahead && trajectory.state() == Pull::item && trajectory.measure_ahead(4)) {
            }
        }
    }
    CHECK(busy[0] > 500);
    CHECK(busy[1] < busy[0] * 3 / 4);
}

TEST_CASE("a full window has nothing left to measure", "[stream][work]") {
    MachineSettings machine;
    machine.axes = 1;
    const auto limits = MotionLimits<double>::make(machine).value();
    Random random(seed);
    const BezierPath path = random_path(random, 1, 60, 5.0, 0.0, 0.0);
    ListSource<double> list(segments_of<double>(path, {}), 0, 0);
    CountingSource<double> source(list);
    std::vector<PlannedCell<double>> window(32);
    AccelerationPlanner<double> planner(window);
    auto trajectory = Trajectory<double>::make(source, limits, planner).value();
    unsigned calls = 0;
    while (trajectory.measure_ahead(1) && calls < 10'000) {
        ++calls;
    }
    CHECK(calls >= 31);
    CHECK(calls < 10'000);
    const unsigned asked = source.asked;
    CHECK_FALSE(trajectory.measure_ahead(100));
    CHECK(source.asked == asked);
}

TEST_CASE("requests in the middle of a part are followed, one after the other", "[stream][work]") {
    MachineSettings machine;
    machine.axes = 2;
    const auto limits = MotionLimits<Fixed>::make(machine).value();
    Random random(seed + 1);
    const BezierPath path = random_path(random, 2, 40, 20.0, 0.0, 0.0);
    ListSource<Fixed> source(segments_of<Fixed>(path, {}), 0, 0);
    std::vector<PlannedCell<Fixed>> window(64);
    AccelerationPlanner<Fixed> planner(window);
    auto trajectory = Trajectory<Fixed>::make(source, limits, planner).value();
    FeedSegment segment;
    std::vector<FeedSegment> segments;
    unsigned calls = 0;
    // An override that never rests: each call asks for another, and the motion goes on all the same.
    while (segments.size() < 200) {
        trajectory.override_feed(from_double<Fixed>(0.5 + 0.001 * static_cast<double>(++calls % 500)));
        if (trajectory.next(segment, UnderrunPolicy::wait, 3) == Pull::item) {
            segments.push_back(segment);
        }
        REQUIRE(calls < 100'000);
    }
    REQUIRE_FALSE(ends_at_rest(segments.back(), 2));
    // A hold, whose pass is under way when it is taken back and given again.
    trajectory.hold();
    for (int i = 0; i < 3; ++i) {
        static_cast<void>(trajectory.next(segment, UnderrunPolicy::wait, 1));
    }
    trajectory.resume();
    static_cast<void>(trajectory.next(segment, UnderrunPolicy::wait, 1));
    trajectory.hold();
    calls = 0;
    while (trajectory.activity() != Activity::held) {
        if (trajectory.next(segment, UnderrunPolicy::wait, 1) == Pull::item) {
            segments.push_back(segment);
        }
        REQUIRE(++calls < 100'000);
    }
    CHECK(ends_at_rest(segments.back(), 2));
    CHECK(segments.size() < 1000);
}
