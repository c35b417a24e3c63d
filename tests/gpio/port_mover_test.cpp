// SPDX-License-Identifier: MIT
// PortMover on a virtual clock: homing, and what ends it.
#include "port_rig.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

bool asked_to_end = false; // of one test at a time

} // namespace

TEST_CASE_METHOD(PlainRig, "homing", "[stopping]") {
    lines.drive(e_stop, false);
    asked_to_end = false;
    bool ended = false;
    hal::gpio::GpioPortSettings settings = gpio_port_settings(machine, map, {}, &clock);
    settings.interrupted = [] {
        return asked_to_end;
    };
    hal::Remedy remedy = hal::Remedy::none;
    const auto homed = [&](const auto& meanwhile, bool finds = false) {
        hal::gpio::SwitchInputs inputs(map, settings, lines, port);
        hal::gpio::PortMover mover(map, settings, inputs, port);
        const auto friendly = clock.start([&] { meanwhile(); });
        clock.sleep_us(20'000);
        const hal::PortFailure failure = mover.home(1);
        remedy = failure.remedy;
        ended = true;
        friendly->join();
        CHECK((mover.origin(0) == hal::gpio::Origin::known) == finds); // whatever ended it
        CHECK((!finds || std::fabs(mover.position(0) - 2.0) < 1e-9));  // pull_off_mm clear of the edge, which is at 0
        port.close();
        return failure.what;
    };
    const auto after_ms = [&](double ms) {
        clock.sleep_us(static_cast<std::uint64_t>(ms * 1000.0));
    };
    SECTION("does not drive on into a limit that acts from the start") {
        lines.drive(limit, true, false);
        CHECK(homed([] {}).find("the limit of axis x (line 1) acts already") != std::string::npos);
        CHECK(lines.rows().empty());
    }
    const auto switches = [&] { // home acts below 5 mm of where it stood at first, the limit below 2 mm
        const std::int64_t count = port.counts(0);
        const std::array now{std::pair(limit, count < 160), std::pair(home, count < 400)};
        for (const auto& [input, active] : now) {
            if (lines.active(input) != active) {
                lines.drive(input, active);
            }
        }
    };
    const auto carriage = [&] {
        while (!ended) {
            switches();
            clock.sleep_us(500);
        }
    };
    SECTION("leaves home and limit that act both, and finds its reference") {
        switches();
        CHECK(homed(carriage, true) == "");
        CHECK(std::llabs(port.counts(0) - 560) <= 2); // the edge, and 2 mm
    }
    SECTION("does not take a change from before for its switch") {
        const auto spiked = [&] {
            lines.drive(home, true);
            clock.sleep_us(5'000);
            lines.drive(home, false);
            clock.sleep_us(5'000);
            while (!ended) { // 10 mm further down
                const bool active = port.counts(0) < -800;
                if (lines.active(home) != active) {
                    lines.drive(home, active);
                }
                clock.sleep_us(500);
            }
        };
        CHECK(homed(spiked, true) == "");
        CHECK(std::llabs(port.counts(0) + 640) <= 2);
    }
    SECTION("gives up on a switch that always acts, behind five pull-offs") {
        lines.drive(home, true, false);
        CHECK(
            homed([] {}).find("the home of axis x (line 2) still acts 10 mm further; look at its wire and `active`") !=
            std::string::npos);
        CHECK(remedy == hal::Remedy::clear_switch);
        CHECK(port.counts(0) == 800);
    }
    SECTION("ends at a limit that begins to act on the way") {
        CHECK(homed([&] {
                  after_ms(500.0);
                  lines.drive(limit, true);
              }).find("the limit of axis x (line 1) acts") != std::string::npos);
    }
    SECTION("is stopped by the port at a signal") {
        double asked_ns = 0.0;
        const std::string what = homed([&] {
            after_ms(500.0);
            asked_to_end = true;
            asked_ns = static_cast<double>(clock.now_ns());
        });
        CHECK(what == "axis x does not find its reference: interrupted");
        double last_ns = 0.0;
        for (std::size_t i = 1; i < lines.rows().size(); ++i) {
            if ((~lines.rows()[i - 1].levels & lines.rows()[i].levels & 1U) != 0) {
                last_ns = static_cast<double>(lines.rows()[i].at_ns);
            }
        }
        CHECK(last_ns - asked_ns <= 42e6); // 20 mm/s are braked in 20 ms, and the port takes 40
        CHECK(last_ns > asked_ns);
    }
}
