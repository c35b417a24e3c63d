// SPDX-License-Identifier: MIT
// Interpolating B-splines with their storage, and a second way to them: basis functions by the printed recursion, and
// dense elimination.
#pragma once

#include "splinefeed/splines/bspline_basis.hpp"
#include "splinefeed/splines/bspline_interpolation.hpp"
#include "splinefeed/splines/spline_parameters.hpp"
#include "support/dense_solve.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace splinefeed_test {

/// What is interpolated, in double; exactly representable in every scalar where a test needs that.
struct Job {
    std::vector<std::vector<double>> points;
    splinefeed::InterpolationKind kind{};
    splinefeed::Parameterization how = splinefeed::Parameterization::chordal;
    splinefeed::KnotRule rule = splinefeed::KnotRule::average;
    double domain = 1.0;
    std::vector<double> start{};
    std::vector<double> end{};
    std::vector<double> parameters{}; ///< given ones, instead of `how`
    std::vector<double> knots{};      ///< given ones, instead of `rule`
};

template <splinefeed::Scalar S>
splinefeed::Point<S> to_point(const std::vector<double>& v) {
    splinefeed::Point<S> p{};
    for (std::size_t k = 0; k < v.size(); ++k) {
        p[k] = splinefeed::from_double<S>(v[k]);
    }
    return p;
}

/// A curve and all that led to it.
template <splinefeed::Scalar S>
struct Curve {
    splinefeed::Error error = splinefeed::Error::none;
    splinefeed::InterpolationKind kind{};
    int axes = 0;
    std::vector<splinefeed::Point<S>> points;
    std::vector<S> parameters;
    std::vector<S> knots;
    std::vector<splinefeed::Point<S>> controls;
    S slack{};

    [[nodiscard]] bool ok() const { return error == splinefeed::Error::none; }
    [[nodiscard]] splinefeed::CurveJet<S> at(S t) const {
        return splinefeed::bspline_curve<S>(knots, kind.degree, controls, axes, t);
    }
};

template <splinefeed::Scalar S>
Curve<S> interpolated(const Job& job) {
    using namespace splinefeed;
    Curve<S> out;
    out.kind = job.kind;
    out.axes = job.points.empty() ? 1 : static_cast<int>(job.points.front().size());
    for (const auto& p : job.points) {
        out.points.push_back(to_point<S>(p));
    }
    const std::size_t count = out.points.size();
    const auto failed = [&](Status status) {
        out.error = status.error();
        return !status.ok();
    };
    if (job.parameters.empty()) {
        out.parameters.resize(count);
        if (failed(spline_parameters<S>(out.points, out.axes, job.how, job.kind.closed, from_double<S>(job.domain),
                                        out.parameters))) {
            return out;
        }
    }
    for (const double t : job.parameters) {
        out.parameters.push_back(from_double<S>(t));
    }
    if (job.knots.empty()) {
        out.knots.resize(std::max<std::size_t>(job.kind.knots(count), 40));
        if (failed(
                job.kind.closed
                    ? closed_knots<S>(job.rule, out.parameters, job.kind.degree, from_double<S>(job.domain), out.knots)
                    : open_knots<S>(job.rule, out.parameters, job.kind.degree, job.kind.end_derivatives, out.knots))) {
            return out;
        }
        out.knots.resize(job.kind.knots(count));
    }
    for (const double u : job.knots) {
        out.knots.push_back(from_double<S>(u));
    }
    const BandShape shape = job.kind.band(count);
    std::vector<S> entries(shape.entries());
    std::vector<std::uint8_t> interchanges(shape.interchanges());
    BsplineInterpolation<S> system;
    if (failed(system.prepare(job.kind, out.parameters, out.knots, entries, interchanges))) {
        return out;
    }
    out.slack = system.slack();
    out.controls.resize(job.kind.controls(count));
    const EndDerivatives<S> ends{to_point<S>(job.start), to_point<S>(job.end)};
    failed(system.interpolate(out.points, job.kind.end_derivatives ? &ends : nullptr, out.axes, out.controls));
    return out;
}

