// SPDX-License-Identifier: MIT
//
// Planning that is late for a machine that cannot wait: whatever a call may do, each gives a segment while the machine
// moves; all limits are kept, and it comes to the end of the path, or stands where it was told to.
#include "support/catch.hpp"
#include "support/curve_harness.hpp"
#include "support/emitted.hpp"
#include "support/random_steering.hpp"
#include "support/rounds.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 4041;

struct Urgency {
    std::size_t calls = 0;
    std::size_t busy_in_motion = 0;
};

/// One call of next() for each segment, with work enough or hardly any.
template <Scalar S>
void run_urgent(Trajectory<S>& trajectory, const std::vector<Event>& events, Random& random, double starved,
                SteeredRun& run, Urgency& urgency) {
    FeedSegment segment;
    std::size_t next = 0;
    while (run.segments.size() < 300'000 && ++urgency.calls < 3'000'000) {
        while (next < events.size() && events[next].segment <= run.segments.size()) {
            give(trajectory, events[next++]);
        }
        const unsigned work = random.chance(starved) ? static_cast<unsigned>(random.integer(1, 30)) : 2000U;
        if (random.chance(0.5)) { // as a machine does that has segments in store
            static_cast<void>(trajectory.plan_ahead(static_cast<unsigned>(random.integer(1, 300))));
        }
        const bool rests = trajectory.at_rest();
        switch (trajectory.next(segment, UnderrunPolicy::urgent, work)) {
        case Pull::item: run.segments.push_back(segment); break;
        case Pull::busy: urgency.busy_in_motion += rests ? 0U : 1U; break;
        case Pull::held:
            if (next == events.size() || !trajectory.stand(segment)) {
                return;
            }
            run.segments.push_back(segment);
            break;
        case Pull::finished: run.finished = true; return;
        default: break; // the source has one after some more calls
        }
    }
    run.endless = true;
}

} // namespace

TEMPLATE_TEST_CASE("late planning slows the motion down on the path, within the limits", "[stream][urgent]", double,
                   float, Fixed) {
    using S = TestType;
    int judged = 0;
    for (std::uint64_t n = first_round(); n < static_cast<std::uint64_t>(rounds(40)); ++n) {
        Random random(seed + n);
        const auto drawn = random_quick_run<S>(random, 30, 64, [&](MachineSettings& machine) {
            if (!std::same_as<S, float> && random.chance(0.5)) {
                limit_jerk(random, machine);
            }
            if (random.chance(0.2)) {
                machine.axis[0].max_braking_mm_s2 = 3.0 * machine.axis[0].max_acceleration_mm_s2;
            }
        });
        if (!drawn) {
            continue;
        }
        const auto& [machine, limits, path, window, plain] = *drawn;
        const auto axes = static_cast<unsigned>(machine.axes);
        for (const bool steered : {false, true}) {
            std::vector<Event> events;
            if (steered) {
                events = random_events_and_abort(random, plain.segments.size());
                events.push_back({random.chance(0.5) ? events.front().segment : 0, Order::limit_feed, 20.0});
                std::swap(events.front(), events.back());
            }
            ListSource<S> source(segments_of<S>(path, {}), n, 2);
            AnyTrajectory<S> any(source, limits, window);
            SteeredRun run;
            Urgency urgency;
            CAPTURE(seed, n, steered, window, limits.jerk_limited);
            run_urgent<S>(any.trajectory(), events, random, random.chance(0.3) ? 1.0 : 0.1, run, urgency);
            ++judged;
            CHECK(urgency.busy_in_motion == 0);
            REQUIRE_FALSE(run.endless);
            require_limits(run, machine, std::same_as<S, float> ? 5e-2L : 0.0L);
            REQUIRE((run.segments.empty() || ends_at_rest(run.segments.back(), axes)));
            if (!steered) {
                REQUIRE(run.finished);
                CHECK(run.segments.back().end == plain.segments.back().end);
            }
        }
    }
    CHECK((judged > 0 || first_round() > 0));
}

