// SPDX-License-Identifier: MIT
//
// A cell evaluates its two polynomials as stated, with rounding errors only.
#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"
#include "support/catch.hpp"
#include "support/cell_reference.hpp"
#include "support/pipeline.hpp"
#include "support/rounds.hpp"

using namespace splinefeed_test;

namespace {

/// Random coefficients: offsets within 2^16 units, and an inverse near the identity.
template <class S>
Cell<S> random_cell(Random& random) {
    Cell<S> cell;
    cell.axes = random.integer(1, max_axes);
    cell.degree = random.integer(1, max_degree);
    cell.unit_log2 = random.integer(-25, 0);
    cell.length_mm = from_integer<S>(1);
    for (const unsigned k : splinefeed::indices(cell.axes)) {
        cell.origin[k] = position_from_mm(random.between(-1e5, 1e5));
        for (unsigned i = 0; i <= static_cast<unsigned>(cell.degree); ++i) {
            cell.power[k][i] = from_double<S>(random.between(-1.0, 1.0) * (i == 0 ? 0.5 : 6000.0));
        }
    }
    double left = 0.0;
    for (unsigned i = 1; i < 6; ++i) {
        const double c = random.between(-0.3, 0.3);
        cell.inverse[i] = from_double<Ratio<S>>(c);
        left -= to_double(cell.inverse[i]);
    }
    cell.inverse[0] = from_double<Ratio<S>>(left);
    return cell;
}

} // namespace

TEMPLATE_TEST_CASE("the parameter is the polynomial w = x + sum inverse[i] x^(i+1) / 4", "[arc_length][cell]", double,
                   float, Fixed) {
    Random random(31);
    for (int i = 0; i < 2000; ++i) {
        const Cell<TestType> cell = random_cell<TestType>(random);
        const TestType x = from_double<TestType>(random.between(0.0, 1.0));
        Real slope = 0.0L;
        const Real w = inverse_at(cell, exact(x), slope);
        // Six products and five sums of numbers below 1.5, a quarter of which is added
        REQUIRE(std::fabs(exact(cell.parameter_at(x)) - w) <=
                (std::same_as<TestType, Fixed> ? 4.0L : 12.0L) * rounding<TestType>());
        REQUIRE(cell.parameter_at(TestType{}) == TestType{});
        if (std::same_as<TestType, Fixed>) {
            REQUIRE(cell.parameter_at(from_integer<TestType>(1)) == from_integer<TestType>(1));
        }
    }
}

TEMPLATE_TEST_CASE("positions are the offset polynomial at w from the origin", "[arc_length][cell]", double, float,
                   Fixed) {
    Random random(32);
    for (int i = 0; i < 2000; ++i) {
        const Cell<TestType> cell = random_cell<TestType>(random);
        const TestType x = from_double<TestType>(random.between(0.0, 1.0));
        PerAxis<Position> position{};
        cell.position_at(x, position);
        const Jet jet = evaluate(cell, exact(cell.parameter_at(x)));
        for (const unsigned k : splinefeed::indices(cell.axes)) {
            // Per step of Horner's rule a product and a sum below 6000 (degree + 1); Fixed rounds absolutely.
            const Real size = std::same_as<TestType, Fixed> ? 1.0L : 6000.0L * (cell.degree + 1);
            const Real units = 2.0L * cell.degree * size * rounding<TestType>();
            const Real miss = exact_mm(position[k]) - exact_mm(cell.origin[k]) - jet.r[k];
            REQUIRE(std::fabs(miss) <= std::ldexp(units, cell.unit_log2) + 0x1p-41L);
        }
    }
}

TEMPLATE_TEST_CASE("the bend of a cell bounds what its parameter accelerates along a straight line",
                   "[arc_length][cell]", double, Fixed) {
    // On a line nothing bends; what is left of q'' is the error of the inverse. The two lengths of a cubic are the
    // same: they do not show it, and an axis at its limit exceeded that by 3e-5
    int bent = 0;
    for (std::uint64_t round = first_round(); round < static_cast<std::uint64_t>(rounds(60)); ++round) {
        Random random(4000 + round);
        BezierPath path = random_path(random, 1, 6, random.decades(0.5, 50.0), 0.15, 0.0);
        for (TestShape& shape : path) { // bent as little as makes it no line (CurveSegment::straighten)
            shape.axes = 2;
            shape.offset[1] = {0.0, 1e-6};
        }
        MachineSettings machine;
        machine.axes = 2;
        machine.max_feed_mm_s = random.decades(10.0, 1000.0);
        ListSource<TestType> source(path);
        for (const Cell<TestType>& cell :
             cells_of<TestType>(source, MotionLimits<TestType>::make(machine).value().refinement)) {
            if (is_chord(cell)) {
                continue;
            }
            const Real length = exact(cell.length_mm);
            // Coefficients are rounded, and i (i - 1) times their rounding is in q''
            const Real noise = 400.0L * rounding<TestType>() / length;
            Real most = 0.0L;
            for (int j = 0; j < 32; ++j) {
                const auto speed = [&](Real x) {
                    Real slope = 0.0L;
                    const Real w = inverse_at(cell, x, slope);
                    return evaluate(cell, w).speed(1) * slope / length;
                };
                most = std::max(most, std::fabs(speed((j + 1) / 32.0L) - speed(j / 32.0L)) * 32.0L / length);
            }
            CAPTURE(round, static_cast<double>(most * length), static_cast<double>(length));
            REQUIRE(most <= exact(cell.curvature_max[0]) + noise);
            bent += most > 2.0L * noise ? 1 : 0;
        }
    }
    CHECK(bent > 0);
}
