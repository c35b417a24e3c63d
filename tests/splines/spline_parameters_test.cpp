// SPDX-License-Identifier: MIT
#include "splines/bspline_harness.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

template <Scalar S>
Error parameters_of(const std::vector<std::vector<double>>& points, Parameterization how, bool closed, double domain,
                    std::vector<S>& out) {
    std::vector<Point<S>> list;
    for (const auto& p : points) {
        list.push_back(to_point<S>(p));
    }
    out.resize(points.size());
    return spline_parameters<S>(list, static_cast<int>(points.front().size()), how, closed, from_double<S>(domain), out)
        .error();
}

constexpr Parameterization all[] = {Parameterization::uniform, Parameterization::chordal,
                                    Parameterization::centripetal};

} // namespace

TEMPLATE_TEST_CASE("parameters are sums of 1, chords or their roots", "[splines]", double, float, Fixed) {
    using S = TestType;
    std::mt19937_64 random(3);
    const bool fixed = std::same_as<S, Fixed>;
    for (const Parameterization how : all) {
        for (const bool closed : {false, true}) {
            for (const std::size_t count : {3U, 10U, 500U}) {
                const double scale = fixed ? 4096.0 : 1.0; // what the host makes of them
                auto points = random_points(random, count, 3, 100.0, true);
                for (auto& p : points) {
                    for (double& x : p) {
                        x *= scale;
                    }
                }
                const double domain = 65536.0;
                std::vector<S> t;
                REQUIRE(parameters_of(points, how, closed, domain, t) == Error::none);
                std::vector<Real> sums{0.0L};
                for (std::size_t i = 0; i < count; ++i) {
                    Real sq = 0.0L;
                    for (std::size_t k = 0; k < 3; ++k) {
                        const Real e = static_cast<Real>(points[(i + 1U) % count][k]) - static_cast<Real>(points[i][k]);
                        sq += e * e;
                    }
                    const Real h = how == Parameterization::uniform   ? 1.0L
                                   : how == Parameterization::chordal ? std::sqrt(sq)
                                                                      : std::sqrt(std::sqrt(sq));
                    sums.push_back(sums.back() + h);
                }
                const Real whole = closed ? sums[count] : sums[count - 1U];
                // Sums round n times at most; in Fixed the quotient is good to 2^-45 and the product to two ulp. Roots
                // of short chords have fewer digits there.
                const Real bound = fixed                     ? 65536.0L * 0x1p-38L
                                   : std::same_as<S, double> ? 65536.0L * 0x1p-53L * (static_cast<Real>(count) + 6.0L)
                                                             : 65536.0L * 0x1p-24L * (static_cast<Real>(count) + 6.0L);
                for (std::size_t i = 0; i < count; ++i) {
                    CAPTURE(i, count, closed, static_cast<int>(how));
                    REQUIRE(std::abs(static_cast<Real>(to_double(t[i])) -
                                     sums[i] / whole * static_cast<Real>(domain)) <= bound);
                }
                REQUIRE(to_double(t[0]) == 0.0);
                REQUIRE((closed || to_double(t.back()) == domain));
            }
        }
    }
}

TEMPLATE_TEST_CASE("parameters: what is refused", "[splines]", double, float, Fixed) {
    using S = TestType;
    std::vector<S> t;
    const std::vector<std::vector<double>> twice{{0, 0}, {1, 0}, {1, 0}, {2, 5}};
    const std::vector<std::vector<double>> same{{1, 1}, {1, 1}, {1, 1}};
    const std::vector<std::vector<double>> repeated{{0, 0}, {1, 0}, {1, 3}, {0, 0}};
    for (const Parameterization how : {Parameterization::chordal, Parameterization::centripetal}) {
        REQUIRE(parameters_of(twice, how, false, 3.0, t) == Error::coincident_points);
        REQUIRE(parameters_of(same, how, false, 3.0, t) == Error::coincident_points);
        REQUIRE(parameters_of(repeated, how, true, 3.0, t) == Error::coincident_points);
        REQUIRE(parameters_of(repeated, how, false, 3.0, t) == Error::none);
    }
    REQUIRE(parameters_of(twice, Parameterization::uniform, false, 3.0, t) == Error::none);
    REQUIRE(parameters_of(same, Parameterization::uniform, false, 2.0, t) == Error::none);
    REQUIRE(parameters_of<S>({{1, 1}}, Parameterization::uniform, false, 2.0, t) == Error::too_few_points);
    REQUIRE(parameters_of<S>({{1, 1}, {2, 2}}, Parameterization::uniform, true, 2.0, t) == Error::too_few_points);
    REQUIRE(parameters_of(twice, Parameterization::uniform, false, 0.0, t) == Error::parameters_invalid);
    REQUIRE(parameters_of(twice, Parameterization::uniform, false, -1.0, t) == Error::parameters_invalid);
    if constexpr (std::same_as<S, Fixed>) {
        REQUIRE(parameters_of(twice, Parameterization::uniform, false, 0x1p27, t) == Error::parameters_invalid);
        REQUIRE(parameters_of<S>({{0x1p29}, {0.0}}, Parameterization::chordal, false, 2.0, t) ==
                Error::position_out_of_range);
        // sums beyond 2^31 are kept in range
        std::vector<std::vector<double>> zigzag;
        for (int i = 0; i < 300; ++i) {
            zigzag.push_back({i % 2 == 0 ? 0x1p28 : -0x1p28});
        }
        REQUIRE(parameters_of<S>(zigzag, Parameterization::chordal, false, 299.0, t) == Error::none);
        REQUIRE(to_double(t[100]) == Approx(100.0).epsilon(1e-9));
    } else {
        REQUIRE(parameters_of<S>({{0.0}, {not_a_number}}, Parameterization::uniform, false, 2.0, t) ==
                Error::position_out_of_range);
        REQUIRE(parameters_of<S>({{0.0}, {infinite}}, Parameterization::chordal, false, 2.0, t) ==
                Error::position_out_of_range);
        REQUIRE(parameters_of(twice, Parameterization::uniform, false, not_a_number, t) == Error::parameters_invalid);
        const double far = 0.6 * to_double(largest<S>());
        REQUIRE(parameters_of<S>({{far}, {-far}, {0}}, Parameterization::chordal, false, 2.0, t) != Error::none);
    }
}
