// SPDX-License-Identifier: MIT
//
// A machine on lines that is operated: where it stands is what its lines have counted, whatever happens to it.
#include "served_lines.hpp"
#include "support/catch.hpp"
#include "support/random_path.hpp"
#include "support/rounds.hpp"

#include <fmt/format.h>

using namespace splinefeed;
using namespace splinefeed_test;

namespace {

class Operated : public ServedLines {
public:
    using ServedLines::ServedLines;

    void wait(int ms) {
        for (; ms > 0; --ms) {
            tick();
        }
    }
    template <class Condition>
    [[nodiscard]] bool comes(const Condition& condition, int most_ms = 20'000) {
        for (; most_ms > 0 && !condition(); --most_ms) {
            tick();
        }
        return condition();
    }
    [[nodiscard]] bool says(const std::string& what) {
        return comes([&] { return text.find(what) != std::string::npos; });
    }
    /// Sends lines, and waits until all is done.
    void go(const std::string& program) {
        text.clear();
        send(program);
        tick();
        INFO(program << ": " << text);
        REQUIRE(comes([this] { return rests(); }));
        CHECK(text.find("error") == std::string::npos);
    }
    [[nodiscard]] bool rests() {
        const ControllerState state = controller->state();
        return served->stands() && (state == ControllerState::idle || state == ControllerState::alarm ||
                                    ((state == ControllerState::hold || state == ControllerState::door)));
    }
    /// Begins a long move, and waits until it has full speed.
    void begin_move() {
        go("G90G53G0X10Y10\n");
        send("G1X290Y150F6000\n");
        REQUIRE(comes([this] { return mm(0) > 40.0; }));
    }
    [[nodiscard]] double now_ms() const { return static_cast<double>(clock.now_ns()) * 1e-6; }
    /// What is told of each axis is what was counted.
    void check_place() {
        for (const host::RunTarget::AxisPlace& at : served->places()) {
            const double told = at.mm.value_or(-1e6) * 320.0;
            INFO("axis " << at.axis << ": told " << told << ", counted " << counts()[at.axis]);
            CHECK(std::fabs(told - static_cast<double>(counts()[at.axis])) <= 0.5 + 1e-6);
        }
    }
    void check_still() {
        const std::size_t rows = lines->rows().size();
        const std::uint64_t last_ns = last_step_ns();
        wait(500);
        CHECK(last_step_ns() == last_ns);
        CHECK(lines->rows().size() - rows < 10); // the drives may have been switched
    }
    /// Behind an alarm.
    void unlock() {
        send("\x18");
        wait(50);
        text.clear();
        send("$X\n");
        REQUIRE(says("ok"));
    }
};

} // namespace

TEST_CASE("places between two counts, resets and jogs lose no step", "[serve]") {
    Operated machine;
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
