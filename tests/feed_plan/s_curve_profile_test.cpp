// SPDX-License-Identifier: MIT
//
// Straight moves with limited jerk: where they end, that they keep their limits, and that none is faster.
#include "splinefeed/s3_feed_plan/jerk/line_travel.hpp"

#include "support/bezier_paths.hpp"
#include "support/catch.hpp"

#include <limits>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

constexpr std::uint64_t seed = 71;

struct Sample {
    double length = 0.0;
    MoveLimits limits;
};

Sample random_sample(Random& random) {
    return {random.decades(1e-5, 1e4), {random.decades(0.1, 1e3), random.decades(1.0, 1e5), random.decades(1e2, 1e9)}};
}

/// The least time by another way: the largest speed from which and to which the way fits, found by bisection.
double least_seconds(const Sample& s) {
    const auto ramp = [&](double v) {
        const double a = std::min(s.limits.acceleration_mm_s2, std::sqrt(v * s.limits.jerk_mm_s3));
        return v / a + a / s.limits.jerk_mm_s3;
    };
    double low = 0.0;
    double high = s.limits.speed_mm_s;
    if (high * ramp(high) <= s.length) {
        return 2.0 * ramp(high) + (s.length - high * ramp(high)) / high;
    }
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (middle * ramp(middle) <= s.length ? low : high) = middle;
    }
    return 2.0 * ramp(low);
}

} // namespace

TEST_CASE("a straight move ends where it should, within its limits, in the least time", "[feed_plan][jerk]") {
    Random random(seed);
    for (int run = 0; run < 20000; ++run) {
        const Sample s = random_sample(random);
        CAPTURE(seed, run, s.length, s.limits.speed_mm_s, s.limits.acceleration_mm_s2, s.limits.jerk_mm_s3);
        const SCurveProfile move(s.length, s.limits);
        MoveState state;
        for (std::size_t i = 0; i < SCurveProfile::phases; ++i) {
            REQUIRE(std::fabs(move.phase(i).jerk_mm_s3) <= s.limits.jerk_mm_s3);
            REQUIRE(move.phase(i).duration_s >= 0.0);
            state = state.after(move.phase(i).duration_s, move.phase(i).jerk_mm_s3);
            REQUIRE(state.speed_mm_s <= s.limits.speed_mm_s * (1.0 + 1e-12));
            REQUIRE(std::fabs(state.acceleration_mm_s2) <= s.limits.acceleration_mm_s2 * (1.0 + 1e-12));
        }
        REQUIRE(std::fabs(state.position_mm - s.length) <= 1e-12 * s.length);
        REQUIRE(std::fabs(state.speed_mm_s) <= 1e-12 * s.limits.speed_mm_s);
        REQUIRE(std::fabs(state.acceleration_mm_s2) <= 1e-12 * s.limits.acceleration_mm_s2);
        REQUIRE(std::fabs(move.duration_s() - least_seconds(s)) <= 1e-9 * move.duration_s());
    }
}

TEST_CASE("travelled piece by piece a straight move is the same", "[feed_plan][jerk]") {
    Random random(seed + 1);
    for (int run = 0; run < 2000; ++run) {
        const Sample s = random_sample(random);
        const SCurveProfile move(s.length, s.limits);
        LineTravel travel(move);
        const int cells = random.integer(1, 12);
        double seconds = 0.0;
        double left_of_all = s.length;
        CAPTURE(seed, run, cells, s.length);
        for (int cell = 0; cell < cells; ++cell) {
            double left = cell + 1 < cells ? left_of_all * random.between(0.0, 0.5) : left_of_all;
            left_of_all -= left;
            const bool last = cell + 1 == cells;
            while (last ? !travel.done() : left > 0.0) {
                const LinePiece piece = last ? travel.next() : travel.next(left);
                REQUIRE(piece.length_mm <= left + 1e-9 * s.length);
                REQUIRE(piece.duration_s >= 0.0);
                left -= piece.length_mm;
                seconds += piece.duration_s;
                // Its law: from the entry's speed to the exit's.
                const double cubic = 1.0 - piece.linear - piece.quadratic;
                REQUIRE(std::fabs(piece.linear * piece.length_mm - piece.entry_mm_s * piece.duration_s) <=
                        1e-9 * s.length);
                REQUIRE(std::fabs((piece.linear + 2.0 * piece.quadratic + 3.0 * cubic) * piece.length_mm -
                                  piece.exit_mm_s * piece.duration_s) <= 1e-9 * s.length);
            }
        }
        REQUIRE(std::fabs(seconds - move.duration_s()) <= 1e-9 * move.duration_s());
    }
}

