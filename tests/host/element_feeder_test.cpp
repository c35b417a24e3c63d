// SPDX-License-Identifier: MIT
#include "host_sim/planning/element_feeder.hpp"

#include "support/catch.hpp"
#include "temporary_folder.hpp"

#include "splinefeed/move_stream/scalar_stream.hpp"

#include <fstream>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

/// What a feeder does with a program: "S" start, "m" a move, "|" the machine stands behind the moves so far, "e" event,
/// "d" dwell.
std::string steps_of(const std::string& program) {
    const TemporaryFolder folder;
    std::ofstream(folder.file("p.ngc")) << program;
    PathArguments arguments;
    arguments.input = folder.file("p.ngc");
    arguments.format = input_format("gcode");
    PathInput input(arguments, PathUse::executed, {.axes = {"x", "y", "z"}});
    ScalarStream<double> stream(3, rules_cast<double>(input.tolerances().rules), nullptr);
    ElementFeeder feeder(input, stream);
    PathFeeder::Pushed pushed;
    std::string out;
    CurveSegment<double> segment;
    while (feeder.more(pushed)) {
        out += pushed.start ? "S" : "";
        out += pushed.stops ? "|" : "";
        out += pushed.move != nullptr ? "m" : "";
        out += pushed.step == nullptr ? "" : pushed.step->kind == StepKind::dwell ? "d" : "e";
        CHECK(stream.has_room() == (pushed.step == nullptr || !pushed.step->stops));
        stream.go_on();
        while (stream.curve().next(segment) == Pull::item) {
        }
    }
    return out;
}

} // namespace

TEST_CASE("A program's moves and what comes between them, in order") {
    CHECK(steps_of("G1 X1 F600\nX2\nX3\n") == "Smmm");
    CHECK(steps_of("G1 X1 F600\nG4 P1\nX3\n") == "Sm|dm");
    CHECK(steps_of("G1 X1 F600\n(MSG,a)\nX3\nM2\n") == "Smem|e");
    CHECK(steps_of("G1 X1 F600\nX1\nX1.00000001\nM0\nX3\n") == "Sm|em"); // moves without length are none
    CHECK(steps_of("M3 S1\nG4 P1\n") == "S|e|e|d");
    CHECK(steps_of("").substr(0, 1) == "S");
}

TEST_CASE("What does not stop the machine does not hide what does") {
    CHECK(steps_of("G1 X1 F600\n(MSG,a)\nG4 P1\nX3\n") == "Sme|dm");
    CHECK(steps_of("G1 X1 F600\nM64 P0\nX2\nM64 P1\nX3\n") == "Smemem");
    CHECK(steps_of("G1 X1 F600\nM64 P0\nM64 P1\n") == "Smee");
}

TEST_CASE("Events behind a move that waits are bounded: the machine stops there, and they happen") {
    std::string program = "G1 X1 F600\n";
    std::string expected = "Sm";
    for (std::size_t i = 1; i <= 1000; ++i) {
        program += "M64 P0\n";
        expected += i % ElementFeeder::most_behind == 0 ? "|e" : "e";
    }
    CHECK(steps_of(program + "G4 P1\nX3\n") == expected + "|dm");
}
