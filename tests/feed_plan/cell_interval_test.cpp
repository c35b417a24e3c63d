// SPDX-License-Identifier: MIT
//
// What is left of a polynomial on a part of a cell is the same polynomial.
#include "splinefeed/s2_arc_length/cell_interval.hpp"

#include "support/bezier_paths.hpp"
#include "support/catch.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 81;

template <class T, std::size_t N>
Real value_of(const std::array<T, N>& points, Real x) {
    Real sum = 0.0L;
    Real binomial = 1.0L;
    for (std::size_t i = 0; i < N; ++i) {
        sum += binomial * exact(points[i]) * std::pow(x, static_cast<Real>(i)) *
               std::pow(1.0L - x, static_cast<Real>(N - 1 - i));
        binomial = binomial * static_cast<Real>(N - 1 - i) / static_cast<Real>(i + 1);
    }
    return sum;
}

/// As a shape has them: between -1 and 1.
template <Scalar S, std::size_t N>
std::array<Ratio<S>, N> random_points(Random& random) {
    std::array<Ratio<S>, N> points;
    for (Ratio<S>& point : points) {
        point = from_double<Ratio<S>>(random.between(-0.99, 0.99));
    }
    return points;
}

template <Scalar S, std::size_t N>
void require_same_polynomial(Random& random) {
    const std::array<Ratio<S>, N> points = random_points<S, N>(random);
    CellInterval<S> stretch{from_double<S>(random.between(0.0, 1.0)), from_double<S>(random.between(0.0, 1.0))};
    if (stretch.to < stretch.from) {
        std::swap(stretch.from, stretch.to);
    }
    const std::array<Ratio<S>, N> part = points_on<S>(stretch, points);
    const Real close = 64.0L * ratio_rounding<S>();
    Ratio<S> low = points[0];
    Ratio<S> high = points[0];
    for (const Ratio<S> point : points) {
        low = smaller(low, point);
        high = larger(high, point);
    }
    for (const Ratio<S> point : part) { // convex combinations
        REQUIRE(exact(point) >= exact(low) - close);
        REQUIRE(exact(point) <= exact(high) + close);
    }
    for (int i = 0; i <= 8; ++i) {
        const Real y = static_cast<Real>(i) / 8.0L;
        const Real x = exact(stretch.from) + (exact(stretch.to) - exact(stretch.from)) * y;
        REQUIRE(std::fabs(value_of(part, y) - value_of(points, x)) <= close);
    }
}

} // namespace

TEMPLATE_TEST_CASE("on a stretch a polynomial is what it was on the cell", "[feed_plan][stretch]", double, float,
                   Fixed) {
    Random random(seed);
    CAPTURE(seed);
    for (int run = 0; run < 500; ++run) {
        require_same_polynomial<TestType, 3>(random);
        require_same_polynomial<TestType, 4>(random);
    }
}

TEMPLATE_TEST_CASE("the whole cell is a stretch that changes nothing", "[feed_plan][stretch]", double, float, Fixed) {
    using S = TestType;
    Random random(seed + 1);
    const CellInterval<S> whole;
    CHECK(whole.whole());
    CHECK(whole.length() == from_integer<S>(1));
    const CellInterval<S> rest{literal<S>(0.25)};
    CHECK_FALSE(rest.whole());
    CHECK(rest.length() == literal<S>(0.75));
    CHECK_FALSE(CellInterval<S>{S{}, literal<S>(0.5)}.whole());
    for (int run = 0; run < 50; ++run) {
        const std::array<Ratio<S>, 4> points = random_points<S, 4>(random);
        const std::array<Ratio<S>, 4> part = points_on<S>(whole, points);
        // The first point is met exactly; the last by a difference and a sum
        REQUIRE(part[0] == points[0]);
        for (unsigned i = 0; i < 4; ++i) {
            REQUIRE(std::fabs(exact(part[i]) - exact(points[i])) <= 8.0L * ratio_rounding<S>());
        }
    }
}