/// N_i^k(t) by the recursion as it stands in the paper, with half-open spans and 0/0 = 0; `last` closes the last span.
inline Real recursive_basis(const std::vector<Real>& u, std::size_t i, int k, Real t, Real last) {
    if (k == 0) {
        const bool closing = t == last && u[i] < u[i + 1U] && u[i + 1U] == last;
        return (u[i] <= t && t < u[i + 1U]) || closing ? 1.0L : 0.0L;
    }
    const auto d = static_cast<std::size_t>(k);
    Real sum = 0.0L;
    if (u[i + d] > u[i]) {
        sum += (t - u[i]) / (u[i + d] - u[i]) * recursive_basis(u, i, k - 1, t, last);
    }
    if (u[i + d + 1U] > u[i + 1U]) {
        sum += (u[i + d + 1U] - t) / (u[i + d + 1U] - u[i + 1U]) * recursive_basis(u, i + 1U, k - 1, t, last);
    }
    return sum;
}

/// First derivative of N_i^k by t.
inline Real recursive_slope(const std::vector<Real>& u, std::size_t i, int k, Real t, Real last) {
    const auto d = static_cast<std::size_t>(k);
    Real sum = 0.0L;
    if (u[i + d] > u[i]) {
        sum += static_cast<Real>(k) / (u[i + d] - u[i]) * recursive_basis(u, i, k - 1, t, last);
    }
    if (u[i + d + 1U] > u[i + 1U]) {
        sum -= static_cast<Real>(k) / (u[i + d + 1U] - u[i + 1U]) * recursive_basis(u, i + 1U, k - 1, t, last);
    }
    return sum;
}

/// Collocation matrix and right-hand sides of a job for given parameters and knots, rows in the order of the points,
/// then the derivatives.
inline std::pair<Matrix, Matrix> dense_system(const Job& job, const std::vector<Real>& t, const std::vector<Real>& u) {
    const std::size_t points = t.size();
    const std::size_t size = job.kind.controls(points);
    const auto k = static_cast<std::size_t>(job.kind.degree);
    const Real first = u[k];
    const Real last = u[u.size() - k - 1U];
    Matrix a;
    Matrix b;
    const auto add_row = [&](Real at, bool slope, const std::vector<double>& value) {
        std::vector<Real> row(size);
        const Real local = job.kind.closed ? (at < first ? at + (last - first) : at) : at;
        for (std::size_t i = 0; i + k + 1U < u.size(); ++i) {
            row[i % size] += slope ? recursive_slope(u, i, job.kind.degree, local, last)
                                   : recursive_basis(u, i, job.kind.degree, local, last);
        }
        a.push_back(std::move(row));
        b.emplace_back(value.begin(), value.end());
    };
    for (std::size_t i = 0; i < points; ++i) {
        add_row(t[i], false, job.points[i]);
    }
    if (job.kind.end_derivatives) {
        add_row(t.front(), true, job.start);
        add_row(t.back(), true, job.end);
    }
    return {a, b};
}

template <splinefeed::Scalar S>
std::vector<Real> to_reals(const std::vector<S>& values) {
    std::vector<Real> out;
    for (const S value : values) {
        out.push_back(static_cast<Real>(splinefeed::to_double(value)));
    }
    return out;
}

/// Random points in a box of the given size whose chords have lengths from 1 to `ratio`.
inline std::vector<std::vector<double>> random_points(std::mt19937_64& random, std::size_t count, std::size_t axes,
                                                      double ratio = 1.0, bool grid = false) {
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::uniform_real_distribution<double> exponent(0.0, 1.0);
    std::vector<std::vector<double>> points{std::vector<double>(axes)};
    while (points.size() < count) {
        std::vector<double> next = points.back();
        const double step = std::pow(ratio, exponent(random));
        for (double& x : next) {
            x += step * unit(random);
            x = grid ? std::ldexp(std::round(std::ldexp(x, 10)), -10) : x;
        }
        points.push_back(next);
    }
    return points;
}

} // namespace splinefeed_test
