// SPDX-License-Identifier: MIT
//
// A part of a cell is the same curve: positions, shapes and lengths against those of the whole.
#include "splinefeed/s2_arc_length/cell_part.hpp"

#include "support/catch.hpp"
#include "support/pipeline.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 815;

template <Scalar S>
Real apart(const Cell<S>& cell, S x, const Cell<S>& part, S xi) {
    PerAxis<Position> a{};
    PerAxis<Position> b{};
    cell.position_at(x, a);
    part.position_at(xi, b);
    Real most = 0.0L;
    for (const unsigned k : splinefeed::indices(cell.axes)) {
        most = std::max(most, std::fabs(exact_mm(a[k]) - exact_mm(b[k])));
    }
    return most;
}

} // namespace

TEMPLATE_TEST_CASE("a part of a cell is the same curve", "[feed_plan][cell_part]", double, float, Fixed) {
    using S = TestType;
    Random random(seed);
    int parts = 0;
    for (int run = 0; run < 10; ++run) {
        const int axes = random.integer(1, max_axes);
        const BezierPath path = random_path(random, axes, 4, random.decades(0.5, 50.0), 0.3, 0.3);
        ListSource<S> source(path);
        const std::vector<Cell<S>> cells =
            cells_of<S>(source, MotionLimits<S>::make(machine_of(axes, 100.0, 1000.0, 100.0)).value().refinement);
        for (const Cell<S>& cell : cells) {
            const double from = random.chance(0.3) ? 0.0 : random.between(0.0, 0.9);
            const double to = random.chance(0.3) ? 1.0 : random.between(from + 0.05, 1.0);
            const CellInterval<S> stretch{from_double<S>(from), from_double<S>(to)};
            const Cell<S> part = part_of(cell, stretch);
            const Real coarse = std::same_as<S, float> ? 3e-6L : 1e-9L;
            CAPTURE(seed, run, from, to, static_cast<double>(exact(cell.length_mm)));
            REQUIRE(std::fabs(exact(part.length_mm) - exact(cell.length_mm) * exact(stretch.length())) <=
                    coarse * (exact(cell.length_mm) + 1.0L));
            for (int i = 0; i <= 8; ++i) {
                const S xi = from_double<S>(i / 8.0);
                const S x = stretch.from + stretch.length() * xi;
                REQUIRE(apart(cell, x, part, xi) <= coarse * 4.0L * (exact(cell.length_mm) + 0.01L));
            }
            REQUIRE(part.stop_at_end == (to == 1.0 && cell.stop_at_end));
            REQUIRE(part.stop_before == (from == 0.0 && cell.stop_before));
            // Its end is where the next part starts, to the last digit of the polynomial
            if (to < 1.0) {
                const Cell<S> next = part_of(cell, CellInterval<S>{stretch.to, from_integer<S>(1)});
                for (const unsigned k : splinefeed::indices(axes)) {
                    REQUIRE(std::fabs(exact_mm(next.origin[k]) - exact_mm(part.end[k])) <=
                            coarse * 4.0L * (exact(cell.length_mm) + 0.01L));
                }
            }
            ++parts;
        }
    }
    CHECK(parts > 100);
}

TEST_CASE("where two parts of a cell meet a path that is sampled in double has no step", "[feed_plan][cell_part]") {
    // 2^-31 of a cell was one: at 250 us third differences showed 0.8 % of a jerk limit more
    Random random(seed + 2);
    Real most = 0.0L;
    for (int run = 0; run < 20; ++run) {
        const BezierPath path = random_path(random, 2, 4, random.decades(5.0, 50.0), 0.3, 0.3);
        ListSource<Fixed> source(path);
        const auto limits = MotionLimits<Fixed>::make(machine_of(2, 100.0, 1000.0, 100.0), SampledIn::float64).value();
        for (const Cell<Fixed>& cell : cells_of<Fixed>(source, limits.refinement)) {
            const auto cut = from_double<Fixed>(random.between(0.1, 0.9));
            const Cell<Fixed> part = part_of(cell, CellInterval<Fixed>{{}, cut});
            const Cell<Fixed> next = part_of(cell, CellInterval<Fixed>{cut, from_integer<Fixed>(1)});
            PerAxis<Position> before{};
            PerAxis<Position> behind{};
            part.position_at(1.0, before);
            next.position_at(0.0, behind);
            for (const unsigned k : {0U, 1U}) {
                most = std::max(most, std::fabs(exact_mm(before[k]) - exact_mm(behind[k])));
            }
        }
    }
    CHECK(most < 4e-11L); // some units of the polynomials, 2^-47 of a segment
}

TEMPLATE_TEST_CASE("a part of a cell has the shape of the whole", "[feed_plan][cell_part]", double, Fixed) {
    using S = TestType;
    Random random(seed + 1);
    for (int run = 0; run < 10; ++run) {
        const BezierPath path = random_path(random, 3, 4, random.decades(0.5, 50.0), 0.3, 0.3);
        ListSource<S> source(path);
        const auto limits = MotionLimits<S>::make(machine_of(3, 100.0, 1000.0, 100.0)).value();
        for (const Cell<S>& cell : cells_of<S>(source, limits.refinement)) {
            const CellInterval<S> stretch{from_double<S>(0.25), from_double<S>(0.75)};
            const Cell<S> part = part_of(cell, stretch);
            for (unsigned k = 0; k < 3; ++k) {
                const AxisShape<S>& a = cell.shape[k];
                const AxisShape<S>& b = part.shape[k];
                // The parabola 2 L q'' at the ends of the stretch, of a length that is half as long
                const auto bend = [&](Real x) {
                    const Real y = 1.0L - x;
                    return exact(a.bend[0]) * y * y + 2.0L * exact(a.bend[1]) * x * y + exact(a.bend[2]) * x * x;
                };
                REQUIRE(std::fabs(exact(b.bend[0]) - bend(0.25L) / 2.0L) <= 1e-8L);
                REQUIRE(std::fabs(exact(b.bend[2]) - bend(0.75L) / 2.0L) <= 1e-8L);
                // And dq/ds changes by its integral, but for what it leaves it by
                const Real change = (exact(b.bend[0]) + exact(b.bend[1]) + exact(b.bend[2])) / 6.0L;
                REQUIRE(std::fabs(exact(b.tangent[1]) - exact(b.tangent[0]) - change) <= exact(a.error_bound) + 1e-8L);
                REQUIRE(std::fabs(exact(b.error_bound) - exact(a.error_bound) / 2.0L) <= 1e-9L);
            }
        }
    }
}
