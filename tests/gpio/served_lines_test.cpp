// SPDX-License-Identifier: MIT
//
// A machine on lines that is operated: where it stands is what its lines have counted, whatever happens to it.
#include "operated_lines.hpp"
#include "support/catch.hpp"
#include "support/random_path.hpp"
#include "support/rounds.hpp"

#include <fmt/format.h>

using namespace splinefeed;
using namespace splinefeed_test;

TEST_CASE("places between two counts, resets and jogs lose no step", "[serve]") {
    OperatedLines machine;
    RandomPath random(4711);
    for (int n = 0; n < rounds(60, 2000); ++n) {
        const double x = (2.0 * random.below(4000) + 1.0) / 640.0; // right in the middle between two counts
        const double y = random.between(0.0, 20.0);
        machine.send(fmt::format("G90 G1 X{:.7f} Y{:.5f} F6000\n", x, y));
        if (random.below(3) == 0) {
            machine.wait(static_cast<int>(random.below(400)));
            machine.send(random.below(2) == 0 ? "\x18" : "!");
            machine.wait(400);
            machine.send("\x18");
        }
        REQUIRE(machine.comes([&] { return machine.rests(); }));
        machine.check_place();
        machine.send(fmt::format("$J=G91 X{:.4f} F6000\n", random.between(-2.0, 2.0)));
        machine.wait(static_cast<int>(random.below(150)));
        machine.send("\x85");
        REQUIRE(machine.comes([&] { return machine.rests(); }));
        machine.check_place();
    }
    machine.go("G90 G0 X0 Y0\n");
    machine.check_place();
    CHECK(machine.counts() == PerAxis<std::int64_t>{});
}

TEST_CASE("stops by wire: on the path, no step after the standstill, and none is lost", "[serve]") {
    struct Way {
        const char* name;
        const char* bytes;
        double most_ms; ///< from the byte to the last step: 90 ms of motion in the port, and the braking
    };
    constexpr std::array ways{Way{"!", "!", 220.0},       Way{"0x18", "\x18", 220.0},       Way{"0x19", "\x19", 220.0},
                              Way{"0x84", "\x84", 220.0}, Way{"0x18 twice", "\x18", 140.0}, Way{"it goes", "", 220.0}};
    OperatedLines machine;
    RandomPath random(2211);
    std::array<double, ways.size()> longest{};
    for (int n = 0; n < rounds(static_cast<int>(4 * ways.size()), 300); ++n) {
        const std::size_t w = static_cast<std::size_t>(n) % ways.size();
        const Way& way = ways[w];
        CAPTURE(n, way.name);
        machine.begin_move();
        machine.wait(static_cast<int>(random.below(1500)));
        const double asked_ms = machine.now_ms();
        if (way.bytes[0] == '\0') {
            machine.controller->disconnect();
        }
        machine.send(way.bytes);
        if (way.most_ms < 200.0) {
            machine.wait(10);
            machine.send("\x18");
        }
        machine.wait(300);
        REQUIRE(machine.rests());
        const double took_ms = machine.last_step_ms() - asked_ms;
        CHECK(took_ms < way.most_ms);
        longest[w] = std::max(longest[w], took_ms);
        machine.check_on_line();
        machine.check_still();
        machine.check_place();
        machine.controller->connect();
        machine.unlock();
    }
    for (std::size_t w = 0; w < ways.size(); ++w) {
        fmt::print("  {:10} standstill after {:.0f} ms at most\n", ways[w].name, longest[w]);
    }
    machine.go("G90 G53 G0 X0 Y0\n");
    CHECK(machine.counts() == PerAxis<std::int64_t>{});
}

TEST_CASE("a jog that is cancelled, and one whose sender is silent, end on their way", "[serve]") {
    OperatedLines machine;
    const bool silent = GENERATE(false, true);
    machine.send("$J=X200Y100F6000\n");
    machine.wait(600);
    const double asked_ms = machine.now_ms();
    if (!silent) {
        machine.send("\x85");
    }
    machine.wait(1000);
    CHECK(machine.controller->state() == ControllerState::idle);
    CHECK(machine.last_step_ms() - asked_ms < (silent ? 620.0 : 220.0));
    machine.check_still();
    machine.check_place();
    CHECK(std::fabs(machine.mm(1) - 0.5 * machine.mm(0)) < 0.005);
}

TEST_CASE("a server that stands still: the axes come to rest on the path, and go on", "[serve]") {
    OperatedLines machine;
    machine.begin_move();
    machine.clock.sleep_us(3'000'000); // no plan comes
    const std::uint64_t last_ns = machine.last_step_ns();
    machine.clock.sleep_us(1'000'000);
    CHECK(machine.last_step_ns() == last_ns);
    machine.check_on_line();
    REQUIRE(machine.comes([&] { return machine.rests(); }));
    CHECK(machine.mm(0) == 290.0);
    machine.check_place();
    CHECK(machine.text.find("ALARM") == std::string::npos);
}

