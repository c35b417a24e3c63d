// SPDX-License-Identifier: MIT
//
// What the streaming curves must agree with, computed another way: all waypoints at once, in long double, from the
// second derivatives ("moments") of the spline instead of its control points.
#pragma once

#include "splinefeed/s1_curve/waypoint_curve.hpp"
#include "support/dense_solve.hpp"
#include "support/random_path.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace splinefeed_test {

using Vec = std::array<Real, 6>;

inline Vec operator+(const Vec& a, const Vec& b) {
    Vec r{};
    for (unsigned k = 0; k < 6; ++k) {
        r[k] = a[k] + b[k];
    }
    return r;
}
inline Vec operator*(Real f, const Vec& a) {
    Vec r{};
    for (unsigned k = 0; k < 6; ++k) {
        r[k] = f * a[k];
    }
    return r;
}
inline Vec operator-(const Vec& a, const Vec& b) {
    return a + (-1.0L) * b;
}
inline Real dot(const Vec& a, const Vec& b) {
    Real sum = 0.0L;
    for (unsigned k = 0; k < 6; ++k) {
        sum += a[k] * b[k];
    }
    return sum;
}
inline Real size(const Vec& a) {
    return std::sqrt(dot(a, a));
}
inline Real distance_of(const Vec& a, const Vec& b) {
    return size(a - b);
}

/// Bezier points of a cubic in mm, seen from the waypoint it starts at.
using Cubic = std::array<Vec, 4>;

/// Curvature vector at an end of a cubic given by its first three points from there.
inline Vec curvature(const Vec& p0, const Vec& p1, const Vec& p2) {
    const Vec d1 = 3.0L * (p1 - p0);
    const Vec d2 = 6.0L * (p2 - 2.0L * p1 + p0);
    const Real n = dot(d1, d1);
    return (1.0L / n) * (d2 - (dot(d1, d2) / n) * d1);
}

/// Differences of the waypoints, exact.
inline std::vector<Vec> chords_of(const Path& path) {
    std::vector<Vec> chords;
    for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
        Vec chord{};
        for (const unsigned k : splinefeed::indices(path.axes)) {
            chord[k] = std::ldexp(static_cast<Real>(path.points[i + 1][k].raw - path.points[i][k].raw), -40);
        }
        chords.push_back(chord);
    }
    return chords;
}

inline std::vector<Real> spans_of(const std::vector<Vec>& chords, splinefeed::Parameterization how) {
    std::vector<Real> spans;
    for (const Vec& chord : chords) {
        spans.push_back(how == splinefeed::Parameterization::uniform   ? 1.0L
                        : how == splinefeed::Parameterization::chordal ? size(chord)
                                                                       : std::sqrt(size(chord)));
    }
    return spans;
}

/// Derivatives by the parameter at the ends; absent: natural.
struct Ends {
    bool start = false;
    bool end = false;
    Vec start_derivative{};
    Vec end_derivative{};
};

inline std::vector<Cubic> cubics_from_moments(const std::vector<Vec>& chords, const std::vector<Real>& h,
                                              const std::vector<Vec>& m) {
    std::vector<Cubic> out;
    for (std::size_t i = 0; i < chords.size(); ++i) {
        const Vec slope = (1.0L / h[i]) * chords[i];
        const Vec& after = m[(i + 1) % m.size()];
        const Vec left = slope - (h[i] / 6.0L) * (2.0L * m[i] + after);
        const Vec right = slope + (h[i] / 6.0L) * (m[i] + 2.0L * after);
        out.push_back({Vec{}, (h[i] / 3.0L) * left, chords[i] - (h[i] / 3.0L) * right, chords[i]});
    }
    return out;
}

