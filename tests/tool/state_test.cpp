// SPDX-License-Identifier: MIT
// Where the machine stands, and its offsets, from one run to the next.
#include "support/catch.hpp"
#include "support/places.hpp"
#include "support/rounds.hpp"
#include "tool.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

using namespace splinefeed::test;
using json = nlohmann::json;

TEST_CASE("A run begins where the one before ended, with its offsets") {
    const Tool tool;
    tool.write("a.ngc", "G10 L2 P2 X100 Y5\nG0 X10 Y20\nM2\n");
    tool.write("b.ngc", "G55 G0 X1 Y1\nM2\n");
    REQUIRE(tool("run a.ngc --state s.json --quiet").status == 0);
    const json first = json::parse(tool.read("s.json"));
    CHECK(first["position_mm"] == json({10.0, 20.0, 0.0}));
    CHECK(first["work_systems"][1]["origin_mm"] == json({100.0, 5.0, 0.0}));
    REQUIRE(tool("plan b.ngc --state s.json --quiet --elements e.json").status == 0);
    CHECK(json::parse(tool.read("s.json")) == first); // plan changes nothing
    const json elements = json::parse(tool.read("e.json"));
    CHECK(elements["elements"][0]["from"] == json({10.0, 20.0, 0.0}));
    CHECK(elements["elements"][0]["to"] == json({101.0, 6.0, 0.0}));
    REQUIRE(tool("run b.ngc --state s.json --quiet").status == 0);
    CHECK(json::parse(tool.read("s.json"))["position_mm"] == json({101.0, 6.0, 0.0}));
    REQUIRE(tool("run b.ngc --state s.json --position 1,2,3 --quiet --elements e.json").status == 0);
    CHECK(json::parse(tool.read("e.json"))["elements"][0]["from"] == json({1.0, 2.0, 3.0}));
}

TEST_CASE("Every input moves the machine, so the state has where it ends; offsets are of programs and stay") {
    const Tool tool;
    tool.write("a.ngc", "G10 L2 P2 X100 Y5\nG0 X10 Y20\nM2\n");
    tool.write("b.csv", "10,20\n40,30\n");
    REQUIRE(tool("run a.ngc --state s.json --quiet").status == 0);
    json state = json::parse(tool.read("s.json"));
    REQUIRE(tool("run b.csv --state s.json --quiet").status == 0);
    state["position_mm"] = {40.0, 30.0, 0.0};
    CHECK(json::parse(tool.read("s.json")) == state);
    state["position_mm"] = {nullptr, 30.0, 0.0};
    state["position_unknown"] = "the last run did not end";
    tool.write("s.json", state.dump());
    CHECK(tool("run b.csv --state s.json").status == 2);
    CHECK(tool("run b.csv --state s.json --position 10,20,0 --quiet").status == 0);
}

TEST_CASE("A run ends with G54 in effect, a run without M2 as it is") {
    const Tool tool;
    tool.write("a.ngc", "G10 L2 P2 X100\nG55 G0 X10 M30\n");
    REQUIRE(tool("run a.ngc --state s.json --quiet").status == 0);
    const json ended = json::parse(tool.read("s.json"));
    CHECK(ended["position_mm"][0] == 110.0);
    CHECK(ended["active"] == 0);
    tool.write("b.ngc", "G55 G0 X10\n");
    REQUIRE(tool("run b.ngc --state s.json --quiet").status == 0);
    CHECK(json::parse(tool.read("s.json"))["active"] == 1);
}

TEST_CASE("A wrong state, position or program leaves the state as it is") {
    const Tool tool;
    tool.write("a.ngc", "G10 L2 P1 X1\nG0 X10\nG1 Y1\n"); // no F
    tool.write("s.json", "broken");
    CHECK(tool("run a.ngc --state s.json").status == 2);
    CHECK(tool("run a.ngc --state new.json").status == 2);
    CHECK(tool.read("s.json") == "broken");
    CHECK(tool.holds_only("a.ngc s.json"));
    CHECK(tool("run a.ngc --position 1,2").error.find("it must be a number for each axis, x,y,z") != std::string::npos);
    CHECK(tool("run a.ngc --position 1,2,3,4").status == 2);
    for (const char* const command : {"run", "plan", "check"}) {
        const Call far = tool(std::string(command) + " a.ngc --position 0,-1e9,0");
        CHECK(far.status == 2);
        CHECK(far.error ==
              "splinefeed: --position '0,-1e9,0': y is out of range; a position must lie within +-1048576 mm\n");
    }
    CHECK(tool("run a.ngc --state s.json/s.json").error ==
          "s.json/s.json: there is no such folder; name a file in a folder that exists\n");
    tool.write("p.csv", "0,0\n1,1\n");
    CHECK(tool("run p.csv --state s.json").status == 2);
    CHECK(tool.read("s.json") == "broken");
}