TEST_CASE("the e-stop acts whatever the machine does, and only a reset behind it ends that", "[serve]") {
    OperatedLines machine;
    const int when = GENERATE(0, 1, 2, 3, 4, 5, 6);
    CAPTURE(when);
    switch (when) {
    case 0: machine.wait(20); break;                                           // nothing was moved yet
    case 1: machine.begin_move(); break;                                       // it moves
    case 2: machine.go("G0 X10\n"); break;                                     // it stands, with drives that are on
    case 3: machine.begin_move(), machine.send("!"), machine.wait(400); break; // it is held
    case 4: machine.send("$H\n"), machine.wait(500); break;                    // it homes
    case 5:                                                                    // a limit switch has stopped it
        machine.begin_move();
        machine.switch_mm[0] = 1000.0;
        REQUIRE(machine.says("ALARM:1"));
        machine.wait(300);
        break;
    case 6: machine.begin_move(), machine.clock.sleep_us(20'000); break; // the server does nothing
    }
    const std::uint64_t pressed_ns = machine.clock.now_ns();
    machine.press(ServedLines::e_stop, true);
    machine.clock.sleep_us(1000);
    CHECK_FALSE(machine.lines->enabled());
    const std::uint64_t last_ns = machine.last_step_ns();
    CHECK((last_ns == 0 || last_ns < pressed_ns + 600'000));
    REQUIRE(machine.says("ALARM:10"));
    machine.wait(1500);
    CHECK(machine.last_step_ns() == last_ns);
    REQUIRE(machine.answers("\x18", "ALARM:10")); // it is still pressed
    machine.send("$X\n");
    REQUIRE(machine.says("error:"));
    machine.press(ServedLines::e_stop, false);
    machine.place_switch(0, -2.0);
    machine.wait(500);
    CHECK_FALSE(machine.lines->enabled());
    REQUIRE(machine.answers("$X\n", "error:")); // not without a reset
    machine.send("\x18");
    REQUIRE(machine.says("to unlock"));
    CHECK(machine.last_step_ns() == last_ns);
    CHECK((when == 0 || !machine.served->read().known));
    CHECK_FALSE(machine.lines->enabled());
    REQUIRE(machine.answers("$X\n", "ok"));
    const PerAxis<std::int64_t> before = machine.counts();
    machine.go("G91 G0 Y3\n");
    CHECK(machine.counts()[1] - before[1] == 960);
    CHECK(machine.text.find("ALARM") == std::string::npos);
}

TEST_CASE("a limit switch holds on the path, and its axis may leave it, not go on", "[serve]") {
    OperatedLines machine;
    machine.begin_move();
    machine.switch_mm[0] = 1000.0; // x acts now, wherever it is
    REQUIRE(machine.says("ALARM:1\r"));
    CHECK(machine.text.find("the limit of axis x (line 0) acts: reset, unlock by $X, and jog away from it") !=
          std::string::npos);
    machine.wait(300);
    machine.check_on_line();
    machine.check_still();
    machine.check_place();
    CHECK(machine.lines->enabled());
    const double at_mm = machine.mm(0);
    REQUIRE(machine.answers("$X\n", "error:9"));
    machine.unlock();
    CHECK(machine.served->read().known);
    CHECK((machine.served->read().inputs & 1U) != 0);
    SECTION("further the same way is refused, and moves nothing") {
        const PerAxis<std::int64_t> before = machine.counts();
        machine.send("$J=G91X1F600\n");
        REQUIRE(machine.says("still acts: move away from it"));
        machine.wait(300);
        CHECK(machine.counts() == before);
        machine.unlock();
        machine.go("$J=G91X-1F600\n");
        CHECK(machine.counts()[0] == before[0] - 320);
        machine.check_place();
    }
    SECTION("the other axes move, and it leaves; then the switch stops it again") {
        machine.go("$J=G91Y-5F6000\n");
        machine.switch_mm[0] = -2.0;
        machine.go("$J=G91X-5F6000\n");
        CHECK(machine.mm(0) == Approx(at_mm - 5.0).margin(0.004));
        CHECK(machine.text.find("ALARM") == std::string::npos);
        machine.send("$J=G91X-20F600\n");
        machine.wait(200);
        machine.switch_mm[0] = 1000.0;
        REQUIRE(machine.says("ALARM:1"));
        machine.wait(300);
        machine.check_place();
    }
    SECTION("$H searches behind it") {
        machine.place_switch(0, -2.0);
        machine.go("$H\n");
        CHECK(machine.mm(0) == Approx(0.0).margin(0.004));
    }
}

TEST_CASE("a limit switch that acts while its axis stands behind an alarm is left both ways", "[serve]") {
    OperatedLines machine;
    machine.begin_move();
    machine.press(ServedLines::drive_fault, true);
    REQUIRE(machine.says("ALARM:17"));
    machine.wait(2000);
    machine.place_switch(0, 1000.0);
    machine.wait(100);
    machine.press(ServedLines::drive_fault, false);
    machine.wait(20);
    machine.unlock();
    const PerAxis<std::int64_t> before = machine.counts();
    machine.go("$J=G91X1F600\n");
    machine.go("$J=G91X-2F600\n");
    CHECK(machine.text.find("ALARM") == std::string::npos);
    CHECK(machine.counts()[0] == before[0] - 320);
}

TEST_CASE("a drive that faults in motion stops all axes on the path at once, and one reset ends that", "[serve]") {
    OperatedLines machine;
    machine.begin_move();
    const double asked_ms = machine.now_ms();
    machine.press(ServedLines::drive_fault, true);
    REQUIRE(machine.says("ALARM:17"));
    machine.wait(200);
    CHECK(machine.last_step_ms() - asked_ms < 140.0);
    machine.check_on_line();
    machine.check_place();
    machine.press(ServedLines::drive_fault, false);
    machine.wait(20);
    machine.unlock();
    machine.check_still();
    CHECK(machine.text.find("ALARM") == std::string::npos);
    machine.go("G91 G0 X1\n");
    machine.check_place();
}

TEST_CASE("a limit switch or a drive that faults while the machine stands is an alarm", "[serve]") {
    OperatedLines machine;
    const bool moved = GENERATE(false, true);
    const bool drive = GENERATE(false, true);
    if (moved) {
        machine.go("G0 X10\n");
    }
    const std::size_t input = drive ? ServedLines::drive_fault : ServedLines::limit_of(1);
    if (drive) {
        machine.press(input, true);
    } else {
        machine.place_switch(1, 1000.0);
    }
    REQUIRE(machine.says(drive ? "ALARM:17" : "ALARM:1\r"));
    machine.text.clear();
    machine.send("\x18");
    if (drive) {
        REQUIRE(machine.says("ALARM:17"));
        machine.press(input, false);
        machine.wait(20);
    }
    machine.unlock();
    machine.go("G91 G0 X1 Y1\n");
    CHECK(machine.served->read().known);
    machine.check_place();
    CHECK(machine.counts()[0] == (moved ? 3520 : 320));
}

TEST_CASE("sleep switches the drives off, and the place is lost; the end does as the machine file says", "[serve]") {
    OperatedLines machine;
    machine.go("G0 X10\n");
    machine.text.clear();
    machine.send("$SLP\n");
    machine.wait(50);
    CHECK_FALSE(machine.lines->enabled());
    CHECK_FALSE(machine.served->places()[0].mm.has_value());
    machine.unlock();
    machine.go("G91 G0 X1\n");
    CHECK(machine.lines->enabled());
    CHECK(machine.known() == 0); // a search alone ends that
    CHECK(machine.counts()[0] == 3520);
    CHECK(machine.served->finish().empty());
    CHECK_FALSE(machine.lines->enabled());
}

TEST_CASE("what a map lacks is refused with the file and its key", "[serve]") {
    std::string map = served_map;
    for (const char axis : {'x', 'y', 'z'}) {
        const std::size_t at = map.find("[home." + std::string(1, axis));
        map.erase(at, map.find("[[input]]", at) - at);
    }
    for (std::size_t at = 0; (at = map.find("[[input]]\nrole = \"home\"")) != std::string::npos;) {
        map.erase(at, map.find("[[input]]", at + 9) - at);
    }
    map.erase(map.rfind("[[input]]"));
    OperatedLines machine(map);
    machine.send("$H\nG38.2 Z-5 F100\n");
    REQUIRE(machine.says("error:20"));
    CHECK(machine.text ==
          "[MSG:No home of X, Y, Z: add [home.AXIS] to lines.toml, and an [[input]] with role = \"home\"]\r\n"
          "error:5\r\n[MSG:The machine has no probe]\r\nerror:20\r\n");
    CHECK(machine.settings.has_limits);
}

TEST_CASE("behind an e-stop, or a line that fails, the last steps are the place that is told", "[serve]") {
    OperatedLines machine;
    const bool fails = GENERATE(false, true);
    machine.begin_move();
    machine.wait(17); // beside the looks, which are 40 ms apart
    if (fails) {
        machine.lines->fail(true);
    } else {
        machine.press(ServedLines::e_stop, true);
    }
    REQUIRE(machine.says("ALARM:"));
    machine.wait(100);
    const PerAxis<Position> at = machine.served->read().position;
    for (unsigned k = 0; k < 2; ++k) {
        const double told = to_mm(at[k]) * 320.0;
        CHECK(std::fabs(told - static_cast<double>(machine.counts()[k])) <= 1.0 + 1e-6);
    }
    CHECK_FALSE(machine.served->read().known);
    CHECK(machine.known() == 0);
}

TEST_CASE("drives that cannot be disabled are named, in the alarm and at the end", "[serve]") {
    OperatedLines machine;
    machine.begin_move();
    machine.lines->fail(true);
    REQUIRE(machine.says("ALARM:17"));
    CHECK(machine.text.find("a line cannot be set: No such device: the drives of x, y, z could not be disabled") !=
          std::string::npos);
    CHECK(machine.served->finish() == "the drives of x, y, z may still be on: switch their power off");
}
