// SPDX-License-Identifier: MIT
// @ and ^. The places are those that LinuxCNC 2.9 (rs274 -g) prints for the same lines, with four decimals.
#include "support/gcode.hpp"

#include <cmath>
#include <numbers>

using namespace splinefeed_test;

namespace {

/// Whether the last move ends there.
bool ends_at(GcodeRun<double>& run, const std::string& line, double x, double y, double z = 0.0) {
    const PathElement<double> element = run.run(line).back().element;
    const bool there = std::abs(to_mm(element.to[0]) - x) < 6e-5 && std::abs(to_mm(element.to[1]) - y) < 6e-5 &&
                       to_mm(element.to[2]) == z;
    if (!there) {
        UNSCOPED_INFO(line << " ends at " << to_mm(element.to[0]) << " " << to_mm(element.to[1]));
    }
    return there;
}

} // namespace

TEST_CASE("@ is a radius and ^ an angle about X0 Y0", "[program][polar]") {
    GcodeRun<double> run;
    CHECK(ends_at(run, "G0 @10 ^30", 8.6603, 5.0));
    CHECK(ends_at(run, "G1 F100 @12", 10.3923, 6.0));
    CHECK(ends_at(run, "^90", 0.0, 12.0));
    CHECK(run.text("G0 X3 Y4\n@10") == "rapid 3 4 0\nrapid 6 8 0"); // exact where only the radius changes
    CHECK(run.text("G2 @10 ^0 I-6 J-8").find("feed arc 10 0 0 about 0 0 0 by -53.1301") == 0);
    CHECK(run.text("@10 ^180 R10").find("feed arc -10 0 0 about 0 0 0 by -180") == 0);
    CHECK(ends_at(run, "G20 G0 @1 ^10", 25.0141, 4.4107));
    CHECK(run.text("G0 @-2 ^0 Z1") == "rapid -50.8 0 25.4");
    CHECK(run.text("G21 G92 X0 Y5\n@3 ^-90").find("rapid -50.8 -8 25.4") != std::string::npos);
    CHECK(run.text("#1=4 @[#1+1] ^#1") != "");
}

TEST_CASE("under G91 they are added to the radius and the angle of the place", "[program][polar]") {
    GcodeRun<double> run;
    run.run("F100 G1 Y12");
    CHECK(run.text("G91 @2") == "feed 0 14 0");
    CHECK(ends_at(run, "^45", -9.8995, 9.8995));
    CHECK(ends_at(run, "@1 ^-20", -6.3393, 13.5946));
    CHECK(ends_at(run, "G90 G81 @20 ^45 Z-3 R1", 14.1421, 14.1421, 1.0));
    CHECK(ends_at(run, "^60", 10.0, 17.3205, 1.0));
    CHECK(ends_at(run, "G91 @5 Z-1", 12.5, 21.6506, 1.0));
}

TEST_CASE("polar words are of motion, in G17, and have a direction", "[program][polar]") {
    GcodeRun<double> run;
    run.run("F100");
    for (const char* line : {"G1 @10", "G91 G1 ^10", "G91 G1 @10 ^5", "G1 X1 @1 ^0", "G1 Y1 ^0", "G53 G1 @1 ^0",
                             "G92 @1 ^0", "G80 @1 ^0", "@1 ^0", "G10 L2 P1 @1 ^0", "G43.1 @1 ^0"}) {
        CAPTURE(line);
        CHECK(run.push(line).error == ProgramError::polar_unsuited);
        CHECK(run.interpreter().position() == PerAxis<Position>{});
    }
    CHECK(run.text("G1 ^10") == "feed 0 0 0"); // the radius stays 0
    run.run("G18");
    CHECK(run.push("G1 @1 ^0").error == ProgramError::polar_unsuited);
    ProgramSettings settings;
    settings.axes = 2;
    settings.letters = {'X', 'Z'};
    GcodeRun<double> lathe(settings);
    CHECK(lathe.push("G0 @1 ^0").error == ProgramError::polar_unsuited);
}

TEST_CASE("repeats of a cycle under G91 go on about X0 Y0", "[program][polar]") {
    GcodeRun<double> run;
    run.run("F100 G0 X20");
    // LinuxCNC 2.9 (CYCLE_MACRO of interp_internal.hh): each hole has so much more radius and angle than the one
    // before.
    const auto items = run.run("G91 G81 @2 ^30 Z-3 R1 L12");
    int holes = 0;
    for (const auto& item : items) {
        if (item.kind == ItemKind::move && item.move == MoveKind::feed) {
            ++holes;
            const double angle = holes * std::numbers::pi / 6;
            CHECK(std::abs(to_mm(item.element.to[0]) - (20 + 2 * holes) * std::cos(angle)) < 2e-8);
            CHECK(std::abs(to_mm(item.element.to[1]) - (20 + 2 * holes) * std::sin(angle)) < 2e-8);
        }
    }
    CHECK(holes == 12);
    CHECK(ends_at(run, "^90 L3", 0.0, -44.0, 1.0));
    CHECK(ends_at(run, "@-11 L4", 0.0, 0.0, 1.0)); // the last one in the middle
    run.run("G80 G90 G0 X10 Y0\nG91");
    CHECK(run.push("G81 @-3 Z-3 R1 L4").error == ProgramError::polar_unsuited); // beyond the middle
    CHECK(ends_at(run, "G81 @1 ^-3600090 Z-3 R0 L2", -12.0, 0.0, 1.0));
    CHECK(ends_at(run, "G20 ^90 @1 L1", 0.0, -37.4, 1.0));
    CHECK(run.push("G21 @20000 ^1 L100").error == ProgramError::move_too_long);
    CHECK(run.push("^0.01 L1.5").error == ProgramError::cycle_repeats_invalid);
}
