// SPDX-License-Identifier: MIT
// A machine that moves is never left without motion, however late lines come.
#include "support/catch.hpp"
#include "support/virtual_machine_tool.hpp"

#include <fmt/format.h>
#include <string>

using namespace splinefeed;
using namespace splinefeed::test;

TEST_CASE("a machine that has reached the last known line brakes there, and does not wait in motion", "[controller]") {
    const int gap_ms = GENERATE(30, 90, 150); // a motion begins behind a pause of 100 ms
    const std::string mode = GENERATE("G64 P0.05", "G61");
    const int zig = GENERATE(0, 1);
    CAPTURE(gap_ms, mode, zig);
    ControlledTool<Fixed> tool;
    int line = 0;
    const auto send = [&] {
        ++line;
        tool.send(fmt::format("G1X{}Y{}F3000\n", line, zig * (line % 2))); // 20 or 28 ms of motion
    };
    tool.send(fmt::format("{}\n", mode));
    while (line < 8) {
        send();
    }
    int left_alone = 0;
    int due_ms = 0;
    for (int ms = 0; ms < 12'000 && tool.machine.position()[0] != position_from_mm(60.0); ++ms) {
        const double before = tool.machine.distance_mm();
        if (tool.controller->state() == ControllerState::run && line < 60 && ++due_ms % gap_ms == 0) {
            send();
        }
        tool.tick();
        left_alone += tool.machine.moves() && tool.machine.distance_mm() == before ? 1 : 0;
    }
    CHECK(tool.machine.position()[0] == position_from_mm(60.0));
    CHECK(left_alone == 0);
}
