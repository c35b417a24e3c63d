// SPDX-License-Identifier: MIT
//
// modified_catmull_rom against Lagrange's parabola in long double, and its degenerate inputs.
#include "splinefeed/splines/catmull_rom_modified.hpp"

#include "support/curve_harness.hpp"
#include "support/spline_points.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

template <Scalar S>
struct Made {
    Error error = Error::none;
    std::vector<S> chords;
    std::vector<Point<S>> derivatives;
    std::vector<BezierPiece<S>> pieces;
};

template <Scalar S>
Made<S> make(const std::vector<Point<S>>& points, bool closed, ModifiedTangents<S> tangents = {}) {
    Made<S> made;
    made.chords.resize(points.size());
    made.derivatives.resize(points.size());
    made.pieces.resize(points.size());
    const auto count = modified_catmull_rom<S>(points, closed, tangents, {made.chords, made.derivatives, made.pieces});
    made.error = count.error();
    made.pieces.resize(count.has_value() ? *count : 0);
    made.chords.resize(made.pieces.size());
    return made;
}

/// Derivative at `at` of the parabola through (s_j, p_j), by Lagrange's basis.
Vec parabola_slope(const std::array<Real, 3>& s, const std::array<Vec, 3>& p, Real at) {
    Vec out{};
    for (unsigned j = 0; j < 3; ++j) {
        const unsigned a = (j + 1) % 3;
        const unsigned b = (j + 2) % 3;
        out = out + ((at - s[a]) + (at - s[b])) / ((s[j] - s[a]) * (s[j] - s[b])) * p[j];
    }
    return out;
}

/// R'(s_i), the points and sums of chords chosen as the corrected article says.
Vec expected_slope(const std::vector<Vec>& p, bool closed, std::size_t i) {
    const std::size_t n = p.size();
    if (n == 2) {
        return (1.0L / distance_of(p[0], p[1])) * (p[1] - p[0]);
    }
    std::size_t middle = i;
    if (!closed) {
        middle = std::clamp<std::size_t>(i, 1, n - 2);
    }
    const std::array<Vec, 3> three{p[(middle + n - 1) % n], p[middle], p[(middle + 1) % n]};
    const Real h1 = distance_of(three[0], three[1]);
    const Real h2 = distance_of(three[1], three[2]);
    return parabola_slope({0.0L, h1, h1 + h2}, three, i < middle ? 0.0L : i > middle ? h1 + h2 : h1);
}

/// A slope is a dozen roundings of numbers up to 3, a Bezier point that times the reach plus one of the coordinate.
template <Scalar S>
Real slope_bound() {
    return 24.0L * unit_roundoff<S>();
}

} // namespace

TEMPLATE_TEST_CASE("modified catmull-rom: parabolas through three points", "[splines][catmull_rom_modified]", double,
                   float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 40);
    CAPTURE(path_seed);
    for (int round = 0; round < 300; ++round) {
        const bool closed = round % 2 == 1;
        const int axes = 1 + random.below(6);
        const auto points = random_points<S>(random, axes, (closed ? 3 : 2) + random.below(12), round % 3 == 0);
        ModifiedTangents<S> tangents;
        tangents.mode = round % 4 < 2 ? ChordFactor::chord : ChordFactor::constant;
        tangents.factor = from_double<S>(random.between(0.0, 2.0));
        const auto made = make<S>(points, closed, tangents);
        REQUIRE(made.error == Error::none);
        const auto p = exact_points<S>(points);
        const std::size_t n = p.size();
        REQUIRE(made.pieces.size() == (closed ? n : n - 1));
        for (std::size_t i = 0; i < made.pieces.size(); ++i) {
            const std::size_t next = (i + 1) % n;
            const Real h = distance_of(p[i], p[next]);
            const Real reach = exact(tangents.factor) * (tangents.mode == ChordFactor::chord ? h : 1.0L) / 3.0L;
            const Vec start = expected_slope(p, closed, i);
            const Vec end = expected_slope(p, closed, next);
            CAPTURE(round, closed, n, i);
            REQUIRE(distance_of(exact_point(made.derivatives[i]), start) <= slope_bound<S>());
            REQUIRE(std::fabs(exact(made.chords[i]) - h) <= 4.0L * unit_roundoff<S>() * std::max(h, 1.0L));
            REQUIRE(made.pieces[i].degree == 3);
            REQUIRE(made.pieces[i].point(0) == points[i]);
            REQUIRE(made.pieces[i].point(3) == points[next]);
            const Real largest = std::max(largest_coordinate(p), 1.0L);
            const auto allowed = static_cast<double>(reach * slope_bound<S>() + 8.0L * unit_roundoff<S>() * largest);
            REQUIRE(static_cast<double>(distance_of(exact_point(made.pieces[i].point(1)), p[i] + reach * start)) <=
                    allowed);
            REQUIRE(static_cast<double>(distance_of(exact_point(made.pieces[i].point(2)), p[next] - reach * end)) <=
                    allowed);
        }
    }
}

