// SPDX-License-Identifier: MIT
#include "host_sim/drive/position_generator.hpp"

#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <algorithm>
#include <cmath>
#include <random>

using namespace splinefeed::host;

namespace {

// Time of a move from rest to rest, by its areas.
double trapezoid_s(double distance, const MoveLimits& limits) {
    const double ramps = 0.5 / limits.acceleration + 0.5 / limits.deceleration;
    const double peak = std::min(limits.velocity, std::sqrt(distance / ramps));
    return peak / limits.acceleration + peak / limits.deceleration + (distance - peak * peak * ramps) / peak;
}

} // namespace

TEST_CASE("Position generator: a move from rest to rest is a trapezoid or a triangle") {
    for (const double distance : {1.0, 100.0, 5000.0, 1e6}) {
        for (const double target_sign : {1.0, -1.0}) {
            const MoveLimits limits{20000.0, 100000.0, 300000.0};
            PositionGenerator generator;
            generator.preset_position(7.0);
            generator.move(7.0 + target_sign * distance, limits);
            const double duration_s = trapezoid_s(distance, limits);
            CAPTURE(distance, target_sign, duration_s);
            generator.advance(duration_s * (1.0 - 1e-6));
            CHECK_FALSE(generator.at_rest());
            generator.advance(duration_s * 2e-6);
            CHECK(generator.at_rest());
            CHECK(generator.position_counts() == 7.0 + target_sign * distance);
            CHECK(generator.velocity_counts_s() == 0.0);
        }
    }
}

TEST_CASE("Position generator: a target that moves ahead keeps it cruising, one that is passed is come back to") {
    const MoveLimits limits{10000.0, 100000.0, 100000.0};
    PositionGenerator generator;
    generator.preset_position(0.0);
    for (int i = 1; i <= 20; ++i) {
        generator.move(1000.0 * i + 2000.0, limits);
        generator.advance(0.1);
    }
    CHECK(generator.velocity_counts_s() == 10000.0);
    const double here = generator.position_counts();
    generator.move(here + 100.0, limits); // it needs 500 counts to stop
    generator.advance(0.1);
    CHECK(generator.velocity_counts_s() == Approx(0.0).margin(1e-6));
    CHECK(generator.position_counts() == Approx(here + 500.0));
    generator.advance(1.0);
    CHECK(generator.at_rest());
    CHECK(generator.position_counts() == here + 100.0);
}

TEST_CASE("Position generator: speed 0 is a stop, and a slower one is braked to") {
    PositionGenerator generator;
    generator.preset_position(0.0);
    generator.move(1e6, {10000.0, 1e5, 1e5});
    generator.advance(1.0);
    generator.move(1e6, {4000.0, 1e5, 2e5});
    generator.advance(0.03); // 6000 / 2e5
    CHECK(generator.velocity_counts_s() == Approx(4000.0));
    generator.advance(0.1);
    CHECK(generator.velocity_counts_s() == 4000.0);
    generator.move(1e6, {0.0, 1e5, 1e5});
    generator.advance(0.05);
    CHECK(generator.at_rest());
    CHECK(generator.position_counts() < 1e6);
}

TEST_CASE("Position generator: at random, within its limits, the same in small steps, and at its target") {
    const unsigned seed = splinefeed_test::random_seed();
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const auto uniform = [&random](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int round = 0; round < 200; ++round) {
        PositionGenerator generator;
        PositionGenerator fine;
        generator.preset_position(0.0);
        fine.preset_position(0.0);
        double fastest = 0.0;
        MoveLimits limits;
        double target = 0.0;
        for (int change = 0; change < 8; ++change) {
            limits = {uniform(100.0, 1e5), uniform(1e4, 1e6), uniform(1e4, 1e6)};
            target = uniform(-1e4, 1e4);
            fastest = std::max(fastest, limits.velocity);
            generator.move(target, limits);
            fine.move(target, limits);
            const double steepest = std::max(limits.acceleration, limits.deceleration);
            for (int i = 0; i < 20; ++i) {
                const double step_s = uniform(1e-5, 5e-3);
                const double before = generator.velocity_counts_s();
                const double from = generator.position_counts();
                generator.advance(step_s);
                fine.advance(0.3 * step_s);
                fine.advance(0.7 * step_s);
                REQUIRE(std::fabs(generator.velocity_counts_s() - before) <= steepest * step_s * (1.0 + 1e-9) + 1e-3);
                REQUIRE(std::fabs(generator.velocity_counts_s()) <= fastest * (1.0 + 1e-12));
                REQUIRE(std::fabs(generator.position_counts() - from) <= fastest * step_s * (1.0 + 1e-9) + 1e-6);
                REQUIRE(fine.position_counts() == Approx(generator.position_counts()).margin(1e-3));
            }
        }
        generator.advance(1000.0);
        REQUIRE(generator.at_rest());
        REQUIRE(generator.position_counts() == target);
    }
}

TEST_CASE("Position generator: cyclic targets are lines, and it stands when none comes") {
    PositionGenerator generator;
    generator.preset_position(10.0);
    generator.follow(20.0, 0.002);
    generator.advance(0.001);
    CHECK(generator.position_counts() == Approx(15.0));
    generator.advance(0.001);
    generator.follow(40.0, 0.002);
    generator.advance(0.001);
    CHECK(generator.velocity_counts_s() == Approx(10000.0));
    generator.advance(1.0);
    CHECK(generator.at_rest());
    CHECK(generator.position_counts() == 40.0);
    generator.follow(60.0, 0.002);
    generator.advance(0.001);
    generator.stop(1e7);
    generator.advance(0.0005);
    CHECK_FALSE(generator.at_rest());
    generator.advance(0.0005);
    CHECK(generator.at_rest());
    CHECK(generator.position_counts() == Approx(55.0));
}
