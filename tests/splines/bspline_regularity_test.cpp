// SPDX-License-Identifier: MIT
// Where interpolation by B-splines is possible, and what is said where it is not.
#include "splines/bspline_harness.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Job on_a_line(const std::vector<double>& chords, int degree, KnotRule rule) {
    Job job;
    double x = 0.0;
    job.points.push_back({x});
    for (const double chord : chords) {
        job.points.push_back({x += chord});
    }
    job.kind = {degree, false, false};
    job.rule = rule;
    job.domain = static_cast<double>(chords.size());
    return job;
}

Job ring(std::size_t count, int degree, KnotRule rule, Parameterization how, unsigned seed) {
    std::mt19937_64 random(seed);
    Job job;
    job.points = random_points(random, count, 2);
    job.kind = {degree, true, false};
    job.rule = rule;
    job.how = how;
    job.domain = static_cast<double>(count);
    return job;
}

template <Scalar S>
Error error_of(const Job& job) {
    return interpolated<S>(job).error;
}

} // namespace

TEST_CASE("Schoenberg-Whitney is the exact condition", "[splines]") {
    std::mt19937_64 random(20261122);
    int refused = 0;
    int taken = 0;
    for (int round = 0; round < 600; ++round) {
        const int degree = 1 + static_cast<int>(random() % 5U);
        const auto k = static_cast<std::size_t>(degree);
        const std::size_t count = k + 2U + random() % 5U;
        Job job;
        job.kind = {degree, false, false};
        // Multiples of 1/64, all different: knots on even ones, inner parameters on odd ones.
        std::vector<double> inner;
        for (int i = 1; i < 32; ++i) {
            inner.push_back(2.0 * i / 64.0);
        }
        std::shuffle(inner.begin(), inner.end(), random);
        inner.resize(count - k - 1U);
        std::sort(inner.begin(), inner.end());
        job.knots.assign(k + 1U, 0.0);
        job.knots.insert(job.knots.end(), inner.begin(), inner.end());
        job.knots.insert(job.knots.end(), k + 1U, 1.0);
        std::vector<double> odd;
        for (int i = 0; i < 32; ++i) {
            odd.push_back((2.0 * i + 1.0) / 64.0);
        }
        std::shuffle(odd.begin(), odd.end(), random);
        odd.resize(count - 2U);
        std::sort(odd.begin(), odd.end());
        job.parameters = {0.0};
        job.parameters.insert(job.parameters.end(), odd.begin(), odd.end());
        job.parameters.push_back(1.0);
        job.points = random_points(random, count, 1);
        const auto [a, b] = dense_system(job, to_reals(job.parameters), to_reals(job.knots));
        Matrix right = b;
        const Real pivot = dense_solve(a, right);
        const Error error = error_of<double>(job);
        CAPTURE(round, degree, count, static_cast<double>(pivot));
        if (error == Error::schoenberg_whitney) {
            REQUIRE(static_cast<double>(pivot) < 1e-17);
            ++refused;
        } else {
            REQUIRE(error == Error::none);
            REQUIRE(static_cast<double>(pivot) > 1e-13);
            ++taken;
        }
        if (error != Error::none || condition_of(a) < 0x1p24L) { // else control points beyond what Fixed holds
            REQUIRE(error_of<Fixed>(job) == error);
        }
    }
    REQUIRE(refused > 50);
    REQUIRE(taken > 50);
}

TEMPLATE_TEST_CASE("chords of one length but the first, uniform knots: singular from R = 3, 4, 6, 12", "[splines]",
                   double, float, Fixed) {
    const double limits[] = {3.0, 4.0, 6.0, 12.0};
    for (int degree = 2; degree <= 5; ++degree) {
        const double limit = limits[degree - 2];
        // Nearer below the limit float and Fixed see pivots that could be nothing but rounding.
        const double below = std::same_as<TestType, double> ? limit - 0.125 : 0.75 * limit;
        for (const double r : {below, limit, limit + 0.125}) {
            CAPTURE(degree, r);
            const Job job = on_a_line({r, 1, 1, 1, 1, 1, 1}, degree, KnotRule::uniform);
            const Error error = error_of<TestType>(job);
            if (r == limit) { // parameters are rounded
                REQUIRE((error == Error::schoenberg_whitney || error == Error::system_singular));
            } else {
                REQUIRE(error == (r < limit ? Error::none : Error::schoenberg_whitney));
            }
            Job averaged = job;
            averaged.rule = KnotRule::average;
            REQUIRE(error_of<TestType>(averaged) == Error::none);
        }
    }
}

