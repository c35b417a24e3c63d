// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/program_spindle.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

TEST_CASE("A spindle that turns follows S, one that stands does not wait for it") {
    const SpindleDescription machine{.min_rpm = 1000.0, .max_rpm = 10000.0, .ramp_s = 2.0};
    ProgramSpindle spindle;
    CHECK(spindle.take(EventKind::spindle_speed, 5000.0, machine).empty());
    CHECK_FALSE(spindle.turn());
    CHECK(spindle.take(EventKind::spindle_clockwise, 5000.0, machine).empty());
    REQUIRE(spindle.turn());
    CHECK(spindle.turn()->direction == 1);
    CHECK(spindle.turn()->rpm == 5000.0);
    CHECK(spindle.change_s() == 1.0);
    CHECK(spindle.take(EventKind::spindle_speed, 10000.0, machine).empty());
    REQUIRE(spindle.turn());
    CHECK(spindle.turn()->rpm == 10000.0);
    CHECK(spindle.change_s() == 1.0);
    CHECK(spindle.take(EventKind::spindle_counterclockwise, 10000.0, machine).empty());
    CHECK(spindle.turn()->direction == -1);
    CHECK(spindle.change_s() == 4.0);
    CHECK(spindle.take(EventKind::surface_speed, 5000.0, machine).empty());
    CHECK_FALSE(spindle.turn()); // nothing waits for it
    CHECK(spindle.change_s() == 0.0);
    CHECK(spindle.take(EventKind::spindle_speed, 7500.0, machine).empty());
    CHECK(spindle.change_s() == 0.5); // from the speed that it followed to
    CHECK(spindle.take(EventKind::spindle_stop, 0.0, machine).empty());
    CHECK(spindle.turn()->direction == 0);
    CHECK(spindle.take(EventKind::surface_speed, 500.0, machine).empty());
    CHECK(spindle.take(EventKind::spindle_speed, 500.0, machine).empty());
}

TEST_CASE("Speeds that the spindle does not have are refused") {
    const SpindleDescription machine{.min_rpm = 1000.0, .max_rpm = 10000.0};
    ProgramSpindle spindle;
    CHECK(spindle.take(EventKind::spindle_clockwise, 500.0, machine) ==
          "the spindle would turn with S500; S must be at least 1000 and at most 10000, as [spindle] of the machine "
          "file has it, or 0 to stand");
    CHECK_FALSE(spindle.turn());
    CHECK_FALSE(spindle.take(EventKind::spindle_clockwise, 999.0, machine).empty());
    CHECK_FALSE(spindle.take(EventKind::spindle_clockwise, 10001.0, machine).empty());
    CHECK(spindle.take(EventKind::spindle_clockwise, 1000.0, machine).empty());
    CHECK_FALSE(spindle.take(EventKind::surface_speed, 999.0, machine).empty());
    CHECK_FALSE(spindle.take(EventKind::spindle_speed, 999.0, machine).empty());
    ProgramSpindle without_least;
    CHECK(without_least.take(EventKind::spindle_clockwise, 20000.0, {.max_rpm = 10000.0}) ==
          "the spindle would turn with S20000; S must be at most 10000, as [spindle] of the machine file has it, or 0 "
          "to stand");
}

TEST_CASE("With S0 a spindle that is switched on stands, and turns with the next S") {
    const SpindleDescription machine{.min_rpm = 1000.0, .max_rpm = 10000.0, .ramp_s = 2.0};
    ProgramSpindle spindle;
    for (const auto& [on, direction] :
         {std::pair{EventKind::spindle_clockwise, 1}, std::pair{EventKind::spindle_counterclockwise, -1}}) {
        CAPTURE(direction);
        const auto turns = [&](int wanted, double rpm) {
            REQUIRE(spindle.turn());
            CHECK(spindle.turn()->direction == wanted);
            CHECK(spindle.turn()->rpm == rpm);
        };
        CHECK(spindle.take(on, 0.0, machine).empty());
        turns(0, 0.0);
        CHECK(spindle.change_s() == 0.0);
        CHECK(spindle.take(EventKind::spindle_speed, 5000.0, machine).empty());
        turns(direction, 5000.0);
        CHECK(spindle.change_s() == 1.0);
        CHECK(spindle.take(EventKind::spindle_speed, 0.0, machine).empty());
        turns(0, 0.0);
        CHECK(spindle.change_s() == 1.0);
        CHECK(spindle.take(EventKind::spindle_stop, 0.0, machine).empty());
        CHECK(spindle.take(EventKind::spindle_speed, 5000.0, machine).empty());
        CHECK_FALSE(spindle.turn());
    }
}

TEST_CASE("M4 needs an inverter that reverses") {
    SpindleDescription machine{.max_rpm = 10000.0};
    machine.vfd.emplace().profile.name = "one-way";
    ProgramSpindle spindle;
    CHECK(spindle.take(EventKind::spindle_counterclockwise, 5000.0, machine) ==
          "M4: the profile one-way has no command to reverse; use M3");
    CHECK(spindle.take(EventKind::spindle_clockwise, 5000.0, machine).empty());
}

TEST_CASE("M4 needs a line to reverse where the spindle is on lines") {
    SpindleDescription machine{.max_rpm = 10000.0};
    machine.lines.emplace();
    ProgramSpindle spindle;
    CHECK(spindle.take(EventKind::spindle_counterclockwise, 5000.0, machine) ==
          "M4: the spindle has no line to reverse; name it in [spindle.reverse], or use M3");
    machine.lines->reverse.emplace();
    CHECK(spindle.take(EventKind::spindle_counterclockwise, 5000.0, machine).empty());
}
