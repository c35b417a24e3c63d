// SPDX-License-Identifier: MIT
// --edges on the command line: whole or not at all, of run and of plan.
#include "support/catch.hpp"
#include "tool.hpp"

using splinefeed::test::Call;
using splinefeed::test::Tool;

namespace {

const std::string line = "x,y,z\n0,0,0\n1,0,0\n";

} // namespace

TEST_CASE("Edges hold as many steps as the way has counts, from run and from plan") {
    const Tool tool;
    tool.write("line.csv", line);
    for (const std::string command : {"run", "plan"}) {
        const Call call = tool(command + " line.csv --edges e.csv --quiet");
        CAPTURE(call.error);
        REQUIRE(call.status == 0);
        const std::string text = tool.read("e.csv");
        REQUIRE(text.rfind("t_ns,axis,line,value\n", 0) == 0);
        std::size_t steps = 0;
        for (std::size_t at = 0; (at = text.find(",x,step,1\n", at)) != std::string::npos; ++at) {
            ++steps;
        }
        CHECK(steps == 320);
        CHECK(text.find(",y,") == std::string::npos);
    }
    const Call shown = tool("run line.csv --edges - --quiet");
    CHECK(shown.output == tool.read("e.csv"));
    CHECK(tool("run line.csv --edges t.csv --trace t.csv").error.find("both go to 't.csv'") != std::string::npos);
}

TEST_CASE("Lines that are too slow for the machine are refused, and nothing is written") {
    const Tool tool;
    tool.write("line.csv", line);
    tool.write(
        "m.toml",
        "[step]\nstep_length_us = 40\n[path]\nmax_feed_mm_s = 100\n[[axis]]\nname = 'x'\nmax_velocity_mm_s = 100\n"
        "max_acceleration_mm_s2 = 1000\nsteps_per_mm = 320\n");
    tool.write("line1.csv", "x\n0\n1\n");
    const Call call = tool("run line1.csv -m m.toml --edges e.csv --trace t.csv");
    CHECK(call.status == 2);
    CHECK(call.output.empty());
    CHECK(call.error.find("m.toml: axis x makes 32000 steps/s at 100 mm/s, and its lines carry 23669; ") == 0);
    CHECK(tool.holds_only("line.csv line1.csv m.toml"));
    CHECK(tool("run line1.csv -m m.toml --trace t.csv --quiet").status == 0); // without edges nobody asks
}
