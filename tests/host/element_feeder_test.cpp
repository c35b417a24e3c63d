// SPDX-License-Identifier: MIT
#include "host_sim/planning/element_feeder.hpp"

#include "host_sim/planning/path_curve.hpp"
#include "support/catch.hpp"
#include "temporary_folder.hpp"

#include <fstream>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

/// What a feeder does with a program: "S" start, "m" a move, "M" one with a stop, "e" event, "d" dwell, "." nothing,
/// "r" and "R" a move that was released.
std::string steps_of(const std::string& program, std::size_t release_at = 1000) {
    const TemporaryFolder folder;
    std::ofstream(folder.file("p.ngc")) << program;
    PathArguments arguments;
    arguments.input = folder.file("p.ngc");
    arguments.format = input_format("gcode");
    PathInput input(arguments, PathUse::executed, {.axes = {"x", "y", "z"}});
    PathCurve<double> curve(input);
    ElementFeeder feeder(input, curve);
    PathFeeder::Pushed pushed;
    std::string out;
    CurveSegment<double> segment;
    for (;;) {
        if (out.size() == release_at && feeder.release(pushed)) {
            out += pushed.move->move.stop_at_end ? 'R' : 'r';
        }
        if (!feeder.more(pushed)) {
            return out;
        }
        if (pushed.start) {
            out += 'S';
        }
        if (pushed.move != nullptr) {
            out += pushed.move->move.stop_at_end ? 'M' : 'm';
        }
        if (pushed.step != nullptr) {
            out += pushed.step->kind == StepKind::dwell ? 'd' : 'e';
        }
        if (!pushed.start && pushed.move == nullptr && pushed.step == nullptr) {
            out += '.';
        }
        while (curve.source().next(segment) == Pull::item) {
        }
    }
}

std::string without_pauses(std::string steps) {
    steps.erase(std::remove(steps.begin(), steps.end(), '.'), steps.end());
    return steps;
}

} // namespace

TEST_CASE("A move waits until it is known whether the machine stops at its end") {
    CHECK(without_pauses(steps_of("G1 X1 F600\nX2\nX3\n")) == "Smmm");
    CHECK(without_pauses(steps_of("G1 X1 F600\nG4 P1\nX3\n")) == "SMdm");
    CHECK(without_pauses(steps_of("G1 X1 F600\n(MSG,a)\nX3\nM2\n")) == "SmeMe");
    CHECK(without_pauses(steps_of("G1 X1 F600\nX1\nX1.00000001\nM0\nX3\n")) == "SMem"); // moves without length are none
    CHECK(without_pauses(steps_of("M3 S1\nG4 P1\n")) == "Seed");
    CHECK(without_pauses(steps_of("")) == "S");
}

TEST_CASE("What does not stop the machine does not hide what does") {
    CHECK(without_pauses(steps_of("G1 X1 F600\n(MSG,a)\nG4 P1\nX3\n")) == "SMedm");
    CHECK(without_pauses(steps_of("G1 X1 F600\nS100\n(MSG,a)\nM0\nX3\n")) == "SMeeem");
    CHECK(without_pauses(steps_of("G1 X1 F600\nM64 P0\nX2\nM64 P1\nX3\n")) == "Smemem");
    CHECK(without_pauses(steps_of("G1 X1 F600\nM64 P0\nM64 P1\n")) == "Smee");
}

TEST_CASE("Events behind a move that waits are bounded: the machine stops there, and they happen") {
    std::string program = "G1 X1 F600\n";
    std::string expected = "SM";
    for (int i = 0; i < 1000; ++i) {
        program += "M64 P0\n";
        expected += 'e';
    }
    CHECK(without_pauses(steps_of(program + "G4 P1\nX3\n")) == expected + "dm");
}

TEST_CASE("A move that is released stops, and what comes behind it still finds its place") {
    CHECK(without_pauses(steps_of("G1 X1 F600\nX2\nX3\n", 3)).find('R') != std::string::npos);
    const std::string steps = without_pauses(steps_of("G1 X1 F600\nG4 P1\nX3\n", 2));
    CHECK(steps == "SRdm");
}
