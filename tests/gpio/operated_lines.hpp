// SPDX-License-Identifier: MIT
// OperatedLines: a ServedLines that a test operates as people do, and what must hold wherever it stands.
#pragma once

#include "served_lines.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <string>

namespace splinefeed_test {

using namespace splinefeed;

class OperatedLines : public ServedLines {
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
    /// Sends bytes, and waits for what is said to them.
    [[nodiscard]] bool answers(const std::string& bytes, const std::string& what) {
        text.clear();
        send(bytes);
        return says(what);
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
                                    state == ControllerState::hold || state == ControllerState::door);
    }
    /// Begins a long move, and waits until it has full speed.
    void begin_move() {
        go("G90G53G0X10Y10\n");
        send("G1X290Y150F6000\n");
        REQUIRE(comes([this] { return mm(0) > 40.0; }));
    }
    [[nodiscard]] double now_ms() const { return static_cast<double>(clock.now_ns()) * 1e-6; }
    [[nodiscard]] double last_step_ms() { return static_cast<double>(last_step_ns()) * 1e-6; }
    /// The switch of an axis acts from there on: at 1000 wherever the axis of a low one is.
    void place_switch(unsigned axis, double at_mm) {
        switch_mm[axis] = at_mm;
        carriage();
    }
    /// The axes are on the line of begin_move(), but for a count.
    void check_on_line() { CHECK(std::fabs((mm(1) - 10.0) - 0.5 * (mm(0) - 10.0)) < 0.005); }
    /// What is told of each axis is what was counted.
    void check_place() {
        for (const host::RunTarget::AxisPlace& at : served->places()) {
            const double told = at.mm.value_or(-1e6) * 320.0;
            INFO("axis " << at.axis << ": told " << told << ", counted " << counts()[at.axis]);
            CHECK(std::fabs(told - static_cast<double>(counts()[at.axis])) <= 0.5 + 1e-6);
        }
    }
    /// Axes whose place is known, by bits.
    [[nodiscard]] std::uint32_t known() const {
        std::uint32_t out = 0;
        for (const host::RunTarget::AxisPlace& at : served->places()) {
            out |= at.mm ? 1U << at.axis : 0U;
        }
        return out;
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
        REQUIRE(answers("$X\n", "ok"));
    }
};

} // namespace splinefeed_test
