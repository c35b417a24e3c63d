// SPDX-License-Identifier: MIT
// Programs with subprograms in files of their own, and programs that run again, as a user runs them.
#include "support/catch.hpp"
#include "tool.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

using namespace splinefeed::test;
using json = nlohmann::json;

namespace {

double seconds(const Call& call) {
    CAPTURE(call.error);
    REQUIRE(call.status == 0);
    return json::parse(call.output)["cycle_time_s"];
}

std::string error_of(const Tool& tool, const std::string& program) {
    tool.write("part.ngc", program);
    const Call call = tool("run part.ngc --repeat 2");
    CHECK(call.status == 2);
    return call.error;
}

} // namespace

TEST_CASE("Subprograms are read from files beside the program, and from folders that are stated") {
    const Tool tool;
    std::filesystem::create_directories(tool.folder() + "/parts");
    std::filesystem::create_directories(tool.folder() + "/subs");
    tool.write("parts/p.ngc", "G21 F600\no<near> call [3]\no<far> call\nM2\n");
    tool.write("parts/near.ngc", "o<near> sub\n\n\n\n\n\nG1 X#1\no<near> endsub\n");
    tool.write("subs/far.ngc", "o<far> sub\n\n\n\n\n\n\n\nG1 X9\no<near> call [20]\no<far> endsub\n");
    const Call without = tool("plan parts/p.ngc --quiet");
    CHECK(without.status == 2);
    CHECK(without.error ==
          "parts/p.ngc:3:2: there is no subprogram ofar in this program; no file far.ngc is in 'parts'\n");
    const Call call = tool("plan parts/p.ngc --subprograms subs --elements e.json --quiet");
    CAPTURE(call.error);
    REQUIRE(call.status == 0);
    const json elements = json::parse(tool.read("e.json"))["elements"];
    REQUIRE(elements.size() == 3);
    const double ends[] = {3.0, 9.0, 20.0};
    const int lines[] = {2, 3, 3}; // of the calls
    for (unsigned k = 0; k < 3; ++k) {
        CHECK(elements[k]["to"][0].get<double>() == ends[k]);
        CHECK(elements[k]["line_number"].get<int>() == lines[k]);
    }
    const Call piped = tool("plan - --format gcode --subprograms subs --quiet < parts/p.ngc");
    CHECK(piped.error == "-:2:2: there is no subprogram onear in this program; no file near.ngc is in 'subs'\n");
    CHECK(tool("plan - --format gcode --quiet < parts/p.ngc")
              .error.find("; there is no folder to look for near.ngc in") != std::string::npos);
    CHECK(tool("run part.csv --subprograms subs")
              .error.find("splinefeed: --subprograms: only a program in G-code has it") == 0);
    // What a run writes is no subprogram, too.
    CHECK(tool("plan parts/p.ngc --subprograms subs --elements subs/far.ngc --quiet").status != 0);
    CHECK(tool.read("subs/far.ngc").find("G1 X9") != std::string::npos);
}

TEST_CASE("A program that M99 ends runs as often as --repeat says") {
    const Tool tool;
    tool.write("part.ngc", "G21 G91 F600\nG1 X10\nX-10 Y1\nM99\n");
    const double once = seconds(tool("plan part.ngc --quiet --summary json"));
    const double twice = seconds(tool("plan part.ngc --quiet --summary json --repeat 2"));
    CHECK(twice > 1.9 * once);
    CHECK(tool("check part.ngc --repeat 2").output.find("left out") == std::string::npos);
    CHECK(tool("check part.ngc").output.find("M99") != std::string::npos);
    CHECK(error_of(tool, "G1 X1 F600\nM2\n").find("part.ngc:2: --repeat is of a program that M99 ends") == 0);
    CHECK(error_of(tool, "G1 X1 F600\n").find("part.ngc:1: --repeat is of a program that M99 ends") == 0);
}
