// SPDX-License-Identifier: MIT
// Evaluation of one three-axis cubic: position and two derivatives; and the inverse of arc length.
#include "raster.hpp"

#include "splinefeed/s1_curve/jet.hpp"
#include "splinefeed/s2_arc_length/cell.hpp"

#include <benchmark/benchmark.h>

namespace {

using namespace splinefeed;

template <Scalar S>
CurveSegment<S> cubic() {
    CurveSegment<S> out;
    out.axes = 3;
    out.degree = 3;
    PerAxis<PerDegree<S>> offsets{};
    for (unsigned k = 0; k < 3; ++k) {
        for (unsigned i = 1; i < 4; ++i) {
            offsets[k][i] = from_double<S>(4096.0 * (i + 0.1 * i * i * (k + 1)));
        }
    }
    out.assign(offsets);
    return out;
}

template <Scalar S>
void evaluate_two_derivatives(benchmark::State& state) {
    const CurveSegment<S> segment = cubic<S>();
    Jet<S> jet;
    const S step = from_double<S>(0.0001);
    S u{};
    for (auto _ : state) {
        evaluate(segment, u, jet);
        benchmark::DoNotOptimize(jet);
        u = u < from_integer<S>(1) ? u + step : S{};
    }
}

template <Scalar S>
void position_at_length(benchmark::State& state) {
    Cell<S> cell;
    cell.axes = 3;
    cell.degree = 3;
    cell.unit_log2 = -16;
    for (unsigned k = 0; k < 3; ++k) {
        cell.power[k] = cubic<S>().control[k];
    }
    cell.inverse = {from_double<Ratio<S>>(-0.4), from_double<Ratio<S>>(0.4)};
    PerAxis<Position> position{};
    const S step = from_double<S>(0.0001);
    S x{};
    for (auto _ : state) {
        cell.position_at(x, position);
        benchmark::DoNotOptimize(position);
        x = x < from_integer<S>(1) ? x + step : S{};
    }
}

// NOLINTBEGIN
BENCHMARK(evaluate_two_derivatives<double>);
BENCHMARK(evaluate_two_derivatives<float>);
BENCHMARK(evaluate_two_derivatives<Fixed>);
BENCHMARK(position_at_length<double>);
BENCHMARK(position_at_length<float>);
BENCHMARK(position_at_length<Fixed>);
// NOLINTEND

} // namespace
