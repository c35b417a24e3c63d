// SPDX-License-Identifier: MIT
//
// Whatever the moves are, the path is within their tolerance, and they within its; G2 but for corners that stop.
#include "splinefeed/s1_blended_path/tolerance_path.hpp"

#include "support/emitted.hpp"
#include "support/moves_deviation.hpp"
#include "support/programs.hpp"
#include "support/random_moves.hpp"
#include "support/rounds.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 20261123;

Real rounded(Real x) {
    return std::round(x * 1000.0L) / 1000.0L;
}

/// Lines through points of a curve, with three decimals.
template <class Curve>
MoveProgram sampled(Curve&& curve, int count, double tolerance_mm) {
    MoveProgram program;
    for (int i = 0; i <= count; ++i) {
        PlaceMm place = curve(static_cast<Real>(i) / static_cast<Real>(count));
        for (Real& x : place) {
            x = rounded(x);
        }
        if (i == 0) {
            program.start = place;
        } else {
            program.line(place).tolerance_mm = tolerance_mm;
        }
    }
    return program;
}

PlaceMm wave(Real t) {
    return {50.0L * t, 5.0L * std::sin(10.0L * t), 5.0L * t};
}

/// float resolves 2^-24 of a move; Fixed has angles in 2^-32.
template <Scalar S>
Real digits_mm(const MoveProgram& program) {
    Real largest = 0.0L;
    for (const ProgrammedMove& move : program.moves) {
        for (const Real t : {0.25L, 0.5L, 0.75L, 1.0L}) {
            largest = std::max(largest, apart(move.at(t, program.axes), move.from, program.axes));
        }
    }
    Real radius = 0.0L;
    for (const ProgrammedMove& move : program.moves) {
        if (move.shape == MoveShape::arc) {
            radius = std::max(radius, std::hypot(move.from[0] - move.centre[0], move.from[1] - move.centre[1]));
        }
    }
    return std::same_as<S, float>   ? 64.0L * 0x1p-24L * largest
           : std::same_as<S, Fixed> ? 1e-6L + 64.0L * 0x1p-44L * largest + 8.0L * 0x1p-32L * radius
                                    : 1e-6L + 64.0L * 0x1p-44L * largest;
}

template <Scalar S>
void require_path(const MoveProgram& program, const BlendedRun<S>& run) {
    REQUIRE_FALSE(run.segments.empty());
    Real least = 1e9L;
    for (const ProgrammedMove& move : program.moves) {
        least = std::min(least, static_cast<Real>(std::max(move.tolerance_mm, program.joint_tolerance_mm)));
    }
    const Deviation found = deviation(program, run.segments, 8);
    CAPTURE(found.move, found.from_path, static_cast<double>(found.at), static_cast<double>(least));
    CHECK(found.most <= 1.0L + digits_mm<S>(program) / least);
    const PlaceMm end = place_of(run.segments.back(), 1.0L);
    CHECK(apart(end, program.moves.back().to, program.axes) <= digits_mm<S>(program) + 2e-4L);
    CHECK(jumps(run.segments).gap_mm <= digits_mm<S>(program) + 1e-11L);
}

} // namespace

TEMPLATE_TEST_CASE("a chain of short lines becomes few long quintics", "[blended_path][chain]", double, float, Fixed) {
    using S = TestType;
    for (const int count : {500, 2000}) {
        const MoveProgram program = sampled(wave, count, 0.01);
        const BlendedRun<S> run = blended<S>(program);
        CAPTURE(count, run.segments.size());
        CHECK(deviation(program, run.segments, 32).most <= 1.0L);
        CHECK(run.segments.size() < static_cast<std::size_t>(count / 20));
        CHECK(run.counts.chains == 1);
        CHECK(run.counts.moves == static_cast<std::uint64_t>(count));
        CHECK(run.counts.segments == run.segments.size());
        CHECK(run.counts.joints.blended == 0);
        const JointJumps joints = jumps(run.segments);
        CHECK(joints.corners == 0);
        if (!std::same_as<S, float>) {
            CHECK(joints.curvature_corners == 0);
            CHECK(joints.turn < 1e-8L);
        }
        CHECK(run.segments.back().waypoint == static_cast<std::uint32_t>(count - 1));
        CHECK(apart(place_of(run.segments.back(), 1.0L), program.moves.back().to, 3) < 1e-5L);
    }
}

