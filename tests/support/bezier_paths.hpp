// SPDX-License-Identifier: MIT
//
// Bezier segments for the tests of the stages behind the curve: random ones of every degree, near-cusps and cusps, a
// source that hands them out (starving as often as asked), and their evaluation in long double.
#pragma once

#include "exact.hpp"
#include "splinefeed/s1_curve/curve_source.hpp"

#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace splinefeed_test {

using namespace splinefeed;

/// A widening that is meant.
constexpr Real real(double x) {
    return static_cast<Real>(x);
}

/// Offsets of the Bezier points of one segment from its start, in mm: offset[axis][i], offset[axis][0] = 0.
struct TestShape {
    int axes = 3;
    int degree = 3;
    PerAxis<PerDegree<double>> offset{};
    double feed_mm_s = 0.0;
    double max_feed_mm_s = 0.0;
    bool stop_at_end = false;
};

using BezierPath = std::vector<TestShape>;

class Random {
public:
    explicit Random(std::uint64_t seed) : generator_(seed) {}
    double between(double low, double high) {
        return low + (high - low) * static_cast<double>(generator_() >> 11) * 0x1p-53;
    }
    int integer(int low, int high) {
        return low + static_cast<int>(generator_() % static_cast<std::uint64_t>(high - low + 1));
    }
    /// Evenly distributed over decades.
    double decades(double low, double high) { return low * std::pow(high / low, between(0.0, 1.0)); }
    bool chance(double p) { return between(0.0, 1.0) < p; }

private:
    std::mt19937_64 generator_;
};

/// The rounding of a control point, at most 2^16 units, in units of the segment.
template <Scalar S>
constexpr Real control_rounding() {
    return std::same_as<S, float> ? 0x1p-8L : std::same_as<S, Fixed> ? 0x1p-32L : 0x1p-37L;
}

/// Relative rounding of one operation on numbers around one.
template <Scalar S>
constexpr Real rounding() {
    return std::same_as<S, float> ? 0x1p-24L : std::same_as<S, Fixed> ? 0x1p-32L : 0x1p-53L;
}

/// That of its Ratio.
template <Scalar S>
constexpr Real ratio_rounding() {
    return std::same_as<S, Fixed> ? 0x1p-30L : rounding<S>();
}

template <Scalar S>
std::vector<CurveSegment<S>> segments_of(const BezierPath& path, const PerAxis<double>& start = {}) {
    std::vector<CurveSegment<S>> segments;
    PerAxis<Position> here{};
    for (const unsigned k : indices(max_axes)) {
        here[k] = position_from_mm(start[k]);
    }
    for (const TestShape& shape : path) {
        CurveSegment<S> segment;
        segment.axes = shape.axes;
        segment.degree = shape.degree;
        segment.origin = here;
        segment.feed_mm_s = from_double<S>(shape.feed_mm_s);
        segment.max_feed_mm_s = from_double<S>(shape.max_feed_mm_s);
        segment.stop_at_end = shape.stop_at_end;
        segment.waypoint = static_cast<std::uint32_t>(segments.size());
        PerAxis<PerDegree<S>> chords{};
        for (const unsigned k : indices(shape.axes)) {
            for (unsigned i = 0; i <= static_cast<unsigned>(shape.degree); ++i) {
                chords[k][i] = from_double<S>(shape.offset[k][i] * 4096.0);
            }
            here[k].raw += position_from_mm(shape.offset[k][static_cast<unsigned>(shape.degree)]).raw;
        }
        segment.end = here;
        segment.assign(chords);
        segments.push_back(segment);
    }
    return segments;
}

/// Hands out segments; answers `starved` up to `patience` times before each of them and before the end.
template <Scalar S>
class ListSource final : public CurveSource<S> {
public:
    explicit ListSource(std::vector<CurveSegment<S>> segments, std::uint64_t seed = 0, int patience = 0)
        : segments_(std::move(segments)), random_(seed), patience_(patience) {}
    ListSource(const BezierPath& path, std::uint64_t seed = 0, int patience = 0)
        : ListSource(segments_of<S>(path), seed, patience) {}

    Pull next(CurveSegment<S>& out) noexcept override {
        if (waits_ > 0) {
            --waits_;
            return Pull::starved;
        }
        waits_ = patience_ > 0 ? random_.integer(0, patience_) : 0;
        if (next_ == segments_.size()) {
            return Pull::finished;
        }
        out = segments_[next_++];
        return Pull::item;
    }

private:
    std::vector<CurveSegment<S>> segments_;
    Random random_;
    std::size_t next_ = 0;
    int patience_;
    int waits_ = 0;
};

/// Position and two derivatives of all axes, in mm.
struct Jet {
    PerAxis<Real> r{};
    PerAxis<Real> d1{};
    PerAxis<Real> d2{};
    [[nodiscard]] Real speed(int axes) const {
        Real sum = 0.0L;
        for (const unsigned k : indices(axes)) {
            sum += d1[k] * d1[k];
        }
        return std::sqrt(sum);
    }
};

inline Real exact_mm(Position p) {
    return std::ldexp(static_cast<Real>(p.raw), -40);
}

