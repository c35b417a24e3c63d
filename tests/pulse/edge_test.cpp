// SPDX-License-Identifier: MIT
#include "splinefeed/s5_pulse_train/edge.hpp"

#include "support/catch.hpp"

using namespace splinefeed;

TEST_CASE("An edge changes the lines of every motor of its axis, each in its polarity") {
    // Two motors, mounted face to face: the second one's direction is inverted; drives that step on a falling edge.
    constexpr LineMasks masks{.step = 0b0011, .direction = 0b1100, .inverted = 0b1011};
    const LineChange up = change_of(masks, Line::direction, true);
    CHECK(up.set == 0b0100);
    CHECK(up.clear == 0b1000);
    const LineChange down = change_of(masks, Line::direction, false);
    CHECK(down.set == 0b1000);
    CHECK(down.clear == 0b0100);
    const LineChange pulse = change_of(masks, Line::step, true);
    CHECK(pulse.set == 0);
    CHECK(pulse.clear == 0b0011);
    CHECK(change_of(masks, Line::step, false).set == 0b0011);
    CHECK(change_of(LineMasks{}, Line::step, true).set == 0);
}