TEMPLATE_TEST_CASE("corners within a chain keep the tolerance with it", "[blended_path][chain]", double, float, Fixed) {
    using S = TestType;
    const MoveProgram program = sampled(
        [](Real t) {
            const Real x = 60.0L * t;
            const Real within = x - 20.0L * std::floor(x / 20.0L);
            return PlaceMm{std::fabs(within - 10.0L), 4.0L * std::sin(x / 4.0L), x / 3.0L};
        },
        600, 0.02);
    const BlendedRun<S> run = blended<S>(program);
    CHECK(deviation(program, run.segments, 64).most <= 1.0L);
    CHECK(run.counts.chains == 6);
    CHECK(run.counts.joints.blended == 5);
    CHECK(jumps(run.segments).corners == 0);
}

TEMPLATE_TEST_CASE("a change of feed within a chain is where it is programmed", "[blended_path][chain]", double,
                   Fixed) {
    using S = TestType;
    MoveProgram program = sampled(wave, 400, 0.01);
    for (std::size_t i = 0; i < program.moves.size(); ++i) {
        program.moves[i].feed_mm_s = i < 150 ? 10.0 : i < 151 ? 20.0 : 30.0;
    }
    const BlendedRun<S> run = blended<S>(program);
    CHECK(run.counts.chains == 1);
    CHECK(jumps(run.segments).corners == 0);
    for (const CurveSegment<S>& segment : run.segments) {
        const double feed = segment.waypoint < 150 ? 10.0 : segment.waypoint < 151 ? 20.0 : 30.0;
        CHECK(to_double(segment.feed_mm_s) == feed);
    }
    CHECK(std::any_of(run.segments.begin(), run.segments.end(), [](const auto& s) { return s.waypoint == 149; }));
    CHECK(std::any_of(run.segments.begin(), run.segments.end(), [](const auto& s) { return s.waypoint == 150; }));
}

TEMPLATE_TEST_CASE("a line, an arc and a line are G2 within a micrometre", "[blended_path]", double, float, Fixed) {
    using S = TestType;
    for (const PathMode mode : {PathMode::continuous, PathMode::exact_path}) {
        MoveProgram program;
        program.start = {-20.0L, 0.0L, 0.0L};
        program.line({});
        program.arc(0.0L, 10.0L, std::numbers::pi_v<Real> / 2.0L);
        program.line({10.0L, 30.0L, 0.0L});
        for (ProgrammedMove& move : program.moves) {
            move.tolerance_mm = mode == PathMode::exact_path ? 0.0 : 0.001;
            move.mode = mode;
        }
        const BlendedRun<S> run = blended<S>(program);
        CHECK(run.counts.joints.blended == 2);
        CHECK(run.counts.joints.stopped == 1);
        CHECK(deviation(program, run.segments, 64).most <= 1.01L);
        const JointJumps joints = jumps(run.segments);
        CHECK(joints.corners == 0);
        if (!std::same_as<S, float>) {
            CHECK(joints.curvature_corners == 0);
        }
    }
}

