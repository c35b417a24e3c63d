// SPDX-License-Identifier: MIT
//
// The unit of a Bezier segment: as many bits below its size as the scalar has, and nothing lost on the way.
#include "splinefeed/s1_curve/curve_segment.hpp"

#include "splinefeed/number/exponent.hpp"
#include "support/curve_harness.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

TEMPLATE_TEST_CASE("segment: the largest offset lies in [2^15, 2^16)", "[curve][segment]", double, float, Fixed) {
    using S = TestType;
    RandomPath random;
    CAPTURE(path_seed);
    for (int log2 = -30; log2 <= 29; ++log2) {
        for (int sample = 0; sample < 20; ++sample) {
            CurveSegment<S> segment;
            segment.axes = 1 + random.below(6);
            segment.degree = 1 + random.below(9);
            PerAxis<PerDegree<S>> offsets{};
            // the largest anywhere, with either sign; beyond axes and degree only junk that must not count
            for (auto& axis : offsets) {
                axis.fill(from_double<S>(1073741823.0));
            }
            for (const unsigned k : indices(segment.axes)) {
                for (unsigned i = 0; i <= static_cast<unsigned>(segment.degree); ++i) {
                    offsets[k][i] = from_double<S>(std::ldexp(random.between(-0.99, 0.99), log2));
                }
            }
            const auto axis = static_cast<unsigned>(random.below(segment.axes));
            const auto point = static_cast<unsigned>(random.below(segment.degree + 1));
            const double top = std::ldexp(sample == 0 ? 1.0 : random.between(1.0, 1.8), log2);
            offsets[axis][point] = from_double<S>(sample % 2 == 0 ? top : -top);
            segment.assign(offsets);
            REQUIRE(segment.unit_log2 == chord_unit_log2 + log2 - 15);
            REQUIRE(exponent_of(absolute(segment.control[axis][point])) == 15);
            for (const unsigned k : indices(segment.axes)) {
                for (unsigned i = 0; i <= static_cast<unsigned>(segment.degree); ++i) {
                    const Real given = std::ldexp(exact(offsets[k][i]), chord_unit_log2);
                    const Real kept = std::ldexp(exact(segment.control[k][i]), segment.unit_log2);
                    // Exact, but that Fixed drops bits where it shifts right: half an ulp of the new unit.
                    const Real slack =
                        std::same_as<S, Fixed> && log2 > 15 ? std::ldexp(0x1p-33L, segment.unit_log2) : 0.0L;
                    REQUIRE(std::fabs(given - kept) <= slack);
                    REQUIRE(absolute(segment.control[k][i]) <= from_integer<S>(65536));
                }
            }
        }
    }
}

TEMPLATE_TEST_CASE("a segment on its chord becomes a line, no other does", "[curve]", double, Fixed) {
    using S = TestType;
    const auto made = [](const PerAxis<PerDegree<double>>& mm, int degree) {
        CurveSegment<S> segment;
        segment.axes = 2;
        segment.degree = degree;
        PerAxis<PerDegree<S>> offsets{};
        for (unsigned k = 0; k < 2; ++k) {
            for (unsigned i = 0; i <= static_cast<unsigned>(degree); ++i) {
                offsets[k][i] = from_double<S>(mm[k][i] * chord_units_per_mm);
            }
        }
        segment.assign(offsets);
        segment.straighten();
        return segment;
    };
    const auto degree_of = [&](const PerAxis<PerDegree<double>>& mm) {
        return made(mm, 3).degree;
    };
    const CurveSegment<S> line = made({{{0.0, 1.0, 1.5, 4.0}, {0.0, 3.0, 4.5, 12.0}}}, 3);
    CHECK(line.degree == 1);
    CHECK(line.control_mm(0, 1) == 4.0);
    CHECK(line.control_mm(1, 1) == 12.0);
    CHECK(degree_of({{{0.0, 0.0, 4.0, 4.0}, {0.0, 0.0, 0.0, 0.0}}}) == 1);  // stands at both ends
    CHECK(degree_of({{{0.0, 2.0, 1.0, 4.0}, {0.0, 0.0, 0.0, 0.0}}}) == 3);  // to and fro
    CHECK(degree_of({{{0.0, -1.0, 2.0, 4.0}, {0.0, 0.0, 0.0, 0.0}}}) == 3); // it begins backward
    CHECK(degree_of({{{0.0, 1.0, 5.0, 4.0}, {0.0, 0.0, 0.0, 0.0}}}) == 3);  // beyond its end
    CHECK(degree_of({{{0.0, 1.0, 2.0, 4.0}, {0.0, 1e-6, 0.0, 0.0}}}) == 3); // a nanometre beside it
    CHECK(degree_of({{{0.0, 2e-3, 5e-3, 9e-3}, {0.0, 0.0, 0.0, 0.0}}}) == 3);
}