/// The C2 cubic spline through one smooth run. Diagonally dominant: elimination without pivoting, linear in the length.
inline std::vector<Cubic> solve_run(const std::vector<Vec>& chords, const std::vector<Real>& h, const Ends& ends = {}) {
    const std::size_t n = chords.size();
    std::vector<Real> below(n + 1, 0.0L);
    std::vector<Real> on(n + 1, 1.0L);
    std::vector<Real> above(n + 1, 0.0L);
    std::vector<Vec> m(n + 1);
    const auto slope = [&](std::size_t i) {
        return (1.0L / h[i]) * chords[i];
    };
    for (std::size_t i = 1; i < n; ++i) {
        below[i] = h[i - 1];
        on[i] = 2.0L * (h[i - 1] + h[i]);
        above[i] = h[i];
        m[i] = 6.0L * (slope(i) - slope(i - 1));
    }
    if (ends.start) {
        on[0] = 2.0L * h[0];
        above[0] = h[0];
        m[0] = 6.0L * (slope(0) - ends.start_derivative);
    }
    if (ends.end) {
        on[n] = 2.0L * h[n - 1];
        below[n] = h[n - 1];
        m[n] = 6.0L * (ends.end_derivative - slope(n - 1));
    }
    for (std::size_t i = 1; i <= n; ++i) {
        const Real f = below[i] / on[i - 1];
        on[i] -= f * above[i - 1];
        m[i] = m[i] - f * m[i - 1];
    }
    m[n] = (1.0L / on[n]) * m[n];
    for (std::size_t i = n; i-- > 0;) {
        m[i] = (1.0L / on[i]) * (m[i] - above[i] * m[i + 1]);
    }
    return cubics_from_moments(chords, h, m);
}

/// The periodic C2 cubic spline; chord i leads from point i to point i + 1, the last one back to point 0.
inline std::vector<Cubic> solve_periodic(const std::vector<Vec>& chords, const std::vector<Real>& h) {
    const std::size_t n = chords.size();
    Matrix a(n, std::vector<Real>(n, 0.0L));
    Matrix b;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t p = (i + n - 1) % n;
        a[i][p] += h[p];
        a[i][i] += 2.0L * (h[p] + h[i]);
        a[i][(i + 1) % n] += h[i];
        const Vec right = 6.0L * ((1.0L / h[i]) * chords[i] - (1.0L / h[p]) * chords[p]);
        b.emplace_back(right.begin(), right.end());
    }
    dense_solve(a, b);
    std::vector<Vec> moments(n);
    for (std::size_t i = 0; i < n; ++i) {
        std::copy(b[i].begin(), b[i].end(), moments[i].begin());
    }
    return cubics_from_moments(chords, h, moments);
}

/// What committing control point i from row R = min(i + 13, ...) costs, for every knot of a run of n segments.
///
/// The truncated solution and the true one differ by a spline that vanishes at all knots up to R: a multiple of w, the
/// solution of the homogeneous equations with the run's own start. At R the guess delta_{R+1} = delta_R is wrong by
/// g/(1+g) |delta_{R+1} - delta_R| with g = -w_R/w_{R+1}. For even spacing w_i/w_R tends to 0.268^13 = 3.7e-8.
inline std::vector<Real> truncation_of(const std::vector<Cubic>& cubics, const std::vector<Real>& h, bool given_start) {
    const std::size_t n = h.size();
    std::vector<Real> loss(n + 1, 0.0L);
    if (n < 16) {
        return loss; // every row is known before anything is committed
    }
    std::vector<Vec> delta(n + 1); // blossom at (t_{i-1}, t_i, t_{i+1}), from the cubic after knot i
    delta[n] = cubics[n - 1][2] - cubics[n - 1][3];
    for (std::size_t i = 0; i < n; ++i) {
        const Real u = i > 0 ? -h[i - 1] / h[i] : 0.0L;
        delta[i] = (1.0L - u) * cubics[i][1] + u * cubics[i][2];
    }
    std::vector<Real> w(n + 1);
    const Real f = h[0] / (h[0] + h[1]);
    w[0] = given_start ? 0.0L : f;
    w[1] = given_start ? 1.0L : 1.0L + f;
    for (std::size_t i = 1; i < n; ++i) {
        const Real two_before = i > 1 ? h[i - 2] : 0.0L;
        const Real omega = h[i - 1] / (h[i - 1] + h[i]);
        const Real a = (1.0L - omega) * h[i] / (two_before + h[i - 1] + h[i]);
        const Real c = omega * h[i - 1] / (h[i - 1] + h[i] + (i + 1 < n ? h[i + 1] : 0.0L));
        w[i + 1] = -((1.0L - a - c) * w[i] + a * w[i - 1]) / c;
    }
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t r = (i > 2 ? i - 2 : 0) + 15;
        if (r < n) { // row n is the end of the run: nothing is guessed
            const Real g = -w[r] / w[r + 1];
            loss[i] = std::fabs(w[i] / w[r] * g / (1.0L + g)) * distance_of(delta[r], delta[r + 1]);
        }
    }
    return loss;
}

} // namespace splinefeed_test
