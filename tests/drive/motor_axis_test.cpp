// SPDX-License-Identifier: MIT
#include "host_sim/drive/motor_axis.hpp"
#include "support/catch.hpp"

#include <numbers>

using namespace splinefeed::host;

namespace {

constexpr double frequency = 2.0 * std::numbers::pi * 60.0;

/// e'' + 2 z w e' + w^2 e = f by Runge and Kutta, in small steps.
struct Integrated {
    double e = 0.0;
    double rate = 0.0;

    void step(double h, double force, double damping) {
        const auto slope = [&](double x, double v) {
            return force - 2.0 * damping * frequency * v - frequency * frequency * x;
        };
        const double k1 = rate;
        const double a1 = slope(e, rate);
        const double k2 = rate + 0.5 * h * a1;
        const double a2 = slope(e + 0.5 * h * k1, k2);
        const double k3 = rate + 0.5 * h * a2;
        const double a3 = slope(e + 0.5 * h * k2, k3);
        const double k4 = rate + h * a3;
        const double a4 = slope(e + h * k3, k4);
        e += h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
        rate += h * (a1 + 2.0 * a2 + 2.0 * a3 + a4) / 6.0;
    }
};

} // namespace

TEST_CASE("shaft: with full feed-forward it is where its reference is", "[drive][shaft]") {
    MotorAxis shaft;
    shaft.preset_position(1000.0);
    for (int i = 1; i <= 100; ++i) {
        shaft.step(1e-4, 1000.0 + i * i, 2e8);
        CHECK(shaft.position_counts() == 1000.0 + i * i);
    }
    CHECK(shaft.settled());
}

TEST_CASE("shaft: the closed form is the solution of its equation, however time is cut", "[drive][shaft]") {
    for (const double damping : {0.0, 0.2, 0.7, 0.95}) {
        for (const double feed_forward : {0.0, 0.6}) {
            CAPTURE(damping, feed_forward);
            MotorAxis coarse({.bandwidth_hz = 60.0, .damping = damping, .feed_forward = feed_forward});
            MotorAxis fine({.bandwidth_hz = 60.0, .damping = damping, .feed_forward = feed_forward});
            Integrated integrated;
            double reference = 0.0;
            double velocity = 0.0;
            coarse.disturb(-3e4);
            fine.disturb(-3e4);
            for (int i = 0; i < 200; ++i) {
                const double acceleration = i < 80 ? 1e6 : i < 150 ? -4e5 : 0.0;
                constexpr double h = 5e-4;
                for (int part = 1; part <= 10; ++part) {
                    const double t = h * part / 10;
                    fine.step(h / 10, reference + velocity * t + 0.5 * acceleration * t * t, acceleration);
                    integrated.step(h / 10, (1.0 - feed_forward) * acceleration - 3e4, damping);
                }
                reference += velocity * h + 0.5 * acceleration * h * h;
                velocity += acceleration * h;
                coarse.step(h, reference, acceleration);
                REQUIRE(coarse.following_error_counts() == Approx(fine.following_error_counts()).margin(1e-9));
                REQUIRE(coarse.following_error_counts() == Approx(integrated.e).margin(1e-6));
                REQUIRE(coarse.position_counts() == reference - coarse.following_error_counts());
            }
        }
    }
}

TEST_CASE("shaft: a load bends it by f / w^2, and without it it comes to rest", "[drive][shaft]") {
    MotorAxis shaft;
    shaft.preset_position(5.0);
    shaft.disturb(1e5);
    for (int i = 0; i < 10000; ++i) {
        shaft.step(1e-4, 5.0, 0.0);
    }
    CHECK(shaft.following_error_counts() == Approx(1e5 / (frequency * frequency)));
    CHECK_FALSE(shaft.settled());
    shaft.disturb(0.0);
    for (int i = 0; i < 10000; ++i) {
        shaft.step(1e-4, 5.0, 0.0);
    }
    CHECK(shaft.settled());
    CHECK(shaft.position_counts() == 5.0);
}

TEST_CASE("shaft: another reference moves nothing, and let go it stands", "[drive][shaft]") {
    MotorAxis shaft;
    shaft.preset_position(5.0);
    shaft.refer(8.0);
    CHECK(shaft.position_counts() == 5.0);
    CHECK(shaft.following_error_counts() == 3.0);
    shaft.step(1e-3, 8.0, 0.0);
    const double there = shaft.position_counts();
    CHECK(there > 5.0);
    shaft.let_go();
    CHECK(shaft.position_counts() == there);
    CHECK(shaft.settled());
}
