// SPDX-License-Identifier: MIT
#include "host_sim/ports/switch_turns.hpp"

#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

namespace {

ProgramPins some_lines() {
    ProgramPins lines;
    lines.mist = SwitchedCoil{0, 1};
    lines.flood = SwitchedPin{};
    lines.outputs = {{3, SwitchedCoil{0, 2}, true}, {5, SwitchedPin{}, false}};
    return lines;
}

} // namespace

TEST_CASE("M9 turns off both kinds of coolant, and an output is turned by its number") {
    const ProgramPins lines = some_lines();
    const auto mist = switch_turns(lines, EventKind::mist_on, 3);
    REQUIRE(mist.size() == 1);
    CHECK((mist[0].line == &*lines.mist && mist[0].on));
    const auto off = switch_turns(lines, EventKind::coolant_off, 3);
    REQUIRE(off.size() == 2);
    CHECK((off[1].line == &*lines.flood && !off[0].on && !off[1].on));
    const auto output = switch_turns(lines, EventKind::output_off_with_motion, 5);
    REQUIRE(output.size() == 1);
    CHECK((output[0].line == &lines.outputs[1].line && !output[0].on));
    CHECK(switch_turns(lines, EventKind::output_on, 4).empty());
    CHECK(switch_turns(lines, EventKind::message, 3).empty());
}

TEST_CASE("Safe is coolant off, and each output as the machine file has it") {
    const ProgramPins lines = some_lines();
    const auto safe = safe_turns(lines);
    REQUIRE(safe.size() == 4);
    CHECK((!safe[0].on && !safe[1].on && safe[2].on && !safe[3].on));
    CHECK(safe[2].line == &lines.outputs[0].line);
    CHECK(safe_turns({}).empty());
}
