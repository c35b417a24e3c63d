// SPDX-License-Identifier: MIT
// What each streaming curve method costs a waypoint: three axes, raster of 8040 points. items_per_second counts
// waypoints. The methods that need all points: interpolation_bench.
#include "raster.hpp"

#include "splinefeed/s1_curve/bspline_curve.hpp"
#include "splinefeed/s1_curve/catmull_rom.hpp"
#include "splinefeed/s1_curve/catmull_rom_modified.hpp"
#include "splinefeed/s1_curve/g2_bezier.hpp"
#include "splinefeed/s1_curve/g2_spline.hpp"
#include "splinefeed/s1_curve/polyline.hpp"
#include "splinefeed/s1_curve/smoothed_curve.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace splinefeed;

/// Pushes all waypoints into a curve and drains `source`, which is the curve or a decorator of it.
template <Scalar S>
void stream(benchmark::State& state, const std::vector<Waypoint<S>>& points, WaypointCurve<S>& curve,
            CurveSource<S>& source) {
    CurveSegment<S> segment;
    const auto drain = [&] {
        while (source.next(segment) == Pull::item) {
            benchmark::DoNotOptimize(segment);
        }
    };
    for (const Waypoint<S>& point : points) {
        if (!curve.push(point).ok()) {
            state.SkipWithError("a waypoint was refused");
            return;
        }
        drain();
    }
    if (!curve.finish().ok()) {
        state.SkipWithError("the curve was refused");
    }
    drain();
}

template <Scalar S, class Curve, bool smooth = false, class... Arguments>
void method(benchmark::State& state, const Arguments&... arguments) {
    const auto points = bench::raster<S>();
    for (auto _ : state) {
        Curve curve(CurveOptions<S>{}, arguments...);
        if constexpr (smooth) {
            SmoothedCurve<S> smoothed(curve);
            stream<S>(state, points, curve, smoothed);
        } else {
            stream<S>(state, points, curve, curve);
        }
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points.size()));
    state.counters["bytes"] = sizeof(Curve) + (smooth ? sizeof(SmoothedCurve<S>) : 0);
}

template <Scalar S>
void g2(benchmark::State& state) {
    method<S, G2Spline<S>>(state);
}
template <Scalar S>
void g2_bezier(benchmark::State& state) {
    method<S, G2Bezier<S>>(state);
}
template <Scalar S>
void catmull_rom(benchmark::State& state) {
    method<S, CatmullRom<S>>(state, literal<S>(0.5));
}
template <Scalar S>
void catmull_rom_smooth(benchmark::State& state) {
    method<S, CatmullRom<S>, true>(state, literal<S>(0.5));
}
template <Scalar S>
void catmull_rom_modified(benchmark::State& state) {
    method<S, CatmullRomModified<S>>(state, literal<S>(1.0));
}
template <Scalar S>
void bspline(benchmark::State& state) {
    method<S, BSplineCurve<S>>(state, 3);
}
template <Scalar S>
void polyline(benchmark::State& state) {
    method<S, Polyline<S>>(state);
}

#define EVERY_SCALAR(function)                                                                                         \
    BENCHMARK(function<double>);                                                                                       \
    BENCHMARK(function<float>);                                                                                        \
    BENCHMARK(function<Fixed>)
EVERY_SCALAR(g2);
EVERY_SCALAR(g2_bezier);
EVERY_SCALAR(catmull_rom);
EVERY_SCALAR(catmull_rom_smooth);
EVERY_SCALAR(catmull_rom_modified);
EVERY_SCALAR(bspline);
EVERY_SCALAR(polyline);

} // namespace
