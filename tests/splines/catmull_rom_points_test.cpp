// SPDX-License-Identifier: MIT
//
// catmull_rom_points against the corrected article in long double, and its degenerate inputs.
#include "splinefeed/splines/catmull_rom_points.hpp"

#include "support/curve_harness.hpp"
#include "support/spline_points.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

template <Scalar S>
struct Made {
    Error error = Error::none;
    std::vector<Point<S>> tangents;
    std::vector<BezierPiece<S>> pieces;
};

template <Scalar S>
Made<S> make(const std::vector<Point<S>>& points, bool closed, S tension = from_double<S>(0.5), int axes = max_axes) {
    Made<S> made;
    made.tangents.resize(points.size());
    made.pieces.resize(points.size());
    made.error = catmull_rom_points<S>(points, axes, closed, tension, made.tangents, made.pieces).error();
    made.pieces.resize(made.error == Error::none ? pieces_through(points.size(), closed) : 0);
    return made;
}

template <Scalar S>
Point<S> at(double x, double y) {
    return {from_double<S>(x), from_double<S>(y)};
}

/// The article's cubic a t^3 + b t^2 + c t + d, (4) with b corrected, as Bezier points.
std::array<Vec, 4> article(const Vec& x0, const Vec& x1, const Vec& x2, const Vec& x3, Real m) {
    const Vec a = m * (x3 - x1) + m * (x2 - x0) - 2.0L * (x2 - x1);
    const Vec b = 3.0L * (x2 - x1) - 2.0L * m * (x2 - x0) - m * (x3 - x1); // printed: + m (x3 - x1)
    const Vec c = m * (x2 - x0);
    const Vec b1 = x1 + (1.0L / 3.0L) * c;
    const Vec b2 = 2.0L * b1 - x1 + (1.0L / 3.0L) * b;
    return {x1, b1, b2, x1 + c + b + a};
}

} // namespace

TEMPLATE_TEST_CASE("catmull-rom points: the article as corrected", "[splines][catmull_rom_points]", double, float,
                   Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 60);
    CAPTURE(path_seed);
    Real worst = 0.0L;
    for (int round = 0; round < 200; ++round) {
        const bool closed = round % 2 == 1;
        const int axes = 1 + random.below(6);
        const auto points = random_points<S>(random, axes, (closed ? 3 : 2) + random.below(20), false);
        const auto p = exact_points(points);
        const S tension = from_double<S>(round % 4 < 2 ? 0.5 : random.between(0.0, 10.0));
        const Real m = exact(tension);
        const auto made = make<S>(points, closed, tension, axes);
        REQUIRE(made.error == Error::none);
        // Differences and their products: 3 roundings of up to 2 m M; a third, a sum, the point: 3 more of (m + 1) M.
        // In Fixed the roundings are 2^-33 each, those before a product with m are multiplied by it.
        const Real unit = std::same_as<S, Fixed> ? 0x1p-33L : unit_roundoff<S>() * largest_coordinate(p);
        const Real allowed = 6.0L * (2.0L * m + 1.0L) * unit;
        const std::size_t n = p.size();
        for (std::size_t i = 0; i < made.pieces.size(); ++i) {
            // doubled end points
            const Vec& x0 = i > 0 ? p[i - 1] : closed ? p[n - 1] : p[0];
            const Vec& x3 = closed || i + 2 < n ? p[(i + 2) % n] : p[n - 1];
            const auto expected = article(x0, p[i], p[(i + 1) % n], x3, m);
            for (int j = 0; j <= 3; ++j) {
                const Vec error = exact_point(made.pieces[i].point(j)) - expected[static_cast<unsigned>(j)];
                worst = std::max(worst, largest_coordinate({error}) / allowed);
            }
            const Vec off = exact_point(made.tangents[i]) - m * (p[(i + 1) % n] - x0);
            worst = std::max(worst, largest_coordinate({off}) / allowed);
        }
    }
    REQUIRE(static_cast<double>(worst) <= 1.0);
    REQUIRE(static_cast<double>(worst) > 0.05); // it is no idle bound
}