TEMPLATE_TEST_CASE("knots from the nearest instead of consecutive parameters are refused", "[splines]", double, float,
                   Fixed) {
    Job job = on_a_line({12, 1, 1, 1, 1, 1, 1, 1, 1}, 3, KnotRule::average);
    job.domain = 9.0;
    const Curve<TestType> right = interpolated<TestType>(job);
    REQUIRE(right.error == Error::none);
    REQUIRE(to_double(right.knots[4]) == Approx((5.4 + 5.85 + 6.3) / 3.0));
    // The mean of the three nearest to each of t_1 ...: 2.885 here stands for those of the printed rule.
    job.knots = {0, 0, 0, 0, 2.885, 2.885, 4.506, 4.506, 5.4, 6.3, 9, 9, 9, 9};
    REQUIRE(error_of<TestType>(job) == Error::schoenberg_whitney);
}

TEST_CASE("the slack is the smallest distance to a support's end", "[splines]") {
    Job job = on_a_line({1, 1, 1, 1, 1, 1}, 3, KnotRule::uniform);
    job.domain = 4.0;
    REQUIRE(interpolated<double>(job).slack == Approx(2.0 / 3.0));
}

TEMPLATE_TEST_CASE("closed, even degree, even count, knots at the points: refused", "[splines]", double, float, Fixed) {
    using S = TestType;
    for (const Parameterization how : {Parameterization::uniform, Parameterization::chordal}) {
        for (int degree = 1; degree <= 9; ++degree) {
            for (const std::size_t count : {3U, 4U, 5U, 6U, 7U, 8U, 30U, 31U}) {
                CAPTURE(degree, count, static_cast<int>(how));
                const bool even = degree % 2 == 0 && count % 2U == 0;
                const unsigned seed = static_cast<unsigned>(degree) * 100U + static_cast<unsigned>(count);
                const Error error = error_of<S>(ring(count, degree, KnotRule::params, how, seed));
                if (even) {
                    REQUIRE(error == Error::even_degree_closed);
                } else if (!std::same_as<S, float> || degree <= 5) {
                    REQUIRE(error == Error::none);
                }
                if (how == Parameterization::uniform && even) {
                    REQUIRE(error_of<S>(ring(count, degree, KnotRule::uniform, how, seed)) ==
                            Error::even_degree_closed);
                }
                if (degree % 2 == 0 && (!std::same_as<S, float> || degree <= 4)) {
                    REQUIRE(error_of<S>(ring(count, degree, KnotRule::midpoints, how, seed)) == Error::none);
                }
                // The same for odd degrees between evenly spaced points; there only the pivots know.
                if (degree % 2 == 1 && count % 2U == 0 && how == Parameterization::uniform) {
                    const Error odd = error_of<S>(ring(count, degree, KnotRule::midpoints, how, seed));
                    REQUIRE((odd == Error::system_singular || (degree == 1 && odd == Error::schoenberg_whitney)));
                }
            }
        }
    }
}

// The triple knot at the first point suits no numbering of the control points; the other points are between knots.
TEMPLATE_TEST_CASE("closed, even degree, unsuited knots: not taken for knots at the points", "[splines]", double, float,
                   Fixed) {
    Job job = ring(4, 2, KnotRule::params, Parameterization::uniform, 1);
    job.parameters = {0, 1, 2, 3};
    job.knots = {-4, -3.5, 0, 0, 0, 0.5, 4, 4, 4};
    REQUIRE(error_of<TestType>(job) == Error::schoenberg_whitney);
}

