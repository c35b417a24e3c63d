// SPDX-License-Identifier: MIT
#include "splinefeed/splines/curve_hull.hpp"

#include "splinefeed/splines/boehm.hpp"
#include "support/catch.hpp"
#include "support/curve_harness.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

template <Scalar S>
S value(const PerDegree<S>& points, int degree, S u) {
    PerDegree<S> row = points;
    for (unsigned step = static_cast<unsigned>(degree); step > 0; --step) {
        for (unsigned i = 0; i < step; ++i) {
            row[i] = row[i] + u * (row[i + 1] - row[i]);
        }
    }
    return row[0];
}

} // namespace

TEMPLATE_TEST_CASE("curve_hull: the curve lies in the Bezier hull, and that in the hull of its vertices",
                   "[splines][curve_hull]", double, float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 40);
    CAPTURE(path_seed);
    // A Bezier point is rounded three times, of numbers up to 400; the sides of the hull are not.
    const S slack =
        std::same_as<S, Fixed> ? from_double<S>(0x1p-30) : from_double<S>(std::same_as<S, float> ? 2e-4 : 2e-13);
    int narrower_curves = 0;
    for (int round = 0; round < 300; ++round) {
        const int degree = 2 + round % 2;
        const bool closed = round % 4 >= 2;
        std::vector<Point<S>> vertices(static_cast<std::size_t>(4 + random.below(8)));
        for (auto& vertex : vertices) {
            for (S& x : vertex) {
                x = from_double<S>(random.between(-100.0, 100.0));
            }
        }
        std::vector<BezierPiece<S>> pieces(vertices.size());
        REQUIRE(boehm<S>(vertices, degree, closed, pieces).ok());
        const std::int64_t count = boehm_pieces(static_cast<std::int64_t>(vertices.size()), degree, closed);
        bool narrower = false;
        for (std::int64_t i = 0; i < count; ++i) {
            std::vector<Point<S>> around;
            for (int j = 0; j <= degree; ++j) {
                const std::int64_t at = closed ? i - 1 + j + static_cast<std::int64_t>(vertices.size()) : i + j;
                around.push_back(vertices[static_cast<std::size_t>(at) % vertices.size()]);
            }
            const BezierPiece<S>& piece = pieces[static_cast<std::size_t>(i)];
            const auto outer = vertex_hull<S>(around);
            const auto inner = bezier_hull(piece);
            for (unsigned k = 0; k < 6; ++k) {
                const Extent<S> wide{outer[k].low - slack, outer[k].high + slack};
                REQUIRE(wide.contains(inner[k]));
                narrower = narrower || inner[k].high < outer[k].high - slack;
                const Extent<S> hull{inner[k].low - slack, inner[k].high + slack};
                for (int step = 0; step <= 16; ++step) {
                    const S x = value(piece.control[k], degree, from_double<S>(step / 16.0));
                    REQUIRE(hull.contains({x, x}));
                }
            }
        }
        narrower_curves += narrower ? 1 : 0;
    }
    CHECK(narrower_curves > 200); // four vertices have one piece, with the same points
}

TEMPLATE_TEST_CASE("curve_hull: what lies beyond is found by halving, not by sampling", "[splines][curve_hull]", double,
                   float, Fixed) {
    using S = TestType;
    const auto number = [](double x) {
        return from_double<S>(x);
    };
    // 4u(1-u) 50: the top is 50, its Bezier point 100. A spike that equidistant samples of 1/64 would miss.
    PerDegree<S> parabola{};
    parabola[1] = number(100.0);
    CHECK(bezier_extent(parabola, 2).high == number(100.0));
    const S slack = number(std::same_as<S, float> ? 1e-4 : 1e-8);
    const Extent<S> below = extent_beyond(parabola, 2, {number(-1.0), number(49.999)}, slack);
    CHECK(to_double(below.high) == Approx(50.0).margin(1e-4));
    CHECK(to_double(below.high) <= 50.0);
    CHECK(to_double(below.low) == 0.0);
    // Where all is allowed, one look suffices: the ends are what is known.
    CHECK(to_double(extent_beyond(parabola, 2, {number(-1.0), number(100.0)}, slack).high) == 0.0);
    // The exact extent of random cubics, from the roots of their derivative.
    RandomPath random(path_seed + 41);
    CAPTURE(path_seed);
    for (int round = 0; round < 300; ++round) {
        PerDegree<S> points{};
        for (unsigned i = 0; i < 4; ++i) {
            points[i] = number(random.between(-100.0, 100.0));
        }
        double low = std::min(to_double(points[0]), to_double(points[3]));
        double high = std::max(to_double(points[0]), to_double(points[3]));
        const double a =
            to_double(points[3]) - 3.0 * to_double(points[2]) + 3.0 * to_double(points[1]) - to_double(points[0]);
        const double b = 2.0 * (to_double(points[2]) - 2.0 * to_double(points[1]) + to_double(points[0]));
        const double c = to_double(points[1]) - to_double(points[0]);
        const double root = std::sqrt(std::max(0.0, b * b - 4.0 * a * c));
        for (const double u : {(-b + root) / (2.0 * a), (-b - root) / (2.0 * a)}) {
            if (b * b >= 4.0 * a * c && u > 0.0 && u < 1.0) {
                const double x = value(PerDegree<double>{to_double(points[0]), to_double(points[1]),
                                                         to_double(points[2]), to_double(points[3])},
                                       3, u);
                low = std::min(low, x);
                high = std::max(high, x);
            }
        }
        const Extent<S> found = extent_beyond(points, 3, {S{}, S{}}, slack);
        const double margin = std::same_as<S, float> ? 2e-4 : 2e-8;
        CHECK(std::min(to_double(found.low), 0.0) == Approx(std::min(low, 0.0)).margin(margin));
        CHECK(std::max(to_double(found.high), 0.0) == Approx(std::max(high, 0.0)).margin(margin));
    }
}
