// SPDX-License-Identifier: MIT
//
// The stories of tests/live/shaft_stories.txt on simulated step lines.
#include "live/shaft_teller.hpp"
#include "pins_world.hpp"
#include "support/catch.hpp"

using namespace splinefeed_test;

TEST_CASE("stories of a machine on step lines", "[live]") {
    tell_stories_of<PinsWorld>({"lines"}, 1);
}
