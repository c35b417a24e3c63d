// SPDX-License-Identifier: MIT
//
// What ferguson takes where the caller asks for nothing: tension, sign of the curvature, end tangents.
#include "ferguson_harness.hpp"
#include "support/curve_harness.hpp"
#include "support/spline_points.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

TEMPLATE_TEST_CASE("ferguson: automatic mu is the nearest that lets the row dominate", "[splines][ferguson]", double,
                   float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 64);
    for (int round = 0; round < 2000; ++round) {
        const double lambda = random.between(0.3, 3.0);
        const double before = random.between(0.3, 3.0);
        const int delta = random.below(2) == 0 ? 1 : -1;
        const double wish = random.between(-60.0, 60.0);
        const double bound = 17.0 / 16.0 * (lambda * lambda * before + 1.0);
        const auto diagonal = [&](double mu) {
            return 2.0 * (mu / 4.0 + delta * lambda * lambda + lambda);
        };
        const double mu =
            to_double(stable_mu(from_double<S>(wish), delta, from_double<S>(lambda), from_double<S>(before)));
        const double nearest =
            std::fabs(diagonal(wish)) >= bound
                ? wish
                : 2.0 * ((diagonal(wish) < 0.0 ? -bound : bound) - 2.0 * (delta * lambda * lambda + lambda));
        const double tolerance = std::same_as<S, float> ? 1e-4 : 1e-7;
        if (std::fabs(diagonal(wish)) > 1e-3 && std::fabs(std::fabs(diagonal(wish)) - bound) > 1e-3) {
            REQUIRE(mu == Approx(nearest).margin(tolerance));
        }
    }
    // The usual spline needs no tension.
    REQUIRE(stable_mu(S{}, 1, literal<S>(1), literal<S>(1)) == S{});
}

// A bound that only keeps pivots from zero lets errors grow from knot to knot: 20 points had condition 4e4.
TEMPLATE_TEST_CASE("ferguson: with automatic mu errors do not grow along the curve", "[splines][ferguson]", double,
                   float, Fixed) {
    using S = TestType;
    RandomPath random(path_seed + 65);
    for (const double lambda : {0.0625, 0.25, 0.5, 1.0, 2.0, 4.0, 16.0}) {
        for (int round = 0; round < 6; ++round) {
            const bool closed = round % 2 == 1;
            const auto points = random_points<S>(random, 2, 60);
            std::vector<FergusonJoint<S>> joints(closed ? 60 : 58);
            for (std::size_t i = 0; i < joints.size(); ++i) {
                joints[i].delta = round < 2 || (round > 3 && random.below(2) == 0) ? 1 : -1;
                joints[i].lambda = from_double<S>(lambda);
                const S before = i > 0 || closed ? joints[i].lambda : literal<S>(1);
                joints[i].mu = stable_mu(S{}, joints[i].delta, from_double<S>(lambda), before);
            }
            const auto made = make<S>(points, joints, closed, points.front(), points.back());
            CAPTURE(lambda, round);
            REQUIRE(made.error == Error::none);
            REQUIRE(made.report.diagonally_dominant);
            REQUIRE(to_double(made.report.condition) < 33.5);
        }
    }
}

TEST_CASE("ferguson: automatic sign at inflections of the polygon only", "[splines][ferguson]") {
    const std::vector<Point<double>> s{{-4, -1}, {-2, 1}, {0, 0}, {2, -1}, {4, 1}};
    REQUIRE(automatic_sign<double>(s, 2, false) == -1);
    for (const std::size_t knot : {0U, 1U, 3U, 4U}) {
        REQUIRE(automatic_sign<double>(s, knot, false) == 1);
    }
    const std::vector<Point<double>> line{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}};
    const std::vector<Point<double>> arc{{0, 0}, {1, 2}, {3, 3}, {5, 2}, {6, 0}};
    for (std::size_t knot = 0; knot < 5; ++knot) {
        REQUIRE(automatic_sign<double>(line, knot, false) == 1);
        REQUIRE(automatic_sign<double>(arc, knot, false) == 1);
        REQUIRE(automatic_sign<double>(arc, knot, true) == 1);
    }
}

TEST_CASE("ferguson: estimated end tangents are those of a parabola", "[splines][ferguson]") {
    const auto at = [](double t) {
        return Point<double>{1.0 + 3.0 * t - t * t, 2.0 * t * t};
    };
    // Knots at 0, 1, 3 and 3.5: spans 1, 2, 1/2, ratios 2 and 1/4; derivatives by the segments' own parameters.
    const std::vector<Point<double>> points{at(0.0), at(1.0), at(3.0), at(3.5)};
    const std::vector<FergusonJoint<double>> joints{{2.0, 0.0, 1}, {0.25, 0.0, 1}};
    Point<double> start{};
    Point<double> end{};
    estimate_end_tangents<double>(points, joints, start, end);
    REQUIRE(start[0] == Approx(3.0));
    REQUIRE(start[1] == Approx(0.0).margin(1e-14));
    REQUIRE(end[0] == Approx(0.5 * (3.0 - 7.0)));
    REQUIRE(end[1] == Approx(0.5 * 14.0));
    // mu = 0: the curve is the parabola.
    const auto made = make<double>(points, joints, false, start, end);
    REQUIRE(made.in[1][0] == Approx(1.0));
    REQUIRE(made.in[1][1] == Approx(4.0));
    estimate_end_tangents<double>(std::vector<Point<double>>{{1, 1}, {3, 4}}, {}, start, end);
    REQUIRE(start == Point<double>{2, 3});
    REQUIRE(end == start);
}