/// The segment as the pipeline received it (control points after rounding), by de Casteljau. Positions are relative to
/// the segment's origin.
template <Scalar S>
Jet evaluate(const CurveSegment<S>& segment, Real u) {
    Jet jet;
    const auto n = static_cast<unsigned>(segment.degree);
    const Real unit = std::ldexp(1.0L, segment.unit_log2);
    for (const unsigned k : indices(segment.axes)) {
        PerDegree<Real> b{};
        for (unsigned i = 0; i <= n; ++i) {
            b[i] = exact(segment.control[k][i]) * unit;
        }
        for (unsigned step = 1; step <= n; ++step) {
            if (step + 1 == n) {
                jet.d2[k] = (b[2] - 2.0L * b[1] + b[0]) * static_cast<Real>(n * (n - 1));
            }
            if (step == n) {
                jet.d1[k] = (b[1] - b[0]) * static_cast<Real>(n);
            }
            for (unsigned i = 0; i + step <= n; ++i) {
                b[i] += (b[i + 1] - b[i]) * u;
            }
        }
        jet.r[k] = b[0];
    }
    return jet;
}

/// Gauss-Legendre of order 40 on [0, 1], nodes by Newton's method.
struct Quadrature {
    static constexpr int points = 20;
    std::array<Real, points> node{};
    std::array<Real, points> weight{};

    Quadrature() {
        for (unsigned i = 0; i < points; ++i) {
            Real x = std::cos(3.14159265358979323846L * (static_cast<Real>(i) + 0.75L) / (points + 0.5L));
            Real slope = 1.0L;
            for (int iteration = 0; iteration < 12; ++iteration) {
                Real p = 1.0L;
                Real before = 0.0L;
                for (int n = 1; n <= points; ++n) {
                    const Real next = ((2.0L * n - 1.0L) * x * p - (n - 1.0L) * before) / n;
                    before = p;
                    p = next;
                }
                slope = points * (x * p - before) / (x * x - 1.0L);
                x -= p / slope;
            }
            node[i] = (1.0L + x) / 2.0L;
            weight[i] = 1.0L / ((1.0L - x * x) * slope * slope);
        }
    }
    template <class F>
    Real integrate(const F& f, Real from, Real to) const {
        Real sum = 0.0L;
        for (unsigned i = 0; i < points; ++i) {
            sum += weight[i] * f(from + (to - from) * node[i]);
        }
        return sum * (to - from);
    }
    /// Halves until both halves agree with the whole: for cusps, where no rule converges fast.
    template <class F>
    Real adaptive(const F& f, Real from, Real to, Real tolerance, int depth = 0) const {
        const Real middle = (from + to) / 2.0L;
        const Real whole = integrate(f, from, to);
        const Real halves = integrate(f, from, middle) + integrate(f, middle, to);
        if (depth >= 2 && (std::fabs(whole - halves) <= tolerance || depth == 45)) {
            return halves;
        }
        return adaptive(f, from, middle, tolerance, depth + 1) + adaptive(f, middle, to, tolerance, depth + 1);
    }
};

inline const Quadrature& quadrature() {
    static const Quadrature rule;
    return rule;
}

/// A segment that wanders: each Bezier point a random step from the last. `ratio` > 1: step lengths differ by up to it.
inline TestShape random_shape(Random& random, int axes, int degree, double size_mm, double ratio = 1.0) {
    TestShape shape;
    shape.axes = axes;
    shape.degree = degree;
    for (unsigned i = 1; i <= static_cast<unsigned>(degree); ++i) {
        const double step = size_mm / degree / random.decades(1.0, ratio > 1.0 ? ratio : 1.0 + 1e-9);
        for (const unsigned k : indices(axes)) {
            const double drift = k == 0 ? 1.0 : 0.0; // mostly forward
            shape.offset[k][i] = shape.offset[k][i - 1] + step * (drift + random.between(-0.7, 0.7));
        }
    }
    return shape;
}

/// A straight line of any degree along a direction, evenly parametrised.
inline TestShape line_shape(int axes, int degree, const PerAxis<double>& to) {
    TestShape shape;
    shape.axes = axes;
    shape.degree = degree;
    for (const unsigned k : indices(axes)) {
        for (unsigned i = 1; i <= static_cast<unsigned>(degree); ++i) {
            shape.offset[k][i] = to[k] * i / degree;
        }
    }
    return shape;
}

/// A plane cubic through given Bezier points (from the origin).
inline TestShape cubic_shape(double x1, double y1, double x2, double y2, double x3, double y3) {
    TestShape shape;
    shape.axes = 2;
    shape.offset[0] = {0.0, x1, x2, x3};
    shape.offset[1] = {0.0, y1, y2, y3};
    return shape;
}

/// Moves the first inner Bezier points so that the segment continues `before` smoothly (C1 up to a factor).
inline void join_smoothly(const TestShape& before, TestShape& after) {
    const auto m = static_cast<unsigned>(before.degree);
    Real in = 0.0L;
    Real out = 0.0L;
    for (const unsigned k : indices(after.axes)) {
        const Real step = real(before.offset[k][m] - before.offset[k][m - 1]);
        in += step * step;
        out += real(after.offset[k][1]) * real(after.offset[k][1]);
    }
    const auto factor = static_cast<double>(std::sqrt(out / in));
    for (const unsigned k : indices(after.axes)) {
        after.offset[k][1] = (before.offset[k][m] - before.offset[k][m - 1]) * factor;
    }
}

} // namespace splinefeed_test
