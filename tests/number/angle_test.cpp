// SPDX-License-Identifier: MIT
#include "splinefeed/number/angle.hpp"

#include "support/bezier_paths.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <numbers>

using namespace splinefeed;
using namespace splinefeed_test;

TEMPLATE_TEST_CASE("series of small angles have the digits of their scalar", "[angle]", double, float, Fixed) {
    using S = TestType;
    const Real ulp = rounding<S>();
    for (int i = -600; i <= 600; ++i) {
        const S x = from_double<S>(1e-3 * i);
        CAPTURE(i);
        CHECK(std::fabs(exact(small_sine(x)) - std::sin(exact(x))) <= 3.0L * ulp + 3e-13L);
        const Real half = std::sin(exact(x) / 2.0L);
        const Real versine = 2.0L * half * half;
        CHECK(std::fabs(exact(small_versine(x)) - versine) <=
              3.0L * ulp * (std::same_as<S, Fixed> ? 1.0L : versine) + 1e-14L);
    }
}

TEMPLATE_TEST_CASE("the angle of a vector, whatever its length and direction", "[angle]", double, float, Fixed) {
    using S = TestType;
    const Real ulp = rounding<S>();
    Random random(7);
    for (int round = 0; round < rounds(2000); ++round) {
        const double length = random.decades(1e-2, 1e8);
        const double direction = random.between(-3.14159, 3.14159);
        const S cosine = from_double<S>(length * std::cos(direction));
        const S sine = from_double<S>(length * std::sin(direction));
        const Real expected = std::atan2(exact(sine), exact(cosine));
        CAPTURE(round, length, direction);
        CHECK(std::fabs(exact(angle_of(cosine, sine)) - expected) <= 12.0L * ulp + 1e-12L);
    }
    const S one = from_integer<S>(1);
    CHECK(angle_of(one, S{}) == S{});
    CHECK(angle_of(S{}, S{}) == S{});
    CHECK(std::fabs(exact(angle_of(-one, S{})) - std::numbers::pi_v<Real>) < 8.0L * ulp);
    CHECK(std::fabs(exact(angle_of(S{}, -one)) + std::numbers::pi_v<Real> / 2.0L) < 8.0L * ulp);
}