TEST_CASE("A place that the state does not know is asked for, and not taken for a number") {
    const Tool tool;
    tool.write("a.ngc", "G0 X10\nM2\n");
    REQUIRE(tool("run a.ngc --state s.json --quiet").status == 0);
    json state = json::parse(tool.read("s.json"));
    state["position_mm"] = {10.0, nullptr, nullptr};
    state["position_unknown"] = "the last run did not end";
    tool.write("s.json", state.dump());
    for (const char* const command : {"run", "plan", "check"}) {
        const Call call = tool(std::string(command) + " a.ngc --state s.json");
        CHECK(call.status == 2);
        CHECK(call.error == "s.json: where y, z stand is not known: the last run did not end; let the machine find its "
                            "references with --home, or say with --position where it stands\n");
    }
    CHECK(json::parse(tool.read("s.json")) == state);
    REQUIRE(tool("run a.ngc --state s.json --position 1,2,3 --quiet").status == 0);
    state = json::parse(tool.read("s.json"));
    CHECK(state["position_mm"] == json({10.0, 2.0, 3.0}));
    CHECK_FALSE(state.contains("position_unknown"));
}

TEST_CASE("A machine that homes first stands at 0, or where --position says, and no longer where the state has it") {
    const Tool tool;
    tool.write("m.toml", path_text(20) + axis_text("x", "travel_mm = [0, 20]\n"));
    tool.write("far.ngc", "G0 X15\nM2\n");
    tool.write("on.ngc", "G91 G0 X10\nM2\n");
    REQUIRE(tool("run far.ngc -m m.toml --state s.json --quiet").status == 0);
    REQUIRE(tool.shell("sed -i 's/\"sim\"/\"modbus-tcp\"/' s.json").status == 0);
    const std::string target = "run on.ngc -m m.toml --state s.json --target modbus-tcp://127.0.0.1:1 ";
    CHECK(tool(target).status == 2);            // 25 mm
    CHECK(tool(target + "--home").status == 1); // nothing but the drive is missing
    CHECK(tool(target + "--home --position 15").status == 2);
    const Call simulated = tool("run on.ngc -m m.toml --home");
    CHECK(simulated.status == 2);
    CHECK(simulated.error.rfind("splinefeed: --home is for machines with switches or drives", 0) == 0);
}

TEST_CASE("A crash while the state is written leaves the old one or the new one") {
    const Tool tool;
    std::string program = "G0 X1\n";
    for (int i = 1; i <= 3000; ++i) {
        program += "G10 L2 P1 X" + std::to_string(i) + " Y" + std::to_string(i) + "\n";
    }
    tool.write("a.ngc", program);
    const int rounds = splinefeed_test::rounds(10, 200);
    int written = 0;
    double slow = 1.0; // a loaded host takes longer until the first state
    for (int i = 0; i < rounds; ++i) {
        const std::string wait = std::to_string(slow * (0.05 + 0.002 * (i * 37 % 100)));
        static_cast<void>(tool.shell("timeout -s KILL " + wait + " '" + tool_path() +
                                     "' run a.ngc --state s.json --quiet >/dev/null || true"));
        const std::string text = tool.read("s.json");
        if (text.empty()) {
            slow = std::min(20.0, 1.5 * slow);
            continue; // killed before the first one
        }
        const json state = json::parse(text, nullptr, false);
        REQUIRE_FALSE(state.is_discarded());
        const json& origin = state["work_systems"][0]["origin_mm"];
        CHECK(origin[0] == origin[1]);
        ++written;
        CHECK(tool("check a.ngc --state s.json").status == 0);
    }
    CHECK(written > 0);
}

TEST_CASE("A state that is a symbolic link stays one, keeps its permissions, and is no other output") {
    const Tool tool;
    tool.write("a.ngc", "G0 X10\nM2\n");
    REQUIRE(tool("run a.ngc --state s.json --trace s.json --quiet").status == 2);
    REQUIRE(tool.holds_only("a.ngc"));
    CHECK(tool("run a.ngc --state a.ngc").error.find("a.ngc: it is the input a.ngc as well, which would be lost") !=
          std::string::npos);
    REQUIRE(tool("run a.ngc --state s.json --quiet").status == 0);
    REQUIRE(tool("run a.ngc --state s.json --trace s.json --quiet").status == 2);
    tool.write("s.json.new", "G0 X10\nM2\n");
    REQUIRE(tool("run s.json.new --format gcode --state s.json --quiet").status == 0);
    CHECK(tool.read("s.json.new") == "G0 X10\nM2\n");
    REQUIRE(tool.shell("chmod 600 s.json && mkdir d && ln -s ../s.json d/link.json").status == 0);
    tool.write("b.ngc", "G0 X20\nM2\n");
    REQUIRE(tool("run b.ngc --state d/link.json --quiet").status == 0);
    CHECK(tool.shell("test -L d/link.json").status == 0);
    CHECK(json::parse(tool.read("s.json"))["position_mm"][0] == 20.0);
    CHECK(tool.shell("stat -c %a s.json").output == "600\n");
}
