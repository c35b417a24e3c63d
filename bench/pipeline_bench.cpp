// SPDX-License-Identifier: MIT
// What a waypoint costs, stage by stage. Each stage is measured with all stages before it; the difference of two rows
// is the cost of a stage alone. items_per_second counts waypoints.
#include "raster.hpp"

#include "splinefeed/acceleration_planner.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/trajectory.hpp"

#include <benchmark/benchmark.h>

#include <memory>

namespace {

using namespace splinefeed;

constexpr std::size_t window_cells = 1024;

template <Scalar S>
MotionLimits<S> limits() {
    MachineSettings machine;
    for (AxisSettings& axis : machine.axis) {
        axis.steps_per_mm = 320;
    }
    return MotionLimits<S>::make(machine).value();
}

/// Feeds waypoints into the curve whenever `drain` starves, until all `count` are through.
template <Scalar S, class Drain, class Source>
void pump(G2Spline<S>& curve, std::int64_t count, const Source& source, Drain&& drain) {
    for (std::int64_t i = 0; i < count; ++i) {
        if (!curve.push(source(i)).ok()) {
            std::abort();
        }
        drain();
    }
    if (!curve.finish().ok()) {
        std::abort();
    }
    drain();
}

template <Scalar S>
void curve_only(benchmark::State& state) {
    const auto points = bench::raster<S>();
    CurveSegment<S> segment;
    for (auto _ : state) {
        G2Spline<S> curve(CurveOptions<S>{});
        pump(
            curve, static_cast<std::int64_t>(points.size()),
            [&](std::int64_t i) { return points[static_cast<std::size_t>(i)]; },
            [&] {
                while (curve.next(segment) == Pull::item) {
                    benchmark::DoNotOptimize(segment);
                }
            });
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
    state.counters["bytes"] = sizeof(G2Spline<S>);
}

template <Scalar S>
void to_arc_length(benchmark::State& state) {
    const auto points = bench::raster<S>();
    const auto machine = limits<S>();
    Cell<S> cell;
    for (auto _ : state) {
        G2Spline<S> curve(CurveOptions<S>{});
        auto arc_length = std::make_unique<ArcLength<S>>(curve, machine.refinement);
        pump(
            curve, static_cast<std::int64_t>(points.size()),
            [&](std::int64_t i) { return points[static_cast<std::size_t>(i)]; },
            [&] {
                while (arc_length->next(cell) == Pull::item) {
                    benchmark::DoNotOptimize(cell);
                }
            });
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
    state.counters["bytes"] = sizeof(ArcLength<S>);
}

template <Scalar S>
void to_feed_plan(benchmark::State& state) {
    const auto points = bench::raster<S>();
    const auto machine = limits<S>();
    std::vector<PlannedCell<S>> window(window_cells);
    for (auto _ : state) {
        G2Spline<S> curve(CurveOptions<S>{});
        auto arc_length = std::make_unique<ArcLength<S>>(curve, machine.refinement);
        FeedPlan<S> plan(*arc_length, machine, window);
        pump(
            curve, static_cast<std::int64_t>(points.size()),
            [&](std::int64_t i) { return points[static_cast<std::size_t>(i)]; },
            [&] {
                while (plan.prepare() == Pull::item) {
                    benchmark::DoNotOptimize(plan.front());
                    plan.pop();
                }
            });
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
    state.counters["bytes"] = static_cast<double>(sizeof(FeedPlan<S>) + window_cells * sizeof(PlannedCell<S>));
}

template <Scalar S>
void pipeline(benchmark::State& state, std::int64_t count, const auto& source) {
    const auto machine = limits<S>();
    std::vector<PlannedCell<S>> window(window_cells);
    FeedSegment segment;
    std::int64_t segments = 0;
    for (auto _ : state) {
        G2Spline<S> curve(CurveOptions<S>{});
        auto planner = std::make_unique<AccelerationPlanner<S>>(window);
        auto trajectory = Trajectory<S>::make(curve, machine, *planner).value();
        pump(curve, count, source, [&] {
            while (trajectory.next(segment) == Pull::item) {
                benchmark::DoNotOptimize(segment);
                ++segments;
            }
        });
    }
    state.SetItemsProcessed(state.iterations() * count);
    state.counters["bytes"] = sizeof(SegmentStream<S>);
    state.counters["segments_per_waypoint"] =
        static_cast<double>(segments) / static_cast<double>(state.iterations() * count);
}

template <Scalar S>
void to_segment_stream(benchmark::State& state) {
    const auto points = bench::raster<S>();
    pipeline<S>(state, static_cast<std::int64_t>(points.size()),
                [&](std::int64_t i) { return points[static_cast<std::size_t>(i)]; });
}

/// The same work per waypoint however long the program: rows of 10^3 and 10^6 must agree.
template <Scalar S>
void helix(benchmark::State& state) {
    pipeline<S>(state, state.range(0), [](std::int64_t i) { return bench::helix<S>(i); });
}

// NOLINTBEGIN
BENCHMARK(curve_only<double>);
BENCHMARK(to_arc_length<double>);
BENCHMARK(to_feed_plan<double>);
BENCHMARK(to_segment_stream<double>);
BENCHMARK(curve_only<float>);
BENCHMARK(to_arc_length<float>);
BENCHMARK(to_feed_plan<float>);
BENCHMARK(to_segment_stream<float>);
BENCHMARK(curve_only<Fixed>);
BENCHMARK(to_arc_length<Fixed>);
BENCHMARK(to_feed_plan<Fixed>);
BENCHMARK(to_segment_stream<Fixed>);
BENCHMARK(helix<double>)->Arg(1000)->Arg(1000000)->Unit(benchmark::kMillisecond);
BENCHMARK(helix<Fixed>)->Arg(1000)->Arg(1000000)->Unit(benchmark::kMillisecond);
// NOLINTEND

} // namespace
