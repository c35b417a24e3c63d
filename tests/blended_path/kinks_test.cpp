// SPDX-License-Identifier: MIT
//
// Joints that turn by next to nothing, or whose curvature jumps by little: a plan passes them, within the limits at
// every instant, and no tolerance makes it slower. What is emitted is compared.
#include "emitted_moves.hpp"
#include "support/rounds.hpp"

using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 20261130;

/// Cubics of about `size` mm. Each begins in the direction of the one before but for `turn`, and with a curvature that
/// differs by `bend` from its, to either side in turn.
MoveProgram chain_of(Real size, Real turn, Real bend, double tolerance_mm) {
    constexpr Real bent = 0.02L;
    MoveProgram program;
    program.axes = 2;
    const Real leg = size / 3.0L;
    Real heading = 0.3L;
    for (int i = 0; i < 8; ++i) {
        const Real side = i % 2 == 0 ? 1.0L : -1.0L;
        const Real from = i == 0 ? bent : bent + side * bend;
        const auto at = [&](Real along, Real across) {
            return PlaceMm{along * std::cos(heading) - across * std::sin(heading),
                           along * std::sin(heading) + across * std::cos(heading)};
        };
        // A curvature is 2/3 of the distance of the third point from the tangent, over the square of the leg.
        const Real height = 1.5L * from * leg * leg;
        const Real ahead = std::atan2(height, leg) + std::asin(1.5L * bent * leg * leg / std::hypot(leg, height));
        program
            .bezier({at(leg, 0.0L), at(2.0L * leg, height),
                     at(2.0L * leg + leg * std::cos(ahead), height + leg * std::sin(ahead))})
            .tolerance_mm = tolerance_mm;
        heading += ahead + side * turn;
    }
    return program;
}

} // namespace

TEMPLATE_TEST_CASE("kinks of all sizes keep the limits, and no tolerance makes them slower", "[never_slower][kinks]",
                   double, Fixed) {
    using S = TestType;
    for (int round = static_cast<int>(first_round()), count = rounds(40, 3000); round < count; ++round) {
        Random random(seed + static_cast<std::uint64_t>(round));
        const Real size = static_cast<Real>(random.decades(0.02, 20.0));
        const Real turn = random.chance(0.2) ? 0.0L : static_cast<Real>(random.decades(1e-12, 0.3));
        const Real most_bend = std::min(1.0L, 0.5L / size);
        const Real bend = random.chance(0.3) ? 0.0L : most_bend * static_cast<Real>(random.decades(1e-9, 1.0));
        MachineSettings machine = machine_of(2, 100.0, 1000.0, 100.0, random.chance(0.7) ? 1000 : 250);
        machine.axis[0].max_jerk_mm_s3 = random.decades(1e4, 1e5);
        machine.axis[1].max_jerk_mm_s3 = random.decades(3e3, 1e5);
        double slowest = 1e9;
        for (const double tolerance : {0.0, 1e-7, 1e-6, 3e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
            MoveProgram program = chain_of(size, turn, bend, tolerance);
            program.joint_tolerance_mm = tolerance;
            CAPTURE(round, tolerance, static_cast<double>(size), static_cast<double>(turn), static_cast<double>(bend),
                    machine.sample_period_us);
            const EmittedMoves run = emit<S>(program, machine);
            require_limits(run, machine);
            const auto segments = static_cast<double>(run.segments.size());
            CHECK(segments <= 1.005 * slowest + 3.0);
            slowest = std::min(slowest, segments);
        }
    }
}

TEMPLATE_TEST_CASE("what decimals turn a joint by costs next to nothing", "[never_slower][kinks]", double, Fixed) {
    using S = TestType;
    const MachineSettings machine = with_jerk(machine_of(2, 100.0, 1000.0, 100.0), 30000.0);
    for (const double tolerance : {0.0, 0.01}) {
        const EmittedMoves smooth = emit<S>(chain_of(1.0L, 0.0L, 0.0L, tolerance), machine);
        for (const Real turn : {1e-7L, 3e-7L, 1e-6L, 2e-6L}) {
            CAPTURE(tolerance, static_cast<double>(turn));
            const EmittedMoves run = emit<S>(chain_of(1.0L, turn, 1e-4L, tolerance), machine);
            require_limits(run, machine);
            CHECK(static_cast<double>(run.segments.size()) <=
                  1.005 * static_cast<double>(smooth.segments.size()) + 1.0);
        }
    }
}