TEMPLATE_TEST_CASE("interpolation: what is refused", "[splines]", double, float, Fixed) {
    using S = TestType;
    const auto line = [](int degree, std::size_t count) {
        return on_a_line(std::vector<double>(count - 1U, 1.0), degree, KnotRule::average);
    };
    REQUIRE(error_of<S>(line(0, 4)) == Error::degree_out_of_range);
    REQUIRE(error_of<S>(line(10, 20)) == Error::degree_out_of_range);
    REQUIRE(error_of<S>(line(4, 4)) == Error::too_few_points);
    REQUIRE(error_of<S>(line(3, 4)) == Error::none);
    REQUIRE(error_of<S>(line(1, 2)) == Error::none);
    Job job = line(3, 6);
    job.points[3] = job.points[2];
    REQUIRE(error_of<S>(job) == Error::coincident_points);
    job.how = Parameterization::uniform;
    REQUIRE(error_of<S>(job) == Error::none);
    job.points.assign(6, {4.0});
    REQUIRE(error_of<S>(job) == Error::none);
    job.how = Parameterization::chordal;
    REQUIRE(error_of<S>(job) == Error::coincident_points);

    job = line(3, 6); // given parameters and knots
    job.parameters = {0, 1, 2, 3, 4, 5};
    job.knots = {0, 0, 0, 0, 2, 3, 5, 5, 5, 5};
    REQUIRE(error_of<S>(job) == Error::none);
    job.knots = {0, 0, 0, 0, 3, 2, 5, 5, 5, 5};
    REQUIRE(error_of<S>(job) == Error::knots_invalid);
    job.knots = {0, 0, 0, 0, 0, 2, 5, 5, 5, 5};
    REQUIRE(error_of<S>(job) == Error::knots_invalid);
    job.knots = {0, 0, 0, 0, 2, 5, 5, 5, 5};
    REQUIRE(error_of<S>(job) == Error::knots_invalid);
    job.knots = {0, 0, 0, 0, 2, 3, 4, 4, 4, 4}; // t = 5 is outside
    REQUIRE(error_of<S>(job) == Error::parameters_invalid);
    job.knots = {0, 0, 0, 0, 2, 3, 5, 5, 5, 5};
    job.parameters = {0, 1, 1, 3, 4, 5};
    REQUIRE(error_of<S>(job) == Error::parameters_invalid);
    job.parameters = {0, 2, 1, 3, 4, 5};
    REQUIRE(error_of<S>(job) == Error::parameters_invalid);
    job.parameters = {0, 1, 2, 3, 4, 5};
    job.knots = {0, 0, 0, 0, 0.5, 0.75, 5, 5, 5, 5};
    REQUIRE(error_of<S>(job) == Error::schoenberg_whitney);
    job.kind.end_derivatives = true;
    job.start = job.end = {1.0};
    job.knots = {-1, 0, 0, 0, 1, 2, 3, 4, 5, 5, 5, 5}; // no derivative where the end is not clamped
    REQUIRE_FALSE(interpolated<S>(job).ok());
    job.kind.degree = 1;
    REQUIRE_FALSE(interpolated<S>(job).ok());
    if constexpr (!std::same_as<S, Fixed>) {
        job = line(3, 6);
        job.how = Parameterization::uniform;
        job.points[2] = {not_a_number};
        REQUIRE(error_of<S>(job) == Error::position_out_of_range);
        job = line(3, 6);
        job.parameters = {0, 1, 2, 3, 4, not_a_number};
        REQUIRE(error_of<S>(job) == Error::parameters_invalid);
    }
}

TEST_CASE("storage that is too small is refused", "[splines]") {
    const InterpolationKind kind{3, true, false};
    const std::vector<double> t{0, 1, 2, 3, 4, 5};
    std::vector<double> knots(kind.knots(6));
    REQUIRE(closed_knots<double>(KnotRule::params, t, 3, 6.0, knots).ok());
    std::vector<double> entries(kind.band(6).entries());
    std::vector<std::uint8_t> interchanges(kind.band(6).interchanges());
    BsplineInterpolation<double> system;
    REQUIRE(system.prepare(kind, t, knots, std::span(entries).first(entries.size() - 1U), interchanges).error() ==
            Error::storage_too_small);
    REQUIRE(system.prepare(kind, t, knots, entries, std::span(interchanges).first(5)).error() ==
            Error::storage_too_small);
    REQUIRE(system.prepare(kind, t, knots, entries, interchanges).ok());
    const std::vector<Point<double>> points(6);
    std::vector<Point<double>> controls(5);
    REQUIRE(system.interpolate(points, nullptr, 1, controls).error() == Error::storage_too_small);
}
