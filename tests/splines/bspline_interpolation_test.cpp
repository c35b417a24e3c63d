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
    Real worst = 0.0L;
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
                    REQUIRE(describe(curve.error) == describe(Error::none));
                    const Real ratio = against_dense(job, curve);
                    worst = std::max(worst, ratio);
                    REQUIRE(static_cast<double>(ratio) <= 1.0);
                }
            }
        }
    }
    WARN("worst error over bound: " << static_cast<double>(worst));
}
