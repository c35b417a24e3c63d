// SPDX-License-Identifier: MIT
// What a node of a feed plan costs, and how long the planning of one window takes at worst, along a curve that is
// repeated as often as asked for: no figure may grow with its length. A node is the end of a cell.
//
// A plan pulls its cells out of the stages before it. So these run once without and once with the plan, and a node
// costs the difference of both over the number of nodes. Time is what the thread had of the processor: other programs
// on the machine count only by the caches that they use.
#include "looped_curve.hpp"

#include "splinefeed/s3_feed_plan/jerk/jerk_plan.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <memory>
#include <vector>

namespace {

using namespace splinefeed;

constexpr std::size_t window_cells = 1024; // the tool's default; it gives a quarter of that to the jerk plan
constexpr std::size_t jerk_cells = window_cells / 4 + JerkWindow<double, double>::most_spare;

constexpr double jerk = 30000.0; // [mm/s^3]

double thread_seconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// The machine of examples/three_axis.toml, or with a jerk that of examples/jerk_limited.toml.
template <Scalar S>
MotionLimits<S> limits(double jerk_mm_s3) {
    MachineSettings machine;
    for (AxisSettings& axis : machine.axis) {
        axis.max_jerk_mm_s3 = jerk_mm_s3;
        axis.steps_per_mm = 320.0;
    }
    return MotionLimits<S>::make(machine).value();
}

/// The stages of a run; those behind the one that is asked cost nothing.
template <Scalar S>
struct Stages {
    Stages(std::int64_t waypoints, const MotionLimits<S>& machine)
        : curve(waypoints), arc_length(curve, machine.refinement), window(window_cells),
          feed_plan(arc_length, machine, window) {}

    bench::LoopedCurve<S> curve;
    ArcLength<S> arc_length;
    std::vector<PlannedCell<S>> window;
    FeedPlan<S> feed_plan;
};

template <Scalar S, Floating R>
struct JerkStages : Stages<S> {
    JerkStages(std::int64_t waypoints, const MotionLimits<S>& machine)
        : Stages<S>(waypoints, machine), cells(jerk_cells), nodes(jerk_cells + 1), scratch(jerk_cells + 1),
          plan(this->feed_plan, machine, JerkStorage<S, R>{cells, nodes, scratch}) {}

