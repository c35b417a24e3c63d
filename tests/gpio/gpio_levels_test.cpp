// SPDX-License-Identifier: MIT
//
// Levels count wherever an edge is used: what acts before somebody listens to its edge acts nevertheless.
#include "port_rig.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

TEST_CASE("a run that ends where its probe touches does not begin on it", "[stopping]") {
    TargetRig rig(two_axes(), map_text + "[[input]]\nrole = \"probe\"\nline = 14\n", {.probe = true});
    rig.lines->drive(4, true);
    rig.clock.sleep_us(10'000);
    hal::StraightMotion motion(rig.machine.settings, {}, {10.0, 0.0}, 50.0);
    FeedSegment first;
    REQUIRE(motion.next(first));
    RunTarget& target = *rig.target;
    CHECK(target.port().prepare(first).what == "the probe (line 4) acts; move it off what it touches");
    CHECK(rig.lines->rows().empty());
}

TEST_CASE("an e-stop whose edge was forgotten stops a search by its level", "[stopping]") {
    std::string text = map_text;
    text.insert(text.find("line = 10\n"), "debounce_us = 100000\n");
    TargetRig rig(two_axes(), text, {.orders = {.reset = true, .home = true}});
    hal::StraightMotion motion(rig.machine.settings, {}, {10.0, 0.0}, 50.0);
    FeedSegment first;
    REQUIRE(motion.next(first));
    RunTarget& target = *rig.target;
    rig.lines->drive(e_stop, true);
    rig.clock.sleep_us(10'000);
    REQUIRE_FALSE(target.port().open()); // its level has not lasted yet
    const std::uint64_t began_ns = rig.clock.now_ns();
    CHECK(target.port().prepare(first).what.find("the e-stop was pressed") == 0);
    CHECK_FALSE(rig.lines->enabled());
    CHECK(rig.clock.now_ns() - began_ns < 100'000'000);
}
