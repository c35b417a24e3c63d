// SPDX-License-Identifier: MIT
#include "splines/bspline_harness.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

/// Random knots on a grid of 1/64 (exact in every scalar), clamped, inner ones up to `repeats` times.
std::vector<double> random_knots(std::mt19937_64& random, int degree, int spans, int repeats) {
    std::vector<double> knots(static_cast<std::size_t>(degree) + 1U, 0.0);
    double at = 0.0;
    for (int i = 0; i < spans; ++i) {
        at += static_cast<double>(1U + random() % 200U) / 64.0;
        const int times = i + 1 == spans ? degree + 1 : 1 + static_cast<int>(random() % static_cast<unsigned>(repeats));
        knots.insert(knots.end(), static_cast<std::size_t>(times), at);
    }
    return knots;
}

template <Scalar S>
std::vector<S> in_scalar(const std::vector<double>& values) {
    std::vector<S> out;
    for (const double v : values) {
        out.push_back(from_double<S>(v));
    }
    return out;
}

template <Scalar S>
Real weight(S w) {
    return static_cast<Real>(to_double(w)) / static_cast<Real>(std::int32_t{1} << weight_log2<S>);
}

template <Scalar S>
constexpr Real eps = std::same_as<S, double>  ? 0x1p-53L
                     : std::same_as<S, float> ? 0x1p-24L
                                              : 0x1p-46L;

} // namespace

TEMPLATE_TEST_CASE("basis functions: a partition of unity, as the recursion says", "[splines]", double, float, Fixed) {
    using S = TestType;
    std::mt19937_64 random(7);
    for (int degree = 1; degree <= 9; ++degree) {
        for (int round = 0; round < 6; ++round) {
            const std::vector<double> plain = random_knots(random, degree, 6, degree);
            const std::vector<S> knots = in_scalar<S>(plain);
            const std::vector<Real> u(plain.begin(), plain.end());
            std::vector<double> places(plain.begin() + degree, plain.end() - degree); // every knot, both ends
            for (int i = 0; i < 8; ++i) {
                places.push_back(std::floor(plain.back() * static_cast<double>(random() % 4096U) / 64.0) / 64.0);
            }
            for (const double t : places) {
                CAPTURE(degree, round, t);
                const std::size_t span = find_span<S>(knots, degree, from_double<S>(t));
                REQUIRE((plain[span] < plain[span + 1U]));
                REQUIRE((plain[span] <= t && (t < plain[span + 1U] || t == plain.back())));
                const BasisDerivatives<S> basis = basis_derivatives<S>(knots, degree, span, from_double<S>(t));
                REQUIRE((basis.value == basis_functions<S>(knots, degree, span, from_double<S>(t))));
                S sum{};
                Real slopes = 0.0L;
                Real bends = 0.0L;
                const auto k = static_cast<std::size_t>(degree);
                const Real h = u[span + 1U] - u[span];
                for (std::size_t j = 0; j <= k; ++j) {
                    const Real n = recursive_basis(u, span - k + j, degree, static_cast<Real>(t), u.back());
                    REQUIRE(!(basis.value[j] < S{}));
                    REQUIRE(std::abs(weight(basis.value[j]) - n) <= 4.0L * degree * eps<S>);
                    const Real slope = recursive_slope(u, span - k + j, degree, static_cast<Real>(t), u.back()) * h;
                    REQUIRE(std::abs(weight(basis.first[j]) - slope) <= 8.0L * degree * degree * eps<S>);
                    sum += basis.value[j];
                    slopes += weight(basis.first[j]);
                    bends += weight(basis.second[j]);
                }
                if constexpr (std::same_as<S, Fixed>) {
                    REQUIRE((sum == weight_one<S>()));
                } else {
                    REQUIRE(std::abs(weight(sum) - 1.0L) <= 4.0L * degree * eps<S>);
                }
                REQUIRE(std::abs(slopes) <= 8.0L * degree * degree * eps<S>);
                REQUIRE(std::abs(bends) <= 16.0L * degree * degree * degree * eps<S>);
            }
        }
    }
}

TEST_CASE("spans are half-open, the last one closed, empty ones skipped", "[splines]") {
    const std::vector<double> knots{0, 0, 0, 0, 1, 2, 2, 2, 2};
    REQUIRE(find_span<double>(knots, 3, 0.0) == 3);
    REQUIRE(find_span<double>(knots, 3, std::nextafter(1.0, 0.0)) == 3);
    REQUIRE(find_span<double>(knots, 3, 1.0) == 4);
    REQUIRE(find_span<double>(knots, 3, 2.0) == 4);
    REQUIRE(find_span<double>(knots, 3, 3.0) == 4);
    REQUIRE(find_span<double>(knots, 3, -1.0) == 3);
    const std::vector<double> doubled{0, 0, 0, 1, 1, 2, 2, 2};
    REQUIRE(find_span<double>(doubled, 2, 1.0) == 4);
    REQUIRE(find_span<double>(doubled, 2, 0.5) == 2);
    const std::vector<double> loose_end{0, 0, 0, 1, 2, 2, 2, 3}; // its domain ends with an empty span
    REQUIRE(find_span<double>(loose_end, 2, 2.0) == 3);
    // At a simple inner knot only k functions differ from zero; closed spans would count two of degree 0.
    const PerDegree<double> at_knot = basis_functions<double>(knots, 3, 4, 1.0);
    REQUIRE(at_knot[0] + at_knot[1] + at_knot[2] == Approx(1.0));
    REQUIRE(at_knot[3] == 0.0);
}

TEMPLATE_TEST_CASE("second derivatives are those of the polynomial", "[splines]", double, Fixed) {
    using S = TestType;
    // t^2 has the control points u_a u_b summed over pairs of the k inner knots, over the number of pairs.
    for (int degree = 2; degree <= 9; ++degree) {
        std::mt19937_64 random(static_cast<unsigned>(degree));
        const std::vector<double> knots = random_knots(random, degree, 5, 2);
        const auto k = static_cast<std::size_t>(degree);
        std::vector<Point<S>> controls;
        for (std::size_t i = 0; i + k + 1U < knots.size(); ++i) {
            double sum = 0.0;
            for (std::size_t a = i + 1U; a <= i + k; ++a) {
                for (std::size_t b = a + 1U; b <= i + k; ++b) {
                    sum += knots[a] * knots[b];
                }
            }
            controls.push_back(to_point<S>({sum * 2.0 / (degree * (degree - 1.0))}));
        }
        const std::vector<S> u = in_scalar<S>(knots);
        for (int i = 0; i <= 40; ++i) {
            const double t = std::floor(knots.back() * 64.0 * i / 40.0) / 64.0;
            const CurveJet<S> jet = bspline_curve<S>(u, degree, controls, 1, from_double<S>(t));
            const double h = to_double(jet.span_length);
            CAPTURE(degree, t);
            REQUIRE(to_double(jet.position[0]) == Approx(t * t).margin(2e-9));
            REQUIRE(to_double(jet.first[0]) == Approx(2.0 * t * h).margin(1e-8));
            REQUIRE(to_double(jet.second[0]) == Approx(2.0 * h * h).margin(1e-7));
        }
    }
}
