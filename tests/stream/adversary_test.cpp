// SPDX-License-Identifier: MIT
//
// All at once, at random: short windows, late input, plans that are made ahead, storms of requests, hardly any work in
// a call. What is emitted keeps every limit, each call returns, and the motion ends where it must.
#include "support/catch.hpp"
#include "support/curve_harness.hpp"
#include "support/emitted.hpp"
#include "support/random_steering.hpp"
#include "support/rounds.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 1000616;
constexpr std::size_t most_segments = 3000;

struct Siege {
    MachineSettings machine;
    BezierPath path;
    std::size_t window = 16;
    int patience = 0; // of the input
    UnderrunPolicy underrun = UnderrunPolicy::wait;
    unsigned work = 1;  // of a call; 0: random
    unsigned ahead = 0; // of plan_ahead(), every other time; 0: never
    std::vector<Event> storm;
};

// A path of short pieces: each is some segments long at speed.
template <Scalar S>
Siege random_siege(Random& random) {
    Siege out;
    const int axes = random.integer(1, 3);
    out.machine = random_quick_machine(random, axes);
    out.machine.max_feed_mm_s = random.decades(1.0, 300.0);
    if (!std::same_as<S, float> && random.chance(0.8)) {
        limit_jerk(random, out.machine);
    }
    const double way_mm = out.machine.max_feed_mm_s * out.machine.sample_period_us * 1e-6;
    const double size_mm = std::max(2e-3, way_mm * random.decades(1.0, 40.0));
    out.path = random_path(random, axes, random.integer(1, 8), size_mm, 0.15, 0.2);
    out.window = static_cast<std::size_t>(random.integer(16, 64));
    constexpr int patience[] = {0, 2, 40, 400};
    out.patience = patience[random.integer(0, 3)];
    constexpr UnderrunPolicy policies[] = {UnderrunPolicy::wait, UnderrunPolicy::drain, UnderrunPolicy::urgent};
    out.underrun = policies[random.integer(0, 2)];
    constexpr unsigned work[] = {1, 0, 2000}; // enough for any plan, and not for one that never ends
    out.work = work[random.integer(0, 2)];
    out.ahead = random.chance(0.7) ? static_cast<unsigned>(random.integer(1, 60)) : 0U;
    std::size_t at = 0;
    const bool dense = random.chance(0.5);
    for (int n = random.integer(0, 30); n > 0; --n) {
        constexpr double ratios[] = {0.0, 0.01, 0.1, 0.5, 1.0, 2.0};
        constexpr Order orders[] = {Order::hold,          Order::resume,        Order::override_feed,
                                    Order::override_feed, Order::override_feed, Order::limit_feed};
        const Order order = random.chance(0.02) ? Order::abort : orders[random.integer(0, 5)];
        const double value = order == Order::limit_feed ? random.decades(0.5, 500.0) : ratios[random.integer(0, 5)];
        out.storm.push_back({at, order, value});
        at += static_cast<std::size_t>(random.integer(0, dense ? 8 : 60));
    }
    for (const Order order : {Order::resume, Order::override_feed, Order::limit_feed}) { // then it may run to its end
        out.storm.push_back({at, order, order == Order::limit_feed ? 1e5 : 1.0});
    }
    return out;
}

// What comes of it. Where the machine stands and nothing comes, the next request does. A long motion is aborted.
template <Scalar S>
SteeredRun run_siege(Trajectory<S>& trajectory, const Siege& siege, Random& random) {
    SteeredRun run;
    FeedSegment segment;
    std::size_t next = 0;
    for (std::size_t calls = 0; !run.finished; ++calls) {
        while (next < siege.storm.size() && siege.storm[next].segment <= run.segments.size()) {
            give(trajectory, siege.storm[next++]);
        }
        if (siege.ahead > 0 && random.chance(0.5)) {
            static_cast<void>(trajectory.plan_ahead(siege.ahead));
        }
        const unsigned work = siege.work > 0 ? siege.work : static_cast<unsigned>(random.integer(1, 300));
        const Pull pull = trajectory.next(segment, siege.underrun, work);
        if (pull == Pull::item || (pull == Pull::held && trajectory.stand(segment))) {
            run.segments.push_back(segment);
            calls = 0;
            if (run.segments.size() == most_segments) {
                trajectory.abort();
            }
        } else if (pull == Pull::held && next < siege.storm.size()) {
            give(trajectory, siege.storm[next++]); // it has not begun
        }
        run.finished = pull == Pull::finished;
        REQUIRE(calls < 100'000);
        REQUIRE(run.segments.size() < 100 * most_segments);
    }
    run.activity = trajectory.activity();
    return run;
}

} // namespace

TEMPLATE_TEST_CASE("whatever is done to a motion at once, it keeps its limits and comes to its end",
                   "[stream][random][adversary]", DoubleInDouble, FixedInDouble, FixedInFloat,
                   (Planning<float, double>)) {
    using S = typename TestType::S;
    using R = typename TestType::R;
    int finished = 0;
    for (std::uint64_t round = first_round(); round < static_cast<std::uint64_t>(rounds(300, 5000)); ++round) {
        Random random(seed + round);
        const Siege siege = random_siege<S>(random);
        const auto limits = limits_for<S, R>(siege.machine);
        if (!limits.has_value()) {
            continue;
        }
        CAPTURE(seed, round, siege.window, siege.patience, static_cast<int>(siege.underrun), siege.work, siege.ahead,
                limits->jerk_limited);
        const auto segments = segments_of<S>(siege.path, {});
        ListSource<S> source(segments, round, siege.patience);
        AnyTrajectory<S, R> any(source, *limits, siege.window);
        const SteeredRun run = run_siege<S>(any.trajectory(), siege, random);
        REQUIRE(any.trajectory().status().ok());
        if (run.segments.empty()) {
            REQUIRE(run.activity == Activity::aborted);
            continue;
        }
        require_limits(run, siege.machine, std::same_as<S, float> ? 5e-2L : 0.0L);
        if (run.activity != Activity::aborted) {
            ++finished;
            for (const unsigned k : splinefeed::indices(siege.machine.axes)) {
                REQUIRE(run.segments.back().end[k] ==
                        target_units(to_mm(segments.back().end[k]), siege.machine.axis[k]));
            }
        }
    }
    CHECK((finished > 5 || first_round() > 0));
}