TEMPLATE_TEST_CASE("catmull-rom points: degenerate inputs", "[splines][catmull_rom_points]", double, float, Fixed) {
    using S = TestType;
    const S half = literal<S>(0.5);
    const std::vector<Point<S>> good{at<S>(0, 0), at<S>(3, 0), at<S>(3, 6), at<S>(0, 12)};
    // Too few.
    REQUIRE(make<S>({}, false).error == Error::too_few_points);
    REQUIRE(make<S>({at<S>(1, 1)}, false).error == Error::too_few_points);
    REQUIRE(make<S>({at<S>(0, 0), at<S>(1, 0)}, true).error == Error::too_few_points);
    REQUIRE(make<S>({at<S>(0, 0), at<S>(1, 0), at<S>(1, 1)}, true).pieces.size() == 3);
    // Out of range, not a number, tension.
    if constexpr (!std::same_as<S, Fixed>) {
        for (const S bad : {std::numeric_limits<S>::quiet_NaN(), std::numeric_limits<S>::infinity()}) {
            auto points = good;
            points[2][1] = bad;
            REQUIRE(make<S>(points, false).error == Error::position_out_of_range);
            REQUIRE(make<S>(good, false, bad).error == Error::tension_out_of_range);
        }
    }
    auto far = good;
    far[3][0] = from_double<S>(std::same_as<S, Fixed> ? 0x1.1p25 : 0x1.1p40);
    REQUIRE(make<S>(far, false).error == Error::position_out_of_range);
    REQUIRE(make<S>(good, false, literal<S>(-0.5)).error == Error::tension_out_of_range);
    REQUIRE(make<S>(good, false, literal<S>(10.5)).error == Error::tension_out_of_range);
    // Storage.
    std::vector<Point<S>> tangents(4);
    std::vector<BezierPiece<S>> pieces(3);
    REQUIRE(catmull_rom_points<S>(good, 2, true, half, tangents, pieces).error() == Error::storage_too_small);
    REQUIRE(catmull_rom_points<S>(good, 2, false, half, tangents, pieces).ok());
    tangents.resize(3);
    REQUIRE(catmull_rom_points<S>(good, 2, false, half, tangents, pieces).error() == Error::storage_too_small);
    // Tension 0: the polygon, with a zero tangent at every point.
    const auto polygon = make<S>(good, true, S{});
    for (std::size_t i = 0; i < 4; ++i) {
        REQUIRE(polygon.tangents[i] == Point<S>{});
        REQUIRE(polygon.pieces[i].point(1) == good[i]);
        REQUIRE(polygon.pieces[i].point(2) == good[(i + 1) % 4]);
    }
    // Two points: a straight segment with end tangents m (P1 - P0).
    const auto two = make<S>({at<S>(1, 1), at<S>(4, 7)}, false);
    REQUIRE(two.pieces.size() == 1);
    REQUIRE(two.tangents[0] == at<S>(1.5, 3));
    REQUIRE(two.tangents[1] == at<S>(1.5, 3));
    REQUIRE(two.pieces[0].point(1) == at<S>(1.5, 2));
    REQUIRE(two.pieces[0].point(2) == at<S>(3.5, 6));
    // End tangents along P0P1 and P2P3 (printed: P3P4, a chord of length 0).
    const auto open = make<S>(good, false);
    REQUIRE(open.tangents[0] == at<S>(1.5, 0));
    REQUIRE(open.tangents[3] == at<S>(-1.5, 3));
    // Inner ones along P0P2 and P1P3.
    REQUIRE(open.tangents[1] == at<S>(1.5, 3));
    REQUIRE(open.tangents[2] == at<S>(-1.5, 6));
    // Duplicates: a loop, which starts and ends in the same point along the neighbours' chords.
    const auto twice = make<S>({at<S>(0, 0), at<S>(3, 0), at<S>(3, 0), at<S>(3, 3)}, false);
    REQUIRE(twice.error == Error::none);
    REQUIRE(twice.pieces[1].point(1) == at<S>(3.5, 0));
    REQUIRE(twice.pieces[1].point(2) == at<S>(3, -0.5));
    const auto thrice = make<S>({at<S>(3, 0), at<S>(3, 0), at<S>(3, 0)}, true); // a stop
    REQUIRE(thrice.pieces[0].point(1) == at<S>(3, 0));
    // A reversal between equal chords: no tangent; else the longer chord's direction wins, for the parameter is
    // uniform.
    const auto turn = make<S>({at<S>(0, 0), at<S>(3, 0), at<S>(0, 0)}, false);
    REQUIRE(turn.tangents[1] == Point<S>{});
    REQUIRE(turn.pieces[0].point(2) == turn.pieces[0].point(3));
    REQUIRE(turn.pieces[1].point(1) == turn.pieces[1].point(0));
    REQUIRE(make<S>({at<S>(0, 0), at<S>(2, 0), at<S>(1, 0)}, false).tangents[1][0] > S{});
    // Collinear points stay on their line.
    for (const auto& piece : make<S>({at<S>(0, 0), at<S>(1, 0), at<S>(5, 0), at<S>(6, 0)}, false).pieces) {
        REQUIRE(piece.control[1] == PerDegree<S>{});
    }
}

TEST_CASE("catmull-rom points: the largest Fixed input does not overflow", "[splines][catmull_rom_points]") {
    std::vector<Point<Fixed>> points(6);
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (unsigned k = 0; k < 6; ++k) {
            points[i][k] = from_double<Fixed>((i + k) % 3 == 0 ? -0x1p25 : 0x1p25);
        }
        points[i][0] = from_double<Fixed>(i % 4 < 2 ? -0x1p25 : 0x1p25);
    }
    REQUIRE(make<Fixed>(points, true, Fixed(10)).error == Error::none); // an overflow stops a debug build
    REQUIRE(make<Fixed>(points, false, Fixed(10)).error == Error::none);
}
