// SPDX-License-Identifier: MIT
//
// What the rounding of long segments does where cells meet.
#include "splinefeed/s2_arc_length/control_rounding.hpp"

#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"
#include "support/catch.hpp"
#include "support/cell_reference.hpp"

using namespace splinefeed_test;

TEMPLATE_TEST_CASE("the last cell of a segment ends where the next segment begins", "[arc_length]", double, float,
                   Fixed) {
    using S = TestType;
    Random random(70412);
    for (int round = 0; round < 30; ++round) {
        BezierPath path;
        for (int i = 0; i < 6; ++i) {
            path.push_back(random_shape(random, 3, 3, random.decades(0.01, 300.0)));
            if (i > 0) {
                join_smoothly(path[path.size() - 2], path.back());
            }
        }
        const auto limits = MotionLimits<S>::make({}).value();
        ListSource<S> source(path);
        const std::vector<Cell<S>> cells = cells_of<S>(source, limits.refinement, 1U << 18, nullptr);
        int joints = 0;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const Cell<S>& cell = cells[i];
            if (i + 1 < cells.size() && cells[i + 1].waypoint == cell.waypoint) {
                continue;
            }
            const PerAxis<Position>& end = i + 1 < cells.size() ? cells[i + 1].origin : cell.end;
            const Jet jet = evaluate(cell, 1.0L);
            for (unsigned k = 0; k < 3; ++k) {
                const Real gap = std::fabs(exact_mm(cell.origin[k]) + jet.r[k] - exact_mm(end[k]));
                CAPTURE(round, i, k, static_cast<double>(gap), to_double(cell.length_mm));
                REQUIRE(gap <=
                        8.0L * rounding<S>() * (exact(cell.length_mm) + std::ldexp(1.0L, cell.unit_log2)) + 0x1p-40L);
            }
            ++joints;
        }
        CHECK(joints == 6);
    }
}

TEMPLATE_TEST_CASE("where the cells of a segment meet neither place nor direction jumps", "[arc_length]", double, float,
                   Fixed) {
    using S = TestType;
    MachineSettings machine;
    machine.axes = 3;
    machine.axis[1].max_acceleration_mm_s2 = 100.0 * machine.axis[2].max_acceleration_mm_s2;
    const auto limits = MotionLimits<S>::make(machine).value();
    Random random(70413);
    Real most = 0.0L;
    for (int round = 0; round < 100; ++round) {
        const BezierPath path{random_shape(random, 3, 3, random.decades(0.1, 300.0))};
        ListSource<S> source(path);
        const std::vector<Cell<S>> cells = cells_of<S>(source, limits.refinement, 1U << 18, nullptr);
        for (std::size_t i = 1; i < cells.size(); ++i) {
            const Cell<S>& before = cells[i - 1];
            const Cell<S>& after = cells[i];
            if (before.stop_before || after.stop_before) {
                continue; // a cusp
            }
            const Jet end = evaluate(before, 1.0L);
            const Jet start = evaluate(after, 0.0L);
            const Direction from = direction_at(before, 1.0L);
            const Direction to = direction_at(after, 0.0L);
            const Real speed = std::min({exact(before.steady_mm_s), exact(after.steady_mm_s), 1e4L});
            for (unsigned k = 0; k < 3; ++k) {
                const Real gap =
                    std::fabs(exact_mm(before.origin[k]) + end.r[k] - exact_mm(after.origin[k]) - start.r[k]);
                CAPTURE(round, i, k, static_cast<double>(gap), to_double(before.length_mm));
                REQUIRE(gap <= 8.0L * rounding<S>() * (exact(before.length_mm) + std::ldexp(1.0L, before.unit_log2)) +
                                   0x1p-40L);
                const Real jump = std::fabs(to.tangent[k] - from.tangent[k]) * speed;
                REQUIRE(jump <= exact(limits.refinement.jump_mm_s[k]));
                most = std::max(most, jump / exact(limits.refinement.jump_mm_s[k]));
            }
        }
    }
    CAPTURE(static_cast<double>(most));
    CHECK(most > (std::same_as<S, float> ? 0.02L : 0.1L)); // the bound is not much too large
}

TEMPLATE_TEST_CASE("an axis that hardly moves holds nothing back", "[arc_length]", double, float, Fixed) {
    using S = TestType;
    const BezierPath path{line_shape(2, 1, {100.0, 0.1})};
    const CurveSegment<S> segment = segments_of<S>(path).front();
    const auto speed = [&](double jump_x, double jump_y) {
        const PerAxis<Ratio<S>> direction{from_integer<Ratio<S>>(1), from_double<Ratio<S>>(0.001)};
        return to_double(ControlRounding<S>::of(segment, 0, from_double<S>(0.5), direction)
                             .steady_speed({from_double<S>(jump_x), from_double<S>(jump_y)}, 2));
    };
    const double alike = speed(1e-3, 1e-3);
    if (std::same_as<S, float>) {
        CHECK(speed(1e-3, 1e-5) > 0.9 * alike); // its own control points are a thousandth, and their rounding
        CHECK(speed(1e-5, 1e-3) < 0.011 * alike);
    } else {
        CHECK(speed(1e-3, 1e-5) == Approx(0.02 * alike).epsilon(0.02)); // the same grid for both; x jumps twice
    }
}
