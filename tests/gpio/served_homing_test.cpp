// SPDX-License-Identifier: MIT
//
// A machine on lines that is operated finds its references: which axes are known behind it, and what people are told.
#include "operated_lines.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

using namespace splinefeed;
using namespace splinefeed_test;

TEST_CASE("homing finds its switches from anywhere, and a reset stops it at once", "[serve]") {
    OperatedLines machine(served_map, 0);
    machine.at_start_mm = {30.0, 12.0, -20.0};
    CHECK_FALSE(machine.served->read().known);
    machine.wait(20);
    CHECK(machine.controller->state() == ControllerState::alarm);
    SECTION("all, then one") {
        machine.go("$H\n");
        for (unsigned k = 0; k < 3; ++k) {
            CHECK(machine.mm(k) == Approx(0.0).margin(0.004));
        }
        machine.go("G0 X20 Y10 Z-5\n");
        machine.go("$HY\n");
        CHECK(machine.served->places()[1].mm.value() == Approx(0.0).margin(0.004));
        CHECK(machine.served->places()[0].mm.value() == 20.0);
        CHECK(machine.mm(0) == Approx(20.0).margin(0.004));
        CHECK(machine.mm(1) == Approx(0.0).margin(0.004));
    }
    SECTION("a reset") {
        machine.send("$H\n");
        machine.wait(400);
        const double asked_ms = machine.now_ms();
        machine.send("\x18");
        REQUIRE(machine.says("ALARM:6"));
        machine.wait(400);
        CHECK(machine.last_step_ms() - asked_ms < 120.0);
        machine.check_still();
        CHECK_FALSE(machine.served->read().known);
        machine.unlock();
        machine.go("$H\n");
        CHECK(machine.mm(2) == Approx(0.0).margin(0.004));
    }
    SECTION("a switch that is not there") {
        machine.switch_mm[2] = 1000.0;
        machine.send("$HZ\n");
        REQUIRE(machine.says("ALARM:9"));
        CHECK(machine.text.find("line 2) does not act within 96 mm") != std::string::npos);
        CHECK_FALSE(machine.served->read().known);
    }
}

TEST_CASE("a search makes no other axis known, whatever ends it", "[serve]") {
    const std::uint32_t told = GENERATE(0U, 1U, 2U, 6U, 7U);
    const bool found = GENERATE(false, true);
    CAPTURE(told, found);
    OperatedLines machine(served_map, told);
    machine.at_start_mm[0] = 30.0;
    machine.wait(20);
    machine.send("$HX\n");
    if (found) {
        REQUIRE(machine.says("ok"));
        machine.place_switch(1, 1000.0); // y acts now
        REQUIRE(machine.says("ALARM:1\r"));
    } else {
        machine.wait(400);
    }
    machine.send("\x18");
    REQUIRE(machine.says("Grbl"));
    machine.wait(400);
    CHECK(machine.known() == (found ? told | 1U : told & ~1U));
    SECTION("nor does what the operator unlocks") {
        REQUIRE(machine.answers("$X\n", "ok"));
        machine.go("G91 G0 Z-1\n");
        CHECK(machine.known() == (found ? told | 1U : told & ~1U));
        CHECK(machine.counts()[2] == -320);
    }
}

TEST_CASE("an axis that no search has found stays unknown, whatever moves it", "[serve]") {
    OperatedLines machine(served_map, 0);
    machine.at_start_mm[0] = 30.0;
    machine.go("$HX\n");
    machine.go("$X\nG91 G0 Z-1\n");
    CHECK(machine.known() == 1);
    CHECK(machine.counts()[2] == -320);
    machine.place_switch(1, 1000.0); // y acts: what the lines know is looked at
    REQUIRE(machine.says("ALARM:1\r"));
    CHECK(machine.known() == 1);
}

TEST_CASE("a reset ends a search with one alarm, wherever the axes are, and behind it nothing is left", "[serve]") {
    // Between 370 and 400 ms z has found its switch, and stands on it for a millisecond, between two moves.
    for (int ms = 10; ms < 3000; ms += whole_sweep() || (ms >= 370 && ms < 400) ? 1 : 240) {
        CAPTURE(ms);
        OperatedLines machine(served_map, 0);
        machine.at_start_mm = {10.0, 5.0, -10.0};
        machine.send("$H\n");
        machine.wait(ms);
        REQUIRE(machine.controller->state() == ControllerState::home);
        machine.send("\x18");
        REQUIRE(machine.says("to unlock"));
        machine.wait(500);
        CHECK(machine.text.rfind("ALARM") == machine.text.find("ALARM:6\r"));
        CHECK(machine.served->read().alarm == Alarm::none);
        machine.check_still();
        REQUIRE(machine.answers("$X\n", "ok")); // without another reset
        machine.go("$H\n");
        CHECK(machine.known() == 7);
        CHECK(machine.mm(0) == Approx(0.0).margin(0.004));
    }
}

TEST_CASE("an axis without a home is refused before anything moves, and $H homes the others", "[serve]") {
    std::string map = served_map;
    const std::size_t at = map.find("[home.y]");
    map.erase(at, map.find("[[input]]", at) - at);
    OperatedLines machine(map, 0);
    machine.at_start_mm = {30.0, 12.0, -20.0};
    machine.send("$HXY\n");
    REQUIRE(machine.says("error:5"));
    CHECK(machine.text.find("[MSG:No home of Y: add [home.AXIS] to lines.toml") != std::string::npos);
    machine.wait(500);
    CHECK(machine.counts() == PerAxis<std::int64_t>{});
    machine.go("$H\n");
    CHECK(machine.known() == 5);
    CHECK(machine.counts()[1] == 0);
}

TEST_CASE("a switch that acts all the time moves its axis by a few pull-offs, and no way further", "[serve]") {
    const double from_mm = GENERATE(1.0, 150.0, 290.0);
    OperatedLines machine(served_map, 0);
    machine.at_start_mm[0] = from_mm;
    machine.place_switch(0, 1000.0); // its wire is broken
    REQUIRE(machine.says("ALARM:1\r"));
    machine.unlock();
    machine.text.clear();
    machine.send("$HX\n");
    REQUIRE(machine.says("ALARM:"));
    CHECK(machine.text.find("ALARM:8\r") != std::string::npos);
    CHECK(machine.text.find("the home of axis x (line 0) still acts 10 mm further; look at its wire and `active`") !=
          std::string::npos);
    machine.wait(500);
    CHECK(machine.mm(0) - from_mm == Approx(10.0).margin(0.01));
    machine.check_still();
    CHECK_FALSE(machine.served->read().known);
}

TEST_CASE("a switch that breaks in the search is found to act behind the pull-off", "[serve]") {
    OperatedLines machine(served_map, 0);
    machine.at_start_mm[0] = 30.0;
    machine.wait(20);
    machine.send("$HX\n");
    machine.wait(200);
    machine.switch_mm[0] = 1000.0;
    REQUIRE(machine.says("ALARM:"));
    CHECK(machine.text.find("ALARM:8\r") != std::string::npos);
    CHECK(machine.mm(0) < 32.0);
}
