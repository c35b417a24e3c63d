// SPDX-License-Identifier: MIT
#include "host_sim/ports/gpio/pin_outputs.hpp"

#include "host_sim/config/machine_file.hpp"
#include "recorded_chips.hpp"
#include "support/catch.hpp"
#include "support/virtual_clock.hpp"

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

std::string machine_with(const std::string& keys) {
    return "[path]\nmax_feed_mm_s = 80\n[lines]\nchip = '/dev/gpiochip0'\n[spindle]\nmax_rpm = 10000\nspin_up_s = 2\n"
           "spin_down_s = 3\nat_speed_timeout_s = 4\nenable = { line = 'ON', active = 'low' }\n" +
           keys + "\n[[axis]]\nname = 'x'\nmax_velocity_mm_s = 100\nmax_acceleration_mm_s2 = 1000\n";
}

struct Bench {
    explicit Bench(const std::string& keys)
        : machine(parse_machine(machine_with(keys), "m.toml")), chips(machine.lines),
          outputs(pin_outputs(machine, chips.all, clock)) {}

    void pass_ms(int ms) {
        for (int i = 0; i < ms; ++i) {
            clock.sleep_us(1000);
            spindle.update();
        }
    }
    void order(int direction) {
        spindle.act({.kind = EventKind::spindle_clockwise, .text = {}, .spindle = SpindleTurn{direction, 5000.0}});
    }
    [[nodiscard]] std::uint64_t levels() const {
        return chips.chip[0]->rows().empty() ? off : chips.chip[0]->rows().back().levels;
    }
    void at_speed(bool acts) { chips.inputs[0]->now = acts ? 1 : 0; }

    static constexpr std::uint64_t off = 1; // the line that turns it on is low when it acts
    static constexpr std::uint64_t reverse = 2;

    VirtualClock clock;
    MachineDescription machine;
    RecordedChips chips;
    OutputParts outputs;
    OutputPart& spindle = *outputs.front();
};

const std::string reverse_line = "reverse = { line = 'REV' }\n";
const std::string at_speed_line = "at_speed = { line = 'OK' }\n";

} // namespace

TEST_CASE("A spindle on a line is on at once, and has its speed after its time", "[line spindle]") {
    Bench bench("");
    CHECK(bench.spindle.progress().stands);
    CHECK(bench.spindle.progress().carried_out);
    bench.order(1);
    CHECK(bench.levels() == 0);
    CHECK_FALSE(bench.spindle.progress().carried_out);
    CHECK_FALSE(bench.spindle.progress().stands);
    bench.pass_ms(1999);
    CHECK_FALSE(bench.spindle.progress().carried_out);
    bench.pass_ms(1);
    CHECK(bench.spindle.progress().carried_out);
    bench.order(1); // its speed is set elsewhere
    CHECK(bench.spindle.progress().carried_out);
    bench.order(0);
    CHECK(bench.levels() == Bench::off);
    CHECK(bench.spindle.progress().carried_out);
    CHECK_FALSE(bench.spindle.progress().stands);
    bench.order(1); // the same direction: it does not wait for standstill
    bench.pass_ms(1);
    CHECK(bench.levels() == 0);
    bench.order(0);
    bench.pass_ms(2999);
    CHECK_FALSE(bench.spindle.progress().stands);
    bench.pass_ms(1);
    CHECK(bench.spindle.progress().stands);
    CHECK(bench.spindle.trouble().empty());
}

TEST_CASE("It stands before it turns in the other direction, and before its first turn", "[line spindle]") {
    Bench bench(reverse_line);
    bench.order(-1);
    bench.pass_ms(2900); // it may have turned before the run
    CHECK(bench.levels() == Bench::off);
    bench.pass_ms(110);
    CHECK(bench.levels() == (Bench::off | Bench::reverse)); // first the direction
    bench.pass_ms(60);
    CHECK(bench.levels() == Bench::reverse);
    bench.pass_ms(2000);
    REQUIRE(bench.spindle.progress().carried_out);
    bench.order(1);
    CHECK(bench.levels() == (Bench::off | Bench::reverse));
    bench.pass_ms(2990);
    CHECK(bench.levels() == (Bench::off | Bench::reverse));
    CHECK_FALSE(bench.spindle.progress().carried_out);
    bench.pass_ms(100);
    CHECK(bench.levels() == 0);
}

TEST_CASE("The line at_speed is waited for, and its loss is trouble", "[line spindle]") {
    Bench bench(at_speed_line);
    bench.at_speed(true); // it cannot be right yet
    bench.order(1);
    bench.pass_ms(1000);
    CHECK_FALSE(bench.spindle.progress().carried_out);
    bench.at_speed(false);
    bench.pass_ms(2000);
    CHECK_FALSE(bench.spindle.progress().carried_out);
    SECTION("it never acts") {
        bench.pass_ms(3100);
        CHECK(bench.spindle.trouble() ==
              "the spindle has not reached its speed in 6 s: its line at_speed does not act");
    }
    SECTION("it acts, and is lost") {
        bench.at_speed(true);
        bench.pass_ms(1);
        REQUIRE(bench.spindle.progress().carried_out);
        bench.at_speed(false);
        bench.pass_ms(50); // a bounce
        bench.at_speed(true);
        bench.pass_ms(50);
        CHECK(bench.spindle.trouble().empty());
        bench.at_speed(false);
        bench.pass_ms(110);
        CHECK(bench.spindle.trouble() == "the spindle has lost its speed: its line at_speed does not act any more");
    }
    SECTION("it cannot be read") {
        bench.chips.inputs[0]->now.reset();
        bench.pass_ms(1);
        CHECK(bench.spindle.trouble().rfind("the spindle's at_speed line cannot be read", 0) == 0);
    }
    CHECK(bench.levels() == Bench::off);
    bench.order(1);
    bench.pass_ms(100);
    CHECK(bench.levels() == Bench::off);
    CHECK_FALSE(bench.spindle.progress().carried_out);
}

TEST_CASE("Once it was ended it is never turned on again", "[line spindle]") {
    Bench bench("");
    bench.order(1);
    bench.pass_ms(2500);
    bench.spindle.end();
    CHECK(bench.levels() == Bench::off);
    CHECK_FALSE(bench.spindle.progress().stands);
    bench.order(1);
    bench.pass_ms(2990);
    CHECK_FALSE(bench.spindle.progress().stands);
    bench.spindle.end();
    bench.pass_ms(20);
    CHECK(bench.levels() == Bench::off);
    CHECK(bench.spindle.progress().stands);
    CHECK_FALSE(bench.spindle.progress().carried_out);
}

TEST_CASE("A line of the spindle that cannot be set is trouble that names it", "[line spindle]") {
    Bench bench("");
    bench.chips.chip[0]->fail_after(1);
    bench.order(1);
    CHECK(bench.spindle.trouble() == "/dev/gpiochip0 ON cannot be set: No such device");
    CHECK_FALSE(bench.spindle.progress().carried_out);
}

TEST_CASE("A spindle whose line cannot be set any more is not said to stand", "[line spindle]") {
    Bench bench("");
    bench.order(1);
    bench.pass_ms(2500);
    bench.chips.chip[0]->fail_after(1);
    bench.spindle.end();
    bench.pass_ms(10'000);
    CHECK_FALSE(bench.spindle.progress().stands);
    bench.chips.chip[0]->fail_after(0);
    bench.pass_ms(3001);
    CHECK(bench.spindle.progress().stands);
}
