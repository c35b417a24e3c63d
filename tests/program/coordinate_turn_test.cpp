// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/coordinate_turn.hpp"

#include "support/gcode.hpp"
#include "support/rounds.hpp"

#include <cmath>
#include <complex>
#include <random>

using namespace splinefeed_test;

namespace {

using Point = CoordinateTurn::Point;

Decimal decimal(double value) {
    return {static_cast<std::int64_t>(std::llround(value * 1e9))};
}

} // namespace

TEST_CASE("points are mirrored, scaled and turned as complex numbers are", "[program][turn]") {
    const unsigned seed = std::random_device{}();
    CAPTURE(seed);
    std::mt19937_64 random(seed);
    const auto any = [&](double most) {
        return std::uniform_real_distribution<double>(-most, most)(random);
    };
    for (int i = 0; i < rounds(2000); ++i) {
        CoordinateTurn turn;
        Point centre{};
        Point about{};
        Point point{};
        for (unsigned k = 0; k < 3; ++k) {
            centre[k] = decimal(any(300));
            about[k] = decimal(any(300));
            point[k] = decimal(any(1000));
        }
        const double angle = any(720);
        const double factor = std::exp(any(2.3));
        const bool scales = i % 2 == 0;
        const unsigned first = static_cast<unsigned>(i) % 3;
        const unsigned second = (first + 1) % 3;
        if (scales) {
            turn.scale(7, centre, decimal(factor));
        }
        turn.rotate(first, second, about, decimal(angle));
        const auto complex = [&](const Point& of) {
            return std::complex<double>(number(of[first]), number(of[second]));
        };
        const auto scaled = [&](std::complex<double> of) {
            return scales ? complex(centre) + number(decimal(factor)) * (of - complex(centre)) : of;
        };
        const std::complex<double> wanted =
            scaled(complex(about)) +
            std::polar(1.0, number(decimal(angle)) * M_PI / 180.0) * (scaled(complex(point)) - scaled(complex(about)));
        Point out = point;
        turn.apply(out);
        CHECK(std::abs(complex(out) - wanted) < 4e-9);
        turn.undo(out);
        for (unsigned k = 0; k < 3; ++k) {
            CHECK(std::fabs(number(out[k]) - number(point[k])) < 3e-9 * (scales ? std::max(1.0, 1.0 / factor) : 1.0));
        }
    }
}

TEST_CASE("a mirror of one axis of the plane turns arcs round, of both it does not", "[program][turn]") {
    CoordinateTurn turn;
    Decimal radius = decimal(5);
    const auto sweep = [&] {
        Decimal out = decimal(90);
        CHECK(turn.apply_to_arc(radius, out));
        return out;
    };
    turn.mirror(0, decimal(10), true);
    CHECK(sweep() == decimal(-90));
    Point point{decimal(3), decimal(4), decimal(5)};
    turn.apply(point);
    CHECK(point[0] == decimal(17));
    turn.mirror(0, decimal(20), true); // again: another place
    CHECK(sweep() == decimal(-90));
    turn.mirror(1, decimal(0), true);
    turn.mirror(2, decimal(0), false);
    CHECK(sweep() == decimal(90));
    turn.end_mirror(0);
    CHECK(sweep() == decimal(-90));
    CHECK(turn.axes() == 6);
    CHECK(radius == decimal(5));
}

TEST_CASE("an arc that a scale makes too small is none", "[program][turn]") {
    CoordinateTurn turn;
    turn.scale(7, {}, decimal(0.01));
    Decimal radius = decimal(0.02);
    Decimal sweep = decimal(90);
    CHECK(turn.apply_to_arc(radius, sweep));
    CHECK(radius == decimal(0.0002));
    CHECK_FALSE(turn.apply_to_arc(radius, sweep));
}

TEST_CASE("a whole turn is none, and two rotations may have one centre", "[program][turn]") {
    CoordinateTurn turn;
    turn.rotate(0, 1, {decimal(1), decimal(2), {}}, decimal(360));
    CHECK_FALSE(turn.applies());
    turn.rotate(0, 1, {decimal(1), decimal(2), decimal(3)}, decimal(30));
    CHECK(turn.axes() == 3);
    CHECK(turn.couples(0));
    CHECK(turn.other(0) == 1);
    CHECK_FALSE(turn.couples(2));
    CoordinateTurn other;
    other.rotate(0, 1, {decimal(1), decimal(2), decimal(4)}, decimal(60));
    CHECK(turn.is_about(other));
    other.rotate(0, 1, {decimal(1), decimal(3), decimal(3)}, decimal(60));
    CHECK_FALSE(turn.is_about(other));
    turn.end_rotation();
    CHECK_FALSE(turn.applies());
}