TEMPLATE_TEST_CASE("stops are where they are programmed, exactly", "[blended_path]", double, float, Fixed) {
    using S = TestType;
    MoveProgram program;
    program.axes = 2;
    program.line({10.0L, 0.0L}).stop_at_end = true; // a dwell
    program.line({10.0L, 10.0L}).mode = PathMode::exact_stop;
    program.line({20.0L, 10.0L});
    program.line({10.0L, 10.0L}); // back: a reversal
    program.line({10.0L, 20.0L}).mode = PathMode::exact_path;
    program.line({10.0L, 30.0L}); // straight on
    program.line({20.0L, 30.0L}).tolerance_mm = 0.0;
    program.line({20.0L, 40.0L});
    const BlendedRun<S> run = blended<S>(program);
    CHECK(run.counts.joints.stopped == 6);
    CHECK(run.counts.joints.through == 1);
    CHECK(run.counts.joints.blended == 1);
    std::size_t flags = 0;
    for (const CurveSegment<S>& segment : run.segments) {
        flags += segment.stop_at_end ? 1U : 0U;
        const auto n = segment.waypoint;
        if (n < 3 || n > 5) {
            CHECK(segment.end == position_of<S>(program.moves[n].to));
        }
    }
    CHECK(flags == 2); // where only the mark says so; a jump of direction is a stop by itself
}

TEMPLATE_TEST_CASE("blends share a short move", "[blended_path]", double, float, Fixed) {
    using S = TestType;
    for (const Real length : {3.0L, 1.0L, 0.3L, 0.1L, 0.03L, 0.01L, 0.003L}) {
        MoveProgram program;
        program.axes = 2;
        program.line({10.0L, 0.0L}).tolerance_mm = 0.1;
        program.line({10.0L, length}).tolerance_mm = 0.1;
        program.line({20.0L, length}).tolerance_mm = 0.1;
        const BlendedRun<S> run = blended<S>(program);
        CAPTURE(static_cast<double>(length));
        require_path(program, run);
        CHECK(jumps(run.segments).corners == 0);
    }
}

TEMPLATE_TEST_CASE("the path is the same whatever the timing of its input", "[blended_path]", double, float, Fixed) {
    using S = TestType;
    for (int round = 0; round < rounds(20); ++round) {
        Random random(seed + static_cast<std::uint64_t>(round));
        const MoveProgram program = round % 3 == 0 ? sampled(wave, 300, 0.01) : random_moves(random);
        const BlendedRun<S> once = blended<S>(program);
        const BlendedRun<S> again = blended<S>(program, seed + 77 + static_cast<std::uint64_t>(round));
        CAPTURE(seed, round);
        REQUIRE(once.segments.size() == again.segments.size());
        for (std::size_t i = 0; i < once.segments.size(); ++i) {
            REQUIRE(once.segments[i].origin == again.segments[i].origin);
            REQUIRE(once.segments[i].control == again.segments[i].control);
            REQUIRE(once.segments[i].waypoint == again.segments[i].waypoint);
        }
    }
}

TEMPLATE_TEST_CASE("a move too short to be one counts at its joint", "[blended_path]", double, float, Fixed) {
    using S = TestType;
    for (const PathMode mode : {PathMode::continuous, PathMode::exact_path}) {
        for (const double tolerance : {0.05, 0.01}) {
            MoveProgram program;
            program.line({10.0L}).tolerance_mm = 0.05;
            program.line({10.0L, 5e-5L}).tolerance_mm = tolerance;
            program.moves.back().mode = mode;
            program.line({10.0L, 10.0L}).tolerance_mm = 0.05;
            const BlendedRun<S> run = blended<S>(program);
            CAPTURE(tolerance, mode == PathMode::continuous);
            CHECK(run.counts.joints.blended == (mode == PathMode::continuous ? 1U : 0U));
            const Deviation found = deviation(program, run.segments, 64);
            CHECK(found.most <= 1.0L);
        }
    }
}

TEMPLATE_TEST_CASE("a short line beside a long one takes nothing of the tolerance", "[blended_path][chain]", double,
                   Fixed) {
    using S = TestType;
    MoveProgram program;
    program.line({36.0L}).tolerance_mm = 0.1;
    program.line({36.0L, 1.0L}).tolerance_mm = 0.1; // its direction may be chance, until the next one is known
    program.line({0.0L, 1.5L}).tolerance_mm = 0.1;
    const BlendedRun<S> run = blended<S>(program);
    CHECK(run.counts.joints.blended == 2);
    CHECK(deviation(program, run.segments, 64).most > 0.99L);
}