TEMPLATE_TEST_CASE("modified catmull-rom: degenerate inputs", "[splines][catmull_rom_modified]", double, float, Fixed) {
    using S = TestType;
    const auto at = [](double x, double y) {
        return Point<S>{from_double<S>(x), from_double<S>(y)};
    };
    const std::vector<Point<S>> good{at(0, 0), at(1, 0), at(1, 1), at(0, 2)};
    // Too few; a closed curve drops the repeat and needs three.
    REQUIRE(make<S>({}, false).error == Error::too_few_points);
    REQUIRE(make<S>({at(1, 1)}, false).error == Error::too_few_points);
    REQUIRE(make<S>({at(0, 0), at(1, 0), at(0, 0)}, true).error == Error::too_few_points);
    auto repeated = good;
    repeated.push_back(good.front());
    REQUIRE(make<S>(repeated, true).pieces.size() == 4);
    REQUIRE(make<S>(repeated, true).derivatives[0] == make<S>(good, true).derivatives[0]);
    // Duplicates.
    REQUIRE(make<S>({at(0, 0), at(1, 0), at(1, 0), at(2, 1)}, false).error == Error::coincident_points);
    REQUIRE(make<S>({at(2, 2), at(2, 2), at(2, 2)}, true).error == Error::too_few_points);
    // Out of range, not a number.
    if constexpr (!std::same_as<S, Fixed>) {
        for (const S bad : {std::numeric_limits<S>::quiet_NaN(), std::numeric_limits<S>::infinity()}) {
            auto points = good;
            points[2][1] = bad;
            REQUIRE(make<S>(points, false).error == Error::position_out_of_range);
            REQUIRE(make<S>(good, false, {ChordFactor::chord, bad}).error == Error::factor_out_of_range);
        }
    }
    auto far = good;
    far[3][0] = from_double<S>(std::same_as<S, Fixed> ? 0x1.1p18 : 0x1.1p40);
    REQUIRE(make<S>(far, false).error == Error::position_out_of_range);
    REQUIRE(make<S>(good, false, {ChordFactor::chord, from_double<S>(-0.5)}).error == Error::factor_out_of_range);
    REQUIRE(make<S>(good, false, {ChordFactor::chord, from_double<S>(2.5)}).error == Error::factor_out_of_range);
    // Storage.
    std::vector<S> chords(4);
    std::vector<Point<S>> derivatives(4);
    std::vector<BezierPiece<S>> pieces(3);
    REQUIRE(modified_catmull_rom<S>(good, true, {}, {chords, derivatives, pieces}).error() == Error::storage_too_small);
    REQUIRE(modified_catmull_rom<S>(good, false, {}, {chords, derivatives, pieces}).has_value());
    // Factor 0: a polygon.
    const auto polygon = make<S>(good, false, {ChordFactor::chord, S{}});
    REQUIRE(polygon.pieces[1].point(1) == polygon.pieces[1].point(0));
    // A reversal: equal chords give a zero tangent, else the shorter one's direction wins.
    REQUIRE(make<S>({at(0, 0), at(2, 0), at(0, 0)}, false).derivatives[1] == Point<S>{});
    REQUIRE(make<S>({at(0, 0), at(2, 0), at(1, 0)}, false).derivatives[1][0] < S{});
    REQUIRE(make<S>({at(1, 0), at(2, 0), at(0, 0)}, false).derivatives[1][0] > S{});
    // Collinear points stay on their line.
    const auto line = make<S>({at(0, 0), at(1, 0), at(5, 0), at(6, 0)}, false);
    for (const auto& piece : line.pieces) {
        REQUIRE(piece.control[1] == PerDegree<S>{});
    }
}

TEST_CASE("modified catmull-rom: the largest Fixed input does not overflow", "[splines][catmull_rom_modified]") {
    std::vector<Point<Fixed>> points(6);
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (unsigned k = 0; k < 6; ++k) {
            points[i][k] = from_double<Fixed>((i + k) % 3 == 0 ? -0x1p18 : 0x1p18);
        }
        points[i][0] = from_double<Fixed>(i % 2 == 0 ? -0x1p18 : 0x1p18);
    }
    for (const auto& tangents :
         {ModifiedTangents<Fixed>{ChordFactor::chord, Fixed(2)}, {ChordFactor::constant, from_double<Fixed>(0x1p20)}}) {
        REQUIRE(make<Fixed>(points, true, tangents).error == Error::none); // an overflow stops a debug build
        REQUIRE(make<Fixed>(points, false, tangents).error == Error::none);
    }
}
