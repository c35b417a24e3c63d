// SPDX-License-Identifier: MIT
//
// A program on a served machine of lines: how it flows.
#include "live/operated.hpp"
#include "pins_world.hpp"
#include "support/catch.hpp"

#include <cmath>
#include <fmt/format.h>

using namespace splinefeed;
using namespace splinefeed_test;

TEST_CASE("a program that is streamed line by line never waits, and takes as long as a run of it", "[serve]") {
    constexpr double run_ms = 6315.0; // splinefeed run circle.ngc --dialect grbl -m tests/serve/machine.toml
    constexpr int ahead = 20;         // lines that the sender has on their way
    PinsWorld world;
    Operated machine(world);
    std::vector<std::string> program{"G1 F3000\n"};
    for (int n = 0; n < 600; ++n) {
        program.push_back(fmt::format("X{:.3f}Y{:.3f}\n", 40 + 20 * std::cos(n / 50.0), 40 + 20 * std::sin(n / 50.0)));
    }
    std::size_t sent = 0;
    std::size_t answered = 0;
    std::uint64_t first_us = 0;
    std::uint64_t last_us = 0;
    std::uint64_t longest_us = 0;
    for (int ms = 0; ms < 20'000 && (ms < 1000 || machine.controller.state() != ControllerState::idle); ++ms) {
        for (; sent < program.size() && sent < answered + ahead; ++sent) {
            machine.send(program[sent]);
        }
        machine.tick();
        for (; machine.text.rfind("ok\r\n", 0) == 0; machine.text.erase(0, 4)) {
            ++answered;
        }
        world.look();
        if (const std::uint64_t step_us = world.moved_us(); step_us != last_us) {
            longest_us = last_us != 0 ? std::max(longest_us, step_us - last_us) : 0;
            first_us = first_us == 0 ? step_us : first_us;
            last_us = step_us;
        }
    }
    CHECK(answered == program.size());
    CHECK(longest_us < 5000);
    CHECK(std::fabs(static_cast<double>(last_us - first_us) * 1e-3 - run_ms) < 0.01 * run_ms);
}
