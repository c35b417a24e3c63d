// SPDX-License-Identifier: MIT
// GpioMover on a virtual clock: homing, and what ends it.
#include "port_rig.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

TEST_CASE_METHOD(PlainRig, "homing", "[stopping]") {
    lines.drive(e_stop, false);
    int interrupts = 0;
    bool ended = false;
    const auto homed = [&](auto meanwhile, bool finds = false) {
        GpioInputs inputs(map, machine, lines, port, {.clock = &clock});
        GpioMover mover(
            machine, map, inputs, port, [&] { return interrupts; }, [&] { port.quick_stop(); }, clock);
        const auto friendly = clock.start([&] { meanwhile(); });
        mover.forget_position(0);
        std::string what = mover.home();
        ended = true;
        friendly->join();
        CHECK(mover.referenced(0) == finds);                          // whatever ended it
        CHECK((!finds || std::fabs(mover.position(0) - 2.0) < 1e-9)); // pull_off_mm clear of the edge, which is at 0
        port.close();
        return what;
    };
    const auto after_ms = [&](double ms) {
        clock.sleep_us(static_cast<std::uint64_t>(ms * 1000.0));
    };
    SECTION("does not drive on into a limit that acts from the start") {
        lines.drive(limit, true, false);
        CHECK(homed([] {}).find("the limit of axis x (line 1) acts already") != std::string::npos);
        CHECK(lines.rows().empty());
    }
    SECTION("leaves home and limit that act both, and finds its reference") {
        const auto switches = [&] { // home acts below 5 mm of where it stands now, the limit below 2 mm
            const std::int64_t count = port.counts(0);
            const std::array now{std::pair(limit, count < 160), std::pair(home, count < 400)};
            for (const auto& [input, active] : now) {
                if (lines.active(input) != active) {
                    lines.drive(input, active);
                }
            }
        };
        switches();
        const auto carriage = [&] {
            while (!ended) {
                switches();
                clock.sleep_us(500);
            }
        };
        CHECK(homed(carriage, true) == "");
        CHECK(std::llabs(port.counts(0) - 560) <= 2); // the edge, and 2 mm
    }
    SECTION("ends at a limit that begins to act on the way") {
        CHECK(homed([&] {
                  after_ms(500.0);
                  lines.drive(limit, true);
              }).find("the limit of axis x (line 1) acts") != std::string::npos);
    }
    SECTION("is held by the first signal, and stopped at once by the second") {
        double asked_ns = 0.0;
        const bool second = GENERATE(false, true);
        const std::string what = homed([&] {
            after_ms(500.0);
            interrupts = second ? 2 : 1;
            asked_ns = static_cast<double>(clock.now_ns());
        });
        CHECK(what == "axis x does not find its reference: interrupted");
        double last_ns = 0.0;
        for (std::size_t i = 1; i < lines.rows().size(); ++i) {
            if ((~lines.rows()[i - 1].levels & lines.rows()[i].levels & 1U) != 0) {
                last_ns = static_cast<double>(lines.rows()[i].at_ns);
            }
        }
        CHECK(last_ns - asked_ns <= (second ? 42e6 : 80e6)); // 20 mm/s are braked in 20 ms, behind the 50 that are held
        CHECK(last_ns > asked_ns);
    }
}
