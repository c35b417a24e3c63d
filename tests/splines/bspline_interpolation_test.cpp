// SPDX-License-Identifier: MIT
#include "splines/bspline_harness.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

template <Scalar S>
constexpr Real rounding = std::same_as<S, double>  ? 0x1p-53L
                          : std::same_as<S, float> ? 0x1p-24L
                                                   : 0x1p-46L;

/// Largest distance of control points from those of the dense elimination, over what the header promises.
template <Scalar S>
Real against_dense(const Job& job, const Curve<S>& curve) {
    auto [a, b] = dense_system(job, to_reals(curve.parameters), to_reals(curve.knots));
    const Real condition = condition_of(a);
    Real size = 0.0L;
    for (const auto& row : b) {
        for (const Real x : row) {
            size = std::max(size, std::abs(x));
        }
    }
    dense_solve(a, b);
    Real worst = 0.0L;
    for (std::size_t i = 0; i < b.size(); ++i) {
        for (std::size_t k = 0; k < b[i].size(); ++k) {
            worst = std::max(worst, std::abs(static_cast<Real>(to_double(curve.controls[i][k])) - b[i][k]));
        }
    }
    const Real k = job.kind.degree;
    const Real ulp = std::same_as<S, Fixed> ? 0x1p-32L * 4.0L * (k + 1.0L) * condition : 0.0L;
    return worst / (condition * 4.0L * (k + 1.0L) * rounding<S> * size + ulp);
}

} // namespace

TEMPLATE_TEST_CASE("control points are those of dense elimination", "[splines]", double, float, Fixed) {
    std::mt19937_64 random(20261121);
    for (int degree = 1; degree <= 9; ++degree) {
        for (const std::size_t count : {3U, 4U, 5U, 10U, 11U, 24U}) {
            for (const bool closed : {false, true}) {
                for (const double scale : {1.0, 1000.0}) {
                    Job job;
                    job.points = random_points(random, count, 3, 3.0);
                    for (auto& p : job.points) {
                        for (double& x : p) {
                            x *= scale;
                        }
                    }
                    job.kind = {degree, closed, false};
                    job.domain = 4096.0;
                    CAPTURE(degree, count, closed);
                    const Curve<TestType> curve = interpolated<TestType>(job);
                    if (!closed && count < static_cast<std::size_t>(degree) + 1U) {
                        REQUIRE(curve.error == Error::too_few_points);
                        continue;
                    }
                    REQUIRE(curve.error == Error::none);
                    REQUIRE(static_cast<double>(against_dense(job, curve)) <= 1.0);
                }
            }
        }
    }
}

TEMPLATE_TEST_CASE("end derivatives: the curve has them, and the control points of dense elimination", "[splines]",
                   double, float, Fixed) {
    using S = TestType;
    std::mt19937_64 random(5);
    for (int degree = 2; degree <= 9; ++degree) {
        for (const std::size_t count : {2U, 3U, 9U, 20U}) {
            for (const KnotRule rule : {KnotRule::average_tangents, KnotRule::uniform, KnotRule::params}) {
                Job job;
                job.points = random_points(random, count, 2, 2.0);
                job.kind = {degree, false, true};
                job.rule = rule;
                job.how = Parameterization::centripetal;
                job.domain = 8.0;
                job.start = {1.0, -2.0};
                job.end = {0.0, 0.0}; // a cusp is allowed
                CAPTURE(degree, count, static_cast<int>(rule));
                const Curve<S> curve = interpolated<S>(job);
                if (count + 2U < static_cast<std::size_t>(degree) + 1U) {
                    REQUIRE(curve.error == Error::too_few_points);
                    continue;
                }
                if (rule == KnotRule::params && degree != 3) {
                    REQUIRE(curve.error == Error::knot_rule_unsuited);
                    continue;
                }
                if (rule == KnotRule::uniform && curve.error == Error::schoenberg_whitney) {
                    continue;
                }
                REQUIRE(curve.error == Error::none);
                // The derivative rows of the dense system have entries k/h: its condition is not that of the rows here.
                auto [a, b] = dense_system(job, to_reals(curve.parameters), to_reals(curve.knots));
                const Real condition = condition_of(a);
                dense_solve(a, b);
                for (std::size_t i = 0; i < b.size(); ++i) {
                    for (unsigned k = 0; k < 2; ++k) {
                        const Real off = std::abs(static_cast<Real>(to_double(curve.controls[i][k])) - b[i][k]);
                        const Real ulp = std::same_as<S, Fixed> ? 0x1p-28L : rounding<S> * 100.0L;
                        REQUIRE(static_cast<double>(off) <= static_cast<double>(condition * ulp * degree));
                    }
                }
                const CurveJet<S> first = curve.at(curve.parameters.front());
                const double h = to_double(first.span_length);
                const double tolerance = std::same_as<S, float> ? 1e-2 : 1e-6; // ulp of control points over h
                REQUIRE(to_double(first.first[0]) / h == Approx(1.0).epsilon(tolerance));
                REQUIRE(to_double(first.first[1]) / h == Approx(-2.0).epsilon(tolerance));
                REQUIRE(std::abs(to_double(curve.at(curve.parameters.back()).first[0])) <= tolerance);
            }
        }
    }
}