    std::vector<Cell<S>> cells;
    std::vector<JerkNode<R>> nodes;
    std::vector<LegNode<R>> scratch;
    JerkPlan<S, R> plan;
};

struct Measured {
    double seconds = 0.0;
    std::int64_t nodes = 0;
};

template <Scalar S>
Measured drain(ArcLength<S>& arc_length) {
    Measured out;
    Cell<S> cell;
    const double start = thread_seconds();
    while (arc_length.next(cell) == Pull::item) {
        benchmark::DoNotOptimize(cell);
        ++out.nodes;
    }
    out.seconds = thread_seconds() - start;
    return out;
}

template <class Plan>
Measured drain_plan(Plan& plan) {
    Measured out;
    const double start = thread_seconds();
    while (plan.prepare(UnderrunPolicy::wait) == Pull::item) {
        benchmark::DoNotOptimize(plan.profile_segment());
        out.nodes += plan.profile_segment().stretch.to == decltype(plan.profile_segment().stretch.to)(1) ? 1 : 0;
        plan.advance();
    }
    out.seconds = thread_seconds() - start;
    return out;
}

/// @param before, after  run the stages of S without and with the plan
template <class S>
void cost_of_a_node(benchmark::State& state, const auto& machine, auto&& before, auto&& after) {
    Measured sum;
    for (auto _ : state) {
        const auto without = std::make_unique<S>(state.range(0), machine);
        const auto with = std::make_unique<S>(state.range(0), machine);
        const double base = before(*without).seconds;
        const Measured all = after(*with);
        const double cost = std::max(all.seconds - base, 1e-9);
        state.SetIterationTime(cost);
        sum.seconds += cost;
        sum.nodes += all.nodes;
    }
    state.counters["nodes"] = static_cast<double>(sum.nodes) / static_cast<double>(state.iterations());
    state.counters["ns_a_node"] = 1e9 * sum.seconds / static_cast<double>(sum.nodes);
}

template <Scalar S>
void feed_plan(benchmark::State& state) {
    cost_of_a_node<Stages<S>>(
        state, limits<S>(0.0), [](Stages<S>& stages) { return drain(stages.arc_length); },
        [](Stages<S>& stages) { return drain_plan(stages.feed_plan); });
}

template <Scalar S, Floating R>
void jerk_plan(benchmark::State& state) {
    using Of = JerkStages<S, R>;
    cost_of_a_node<Of>(
        state, limits<S>(jerk), [](Of& stages) { return drain_plan(stages.feed_plan); },
        [](Of& stages) { return drain_plan(stages.plan); });
}

/// The longest prepare(), of those that plan: with the half window of cells that the stages before it deliver in it. A
/// virtual machine that is not served for a moment makes one long; so also what all but one in a thousand stay below.
void worst_window(benchmark::State& state) {
    constexpr double least = 1e-4; // [s], of a prepare() that plans
    const auto machine = limits<double>(jerk);
    std::vector<double> windows;
    std::uint64_t slow_legs = 0;
    for (auto _ : state) {
        const auto stages = std::make_unique<JerkStages<double, double>>(state.range(0), machine);
        JerkPlan<double, double>& plan = stages->plan;
        const double start = thread_seconds();
        for (bool more = true; more;) {
            const double before = thread_seconds();
            more = plan.prepare() == Pull::item;
            if (const double seconds = thread_seconds() - before; seconds > least) {
                windows.push_back(seconds);
            }
            if (more) {
                plan.advance();
            }
        }
        state.SetIterationTime(thread_seconds() - start);
        slow_legs = plan.slow_legs();
    }
    if (windows.empty()) {
        state.SkipWithError("no window was planned");
        return;
    }
    std::sort(windows.begin(), windows.end());
    state.counters["worst_ms"] = 1e3 * windows.back();
    state.counters["all_but_0.1%_ms"] = 1e3 * windows[windows.size() - 1 - windows.size() / 1000];
    state.counters["slow_legs"] = static_cast<double>(slow_legs);
}

/// From rest to rest on a straight line, the closed form: moves that reach every limit, some, or none.
void straight_move(benchmark::State& state) {
    constexpr std::array<double, 8> lengths{0.003, 0.04, 0.5, 2.0, 7.0, 30.0, 110.0, 900.0};
    constexpr std::array<MoveLimits, 3> machines{
        {{100.0, 1000.0, 30000.0}, {400.0, 3000.0, 60000.0}, {20.0, 5000.0, 1e6}}};
    std::int64_t moves = 0;
    for (auto _ : state) {
        for (const MoveLimits& machine : machines) {
            for (double length : lengths) {
                benchmark::DoNotOptimize(length);
                const SCurveProfile move(length, machine);
                benchmark::DoNotOptimize(move);
                ++moves;
            }
        }
    }
    state.SetItemsProcessed(moves);
}

void lengths(benchmark::internal::Benchmark* row) {
    row->RangeMultiplier(10)->Range(1000, 1000000)->UseManualTime()->Unit(benchmark::kMillisecond);
}

// NOLINTBEGIN
BENCHMARK(feed_plan<double>)->Apply(lengths);
BENCHMARK(feed_plan<Fixed>)->Apply(lengths);
BENCHMARK((jerk_plan<double, double>))->Apply(lengths);
BENCHMARK((jerk_plan<Fixed, float>))->Apply(lengths);
BENCHMARK(worst_window)->Apply(lengths);
BENCHMARK(straight_move);
// NOLINTEND

} // namespace