TEMPLATE_TEST_CASE("random moves of all kinds are kept within their tolerance", "[blended_path][random]", double, float,
                   Fixed) {
    using S = TestType;
    const int count = rounds(60, 6700); // with three scalars 20,000
    int corners = 0;
    int joints = 0;
    const auto keep = [&](int round) {
        Random random(seed + 1000 + static_cast<std::uint64_t>(round));
        const MoveProgram program = random_moves(random, std::same_as<S, float> ? 20.0L : 2e3L);
        CAPTURE(seed, round, program.axes, program.moves.size());
        if (apart(program.moves.back().to, program.start, program.axes) < 1e-2L) {
            return; // there may be no move that counts
        }
        const BlendedRun<S> run = blended<S>(program);
        require_path(program, run);
        const JointJumps found = jumps(run.segments);
        corners += found.corners;
        joints += static_cast<int>(run.counts.joints.blended);
        REQUIRE(run.counts.joints.stopped >= 1);
    };
    for (int round = 0; round < count; ++round) {
        keep(round);
    }
    // Joints beside arcs between places that are measured, moves that are left out (in 2683 before an arc that is as
    // short), the last point of a chain's piece
    for (const int round : {338, 412, 510, 1185, 2572, 2683, 5593}) {
        keep(round);
    }
    CHECK(joints > count);
    CHECK(corners > 0);
}

TEMPLATE_TEST_CASE("lines of tens of metres in a chain, and arcs as large", "[blended_path][random]", double, Fixed) {
    using S = TestType;
    for (int round = 0; round < rounds(40, 2000); ++round) {
        Random random(seed + 2000000 + static_cast<std::uint64_t>(round));
        MoveProgram program;
        PlaceMm to{};
        Real heading = 0.0L;
        const Real turn = real_decades(random, 1e-6, 1e-2);
        const Real longest = real_decades(random, 1e4, 6.5e4);
        for (int i = 0, count = random.integer(3, 20); i < count; ++i) {
            heading += real_between(random, -1.0, 1.0) * turn;
            const Real length = longest * real_between(random, 0.2, 1.0);
            if (random.chance(0.1)) {
                const Real radius = length * real_between(random, 0.5, 1.0);
                program.arc(to[0] - radius * std::sin(heading), to[1] + radius * std::cos(heading), 0.5L, 0.0L);
                heading += 0.5L;
            } else {
                program.line({to[0] + length * std::cos(heading), to[1] + length * std::sin(heading)});
            }
            to = program.moves.back().to;
            program.moves.back().tolerance_mm = random.chance(0.9) ? 0.5 : 0.05;
        }
        CAPTURE(seed, round, program.moves.size());
        require_path(program, blended<S>(program));
    }
}

TEMPLATE_TEST_CASE("what is made of random moves is run within every limit", "[blended_path][random][jerk]", double,
                   Fixed) {
    using S = TestType;
    for (int round = 0; round < rounds(12, 600); ++round) {
        Random random(seed + 500000 + static_cast<std::uint64_t>(round));
        MoveProgram program = random_moves(random);
        program.axes = std::max(2, program.axes);
        const MachineSettings machine =
            with_jerk(machine_of(program.axes, 100.0, 1000.0, 100.0), round % 2 == 1 ? 0.0 : 30000.0);
        Real length = 0.0L;
        for (const ProgrammedMove& move : program.moves) {
            length += apart(move.from, move.to, program.axes) * (1.0L + std::fabs(move.sweep));
        }
        if (length > 2000.0L) {
            continue;
        }
        CAPTURE(seed, round);
        const Stream stream = stream_of<S>(blended<S>(program).segments, machine, 256);
        require_limits(stream, machine);
    }
}
