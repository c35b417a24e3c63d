// SPDX-License-Identifier: MIT
// Interpolation of n points in 3-D that are all known, and evaluation of a cubic B-spline with two derivatives; against
// SISL where it is installed (Debian: libsisl-dev). items_per_second counts points, or evaluations.
#include "splinefeed/splines/beta_chain.hpp"
#include "splinefeed/splines/bspline_basis.hpp"
#include "splinefeed/splines/bspline_interpolation.hpp"
#include "splinefeed/splines/ferguson.hpp"
#include "splinefeed/splines/g2_bezier.hpp"
#include "splinefeed/splines/spline_parameters.hpp"

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#ifdef SPLINEFEED_HAS_SISL
extern "C" {
#include <sisl.h>
}
#endif

namespace {

using namespace splinefeed;

constexpr int axes = 3;

/// A noisy helix, 0.35 mm a point, axes numbers a point.
std::vector<double> helix(std::size_t count) {
    std::vector<double> out;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 0.0174 * static_cast<double>(i);
        const double noise = 0.01 * std::sin(12.9 * static_cast<double>(i));
        out.insert(out.end(), {20.0 * std::cos(angle) + noise, 20.0 * std::sin(angle) - noise, 0.01 * angle});
    }
    return out;
}

/// The natural cubic spline by chord length: tangents at all points.
void natural_cubic(benchmark::State& state) {
    const auto count = static_cast<std::size_t>(state.range(0));
    const std::vector<double> points = helix(count);
    std::vector<double> tangents(points.size());
    std::vector<double> scratch(count);
    G2BezierInput<double> input;
    input.axes = axes;
    input.coordinates = points;
    for (auto _ : state) {
        if (!g2_bezier_tangents<double>(input, tangents, scratch).ok()) {
            state.SkipWithError("refused");
        }
        benchmark::DoNotOptimize(tangents.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(natural_cubic)->Arg(1000)->Arg(100000);

/// A B-spline through the points with its parameters, knots, system and control points.
struct Interpolated {
    InterpolationKind kind;
    std::vector<Point<double>> points;
    std::vector<double> parameters;
    std::vector<double> knots;
    std::vector<double> entries;
    std::vector<std::uint8_t> interchanges;
    std::vector<Point<double>> controls;

    Interpolated(std::size_t count, int degree) : points(count), parameters(count) {
        kind.degree = degree;
        const std::vector<double> numbers = helix(count);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = 0; k < axes; ++k) {
                points[i][k] = numbers[axes * i + k];
            }
        }
        knots.resize(kind.knots(count));
        entries.resize(kind.band(count).entries());
        interchanges.resize(kind.band(count).interchanges());
        controls.resize(kind.controls(count));
    }

    bool solve() {
        BsplineInterpolation<double> system;
        return spline_parameters<double>(points, axes, Parameterization::chordal, false,
                                         static_cast<double>(points.size() - 1), parameters)
                   .ok() &&
               open_knots<double>(KnotRule::average, parameters, kind.degree, false, knots).ok() &&
               system.prepare(kind, parameters, knots, entries, interchanges).ok() &&
               system.interpolate(points, nullptr, axes, controls).ok();
    }
};

template <int degree>
void interpolate_bspline(benchmark::State& state) {
    Interpolated curve(static_cast<std::size_t>(state.range(0)), degree);
    for (auto _ : state) {
        if (!curve.solve()) {
            state.SkipWithError("refused");
        }
        benchmark::DoNotOptimize(curve.controls.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(interpolate_bspline<3>)->Arg(1000)->Arg(100000);
BENCHMARK(interpolate_bspline<5>)->Arg(1000);

std::vector<Point<double>> points_of(const std::vector<double>& numbers) {
    std::vector<Point<double>> points(numbers.size() / axes);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        points[i / axes][i % axes] = numbers[i];
    }
    return points;
}

void ferguson_curve(benchmark::State& state) {
    const auto points = points_of(helix(1000));
    const std::vector<FergusonJoint<double>> joints(points.size() - 2);
    FergusonInput<double> input;
    input.points = points;
    input.joints = joints;
    std::vector<Point<double>> in(points.size());
    std::vector<Point<double>> out(points.size());
    std::vector<BezierPiece<double>> pieces(points.size());
    std::vector<CyclicRow<double>> system(points.size());
    FergusonReport<double> report;
    for (auto _ : state) {
        if (!ferguson<double>(input, {in, out, pieces, system}, report).ok()) {
            state.SkipWithError("refused");
        }
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * 1000);
}
BENCHMARK(ferguson_curve);

void beta_chain_curve(benchmark::State& state) {
    const auto points = points_of(helix(1002)); // 6 of the first polygon, 3 of each further one
    const std::vector<Beta<double>> betas(332);
    BetaChain<double> chain;
    chain.degree = 5;
    chain.first_polygon = std::span(points).first(6);
    chain.free_points = std::span(points).subspan(6);
    chain.betas = betas;
    std::vector<BezierPiece<double>> pieces(chain.piece_count());
    std::vector<BetaJoint<double>> joints(betas.size());
    for (auto _ : state) {
        if (!beta_chain<double>(chain, pieces, joints).ok()) {
            state.SkipWithError("refused");
        }
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * 1002);
}
BENCHMARK(beta_chain_curve);

void evaluate_bspline(benchmark::State& state) {
    Interpolated curve(1000, 3);
    if (!curve.solve()) {
        state.SkipWithError("refused");
    }
    double t = 0.0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(bspline_curve<double>(curve.knots, 3, curve.controls, axes, t));
        t = t < 998.0 ? t + 0.37 : 0.0;
    }
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(evaluate_bspline);

#ifdef SPLINEFEED_HAS_SISL

SISLCurve* sisl_through(std::vector<double>& points) {
    const int count = static_cast<int>(points.size()) / axes;
    std::vector<int> ordinary(static_cast<std::size_t>(count), 1);
    double end = 0.0;
    SISLCurve* curve = nullptr;
    double* parameters = nullptr;
    int parameter_count = 0;
    int status = 0;
    // Natural ends (1: no curvature there), open, cubic.
    s1356(points.data(), count, axes, ordinary.data(), 1, 1, 1, 4, 0.0, &end, &curve, &parameters, &parameter_count,
          &status);
    std::free(parameters);
    return status < 0 ? nullptr : curve;
}

void sisl_natural_cubic(benchmark::State& state) {
    std::vector<double> points = helix(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) {
        SISLCurve* const curve = sisl_through(points);
        if (curve == nullptr) {
            state.SkipWithError("refused");
            break;
        }
        freeCurve(curve);
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(sisl_natural_cubic)->Arg(1000)->Arg(100000);

void sisl_evaluate(benchmark::State& state) {
    std::vector<double> points = helix(1000);
    SISLCurve* const curve = sisl_through(points);
    if (curve == nullptr) {
        state.SkipWithError("refused");
        return;
    }
    const double end = curve->et[curve->in];
    double t = 0.0;
    double jet[9];
    int left = 0;
    int status = 0;
    for (auto _ : state) {
        s1227(curve, 2, t, &left, jet, &status);
        benchmark::DoNotOptimize(jet);
        t = t < 0.99 * end ? t + 0.37e-3 * end : 0.0;
    }
    freeCurve(curve);
    state.SetItemsProcessed(state.iterations());
}
BENCHMARK(sisl_evaluate);

#endif

} // namespace
