// SPDX-License-Identifier: MIT
#include "host_sim/program/gcode/saved_modes.hpp"

#include "support/catch.hpp"

#include "splinefeed/s0_program/interpreter.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

const std::vector<std::string> axes{"x", "y", "z"};

class Program {
public:
    Program() { interpreter_.start({}); }
    SavedModes run(const std::vector<std::string>& lines, CoolantState coolant = {}) {
        for (const std::string& line : lines) {
            CAPTURE(line);
            REQUIRE(interpreter_.push(line, 1).ok());
            ProgramItem<double> item;
            while (interpreter_.next(item) == Pull::item) {
                if (item.kind == ItemKind::event && item.event.kind == EventKind::mist_on) {
                    coolant.mist = true;
                } else if (item.kind == ItemKind::event && item.event.kind == EventKind::flood_on) {
                    coolant.flood = true;
                } else if (item.kind == ItemKind::event && item.event.kind == EventKind::coolant_off) {
                    coolant = {};
                }
            }
        }
        return {interpreter_.modal(), interpreter_.offsets(), coolant};
    }

private:
    Interpreter<double> interpreter_{ProgramSettings{}};
};

} // namespace

TEST_CASE("modes that are the same need no line") {
    const SavedModes modes = Program().run({"G20 G91 F10 S100 M3", "G55"});
    CHECK(restoring_lines(modes, modes, axes).empty());
}

TEST_CASE("the lines put back all modes but the motion") {
    const std::vector<std::string> states[] = {
        {},
        {"G20 G18 G91 G90.1 G99 G64 P0.01 Q0.001", "F12.5 S1000 M3", "G55", "G43.1 Z1.25", "M7", "M8"},
        {"G61 G94 F100 S0.5 M4", "G59.3", "G43.1 X1 Y-2.5", "M8"},
        {"G20 F3", "G21 G61.1", "G92 X5", "G92.2", "M7"}, // F was in inches
        {"G93 G1 X1 F2", "G19"},
        {"G95 G7 F0.02"},
        {"G96 D2000 S100 M3"},
        {"G20 G64 P0.01 Q0.001", "G96 S300 G95 F0.01"},
        {"G17 G94 G41.1 D1", "G0 X10"},
    };
    for (const auto& before : states) {
        for (const auto& after : states) {
            if (!before.empty() && before[0].find("G41.1") != std::string::npos) {
                continue; // no other words go with it
            }
            Program program;
            SavedModes saved = program.run(before);
            const SavedModes other = program.run(after, saved.coolant);
            const SavedModes now = program.run(restoring_lines(saved, other, axes), other.coolant);
            if (saved.modal.feed.raw == 0 || saved.modal.inverse_time) { // F is of a block, or 0
                saved.modal.feed = now.modal.feed;
            }
            saved.modal.motion = now.modal.motion;
            saved.modal.feed_in_inches = now.modal.feed_in_inches;
            saved.modal.needs_straight = now.modal.needs_straight;
            saved.modal.cutter = now.modal.cutter;
            CHECK(now.modal.cutter.side == 0);
            CHECK(now.modal == saved.modal);
            CHECK(now.offsets.active == saved.offsets.active);
            CHECK(now.offsets.tool == saved.offsets.tool);
            CHECK(now.offsets.g92_applies == saved.offsets.g92_applies);
            CHECK(now.coolant.mist == saved.coolant.mist);
            CHECK(now.coolant.flood == saved.coolant.flood);
        }
    }
}

TEST_CASE("they say what differs, and no more") {
    Program program;
    const SavedModes saved = program.run({"G21 G90 F600"});
    CHECK(restoring_lines(saved, program.run({"G20 G91"}), axes) == std::vector<std::string>{"G21", "G90 "});
    CHECK(restoring_lines(saved, program.run({"G21 G90 F5 M3"}), axes) ==
          std::vector<std::string>{"F600.000000000 ", "S0.000000000 M5"});
}