TEST_CASE("a plan with jerk that is made ahead is there when the motion needs it", "[stream][urgent]") {
    const MachineSettings machine = with_jerk(machine_of(2, 100.0, 1000.0, 100.0), 30'000.0);
    const auto limits = MotionLimits<double>::make(machine).value();
    Random random(seed);
    const BezierPath path = random_path(random, 2, 60, 10.0, 0.0, 0.0);
    std::size_t busy[2] = {};
    for (const bool ahead : {false, true}) {
        ListSource<double> source(segments_of<double>(path, {}), 0, 0);
        AnyTrajectory<double> any(source, limits, 48);
        SteeredRun run;
        FeedSegment segment;
        Pull pull = Pull::busy;
        for (int calls = 0; pull != Pull::finished && calls < 1'000'000; ++calls) {
            pull = any.trajectory().next(segment, UnderrunPolicy::wait, 200);
            busy[ahead ? 1 : 0] += pull == Pull::busy && !any.trajectory().at_rest() ? 1U : 0U;
            if (pull == Pull::item) {
                run.segments.push_back(segment);
            }
            for (int i = 0; ahead && pull == Pull::item && i < 20 && any.trajectory().plan_ahead(200); ++i) {
            }
        }
        REQUIRE(pull == Pull::finished);
        require_limits(run, machine, 0.0L);
    }
    CHECK(busy[0] > 100);
    CHECK(10 * busy[1] < busy[0]);
}

TEMPLATE_TEST_CASE("a change of the steering ends the search of a plan that is made ahead", "[stream][urgent][jerk]",
                   DoubleInDouble, FixedInDouble, FixedInFloat) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    const MachineSettings machine = with_jerk(machine_of(2, 100.0, 1000.0, 3.0), 30'000.0);
    const auto limits = limits_for<S, R>(machine).value();
    Random random(seed);
    const BezierPath path = random_path(random, 2, 6, 0.1, 0.0, 0.0);
    for (std::size_t every = 2; every < 30; ++every) { // segments between two changes
        ListSource<S> source(segments_of<S>(path, {}), 0, 0);
        AnyTrajectory<S, R> any(source, limits, every % 2 == 0 ? 16 : 48);
        SteeredRun run;
        FeedSegment segment;
        while (any.trajectory().next(segment) == Pull::item) {
            run.segments.push_back(segment);
            const bool slow = run.segments.size() / every % 2 == 1;
            any.trajectory().override_feed(from_double<S>(slow ? 0.1 : 1.0));
            static_cast<void>(any.trajectory().plan_ahead(10));
        }
        CAPTURE(every);
        REQUIRE(any.trajectory().state() == Pull::finished);
        require_limits(run, machine);
    }
}

// The front cell may have left its K behind where the next one has a new one: the longer the pass takes, the more such
// places are met. Calls with little work take it through all of them.
TEST_CASE("the old plan and a new one that has come to the second cell do not mix", "[stream][urgent]") {
    const MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0);
    const auto limits = MotionLimits<double>::make(machine).value();
    for (std::uint64_t n = first_round(); n < static_cast<std::uint64_t>(rounds(12, 100)); ++n) {
        Random random(seed + n);
        const BezierPath path = random_path(random, 2, 60, random.decades(0.1, 6.0), 0.0, 0.0);
        for (const std::size_t window : {16U, 40U}) {
            const SteeredRun plain = run_steered<double>(path, machine, window, {});
            for (unsigned work = 1; work < 32; work += 3) {
                ListSource<double> source(segments_of<double>(path, {}), 0, 0);
                AnyTrajectory<double> any(source, limits, window);
                SteeredRun run;
                FeedSegment segment;
                Pull pull = Pull::busy;
                for (int calls = 0; pull != Pull::finished && calls < 300'000; ++calls) {
                    pull = any.trajectory().next(segment, UnderrunPolicy::urgent, work);
                    if (pull == Pull::item) {
                        run.segments.push_back(segment);
                    }
                }
                CAPTURE(n, window, work);
                REQUIRE(pull == Pull::finished);
                require_limits(run, machine, 0.0L);
                CHECK(run.segments.size() < 3 * plain.segments.size());
            }
        }
    }
}

// A cell that comes into a window or a leg is a step, also where it was measured before: a call with hardly any work
// does hardly any.
TEST_CASE("a call takes no more cells into a plan than its work", "[stream][work]") {
    for (const double jerk : {0.0, 30'000.0}) {
        const MachineSettings machine = with_jerk(machine_of(2, 100.0, 1000.0, 100.0), jerk);
        const auto limits = MotionLimits<double>::make(machine).value();
        Random random(seed);
        const BezierPath path = random_path(random, 2, 100, 10.0, 0.0, 0.0);
        ListSource<double> source(segments_of<double>(path, {}), 0, 0);
        AnyTrajectory<double> any(source, limits, 64);
        while (any.trajectory().measure_ahead(1)) {
        }
        FeedSegment segment;
        std::size_t calls = 1;
        while (any.trajectory().next(segment, UnderrunPolicy::wait, 1) == Pull::busy) {
            ++calls;
        }
        CAPTURE(jerk);
        // A cell is taken in, gets its peak and is visited by the pass. With jerk it comes into a window and a leg
        // more: without one of the two there are 252 calls, with both 299.
        CHECK(calls >= (jerk > 0.0 ? 280U : 3U * 64U));
    }
}