TEST_CASE("two thirds of a power", "[feed_plan][jerk]") {
    Random random(seed + 2);
    for (int run = 0; run < 1000; ++run) {
        const double x = random.decades(1e-30, 1e30);
        REQUIRE(std::fabs(power_two_thirds(x) / std::cbrt(x * x) - 1.0) <= 1e-14);
    }
    CHECK(power_two_thirds(largest<double>()) > 1e205);
    CHECK(power_two_thirds(std::numeric_limits<double>::infinity()) == std::numeric_limits<double>::infinity());
}

namespace {

/// A state in the middle of a move from rest.
MoveState random_state(Random& random, const Sample& s) {
    const SCurveProfile move(s.length, s.limits);
    MoveState state{};
    double left = random.between(0.0, 1.0) * move.duration_s();
    for (std::size_t i = 0; i < SCurveProfile::phases && left > 0.0; ++i) {
        const double t = std::min(left, move.phase(i).duration_s);
        state = state.after(t, move.phase(i).jerk_mm_s3);
        left -= t;
    }
    return state;
}

void require_within(const SCurveProfile& move, const MoveLimits& limits, double speed_mm_s) {
    MoveState state = move.start();
    const double slack = 1e-7;
    for (std::size_t i = 0; i < SCurveProfile::phases; ++i) {
        const JerkPhase& phase = move.phase(i);
        REQUIRE(phase.duration_s >= 0.0);
        REQUIRE(std::fabs(phase.jerk_mm_s3) <= limits.jerk_mm_s3);
        for (const double share : {0.25, 0.5, 0.75, 1.0}) {
            const MoveState there = state.after(share * phase.duration_s, phase.jerk_mm_s3);
            REQUIRE(std::fabs(there.acceleration_mm_s2) <= limits.acceleration_mm_s2 * (1.0 + slack));
            REQUIRE(there.speed_mm_s <= speed_mm_s * (1.0 + slack));
            REQUIRE(there.speed_mm_s >= -slack * speed_mm_s);
        }
        state = state.after(phase.duration_s, phase.jerk_mm_s3);
    }
    REQUIRE(std::fabs(state.speed_mm_s) <= slack * speed_mm_s);
    REQUIRE(std::fabs(state.acceleration_mm_s2) <= slack * limits.acceleration_mm_s2);
}

} // namespace

TEST_CASE("in motion: the nearest rest, and a rest further on", "[feed_plan][jerk]") {
    Random random(seed + 7);
    for (int run = 0; run < 2000; ++run) {
        Sample s = random_sample(random);
        const MoveState start = random_state(random, s);
        CAPTURE(seed, run, start.speed_mm_s, start.acceleration_mm_s2, s.limits.acceleration_mm_s2,
                s.limits.jerk_mm_s3);
        const SCurveProfile stop = SCurveProfile::to_rest(start, s.limits);
        // The speed rises until the acceleration is taken back
        const double a = std::max(start.acceleration_mm_s2, 0.0);
        const double top = start.speed_mm_s + 0.5 * a * a / s.limits.jerk_mm_s3;
        require_within(stop, s.limits, top);
        // It cannot be nearer than the move that it is part of, nor farther
        CHECK(stop.length_mm() <= (s.length - start.position_mm) * (1.0 + 1e-6) + 1e-9 * s.length);
        // From rest the time to rest is that of a ramp
        const double length = stop.length_mm() + random.decades(1e-4, 10.0) * s.length;
        if (random.chance(0.5)) { // less is wanted
            s.limits.speed_mm_s *= random.between(0.1, 1.0);
        }
        const SCurveProfile on = SCurveProfile::to_length(start, length, s.limits);
        require_within(on, s.limits, std::max(top, s.limits.speed_mm_s));
        REQUIRE(on.length_mm() == Approx(length).epsilon(1e-6));
    }
}

TEST_CASE("in motion: a move that is interrupted for nothing goes on as it was", "[feed_plan][jerk]") {
    Random random(seed + 8);
    for (int run = 0; run < 500; ++run) {
        const Sample s = random_sample(random);
        const SCurveProfile move(s.length, s.limits);
        const MoveState start = random_state(random, s);
        double passed = 0.0;
        MoveState state{};
        for (std::size_t i = 0; i < SCurveProfile::phases && state.position_mm < start.position_mm; ++i) {
            const MoveState end = state.after(move.phase(i).duration_s, move.phase(i).jerk_mm_s3);
            if (end.position_mm > start.position_mm) {
                break;
            }
            state = end;
            passed += move.phase(i).duration_s;
        }
        CAPTURE(seed, run, s.length);
        if (s.length - start.position_mm < 1e-3 * s.length) {
            continue; // the rounding of what is left would be crept along
        }
        const SCurveProfile rest = SCurveProfile::to_length(start, s.length - start.position_mm, s.limits);
        CHECK(passed + rest.duration_s() <= move.duration_s() * (1.0 + 1e-3));
    }
}
