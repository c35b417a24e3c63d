// SPDX-License-Identifier: MIT
// What a refused line does nevertheless, for whoever looks for further errors.
#include "support/gcode.hpp"

using namespace splinefeed_test;

TEST_CASE("a refused line is obeyed as far as it was understood", "[program][obey]") {
    GcodeRun<double> run;
    const auto obey = [&](const char* line, ProgramError wrong) {
        CHECK(run.push(line).error == wrong);
        run.interpreter().obey_refused();
    };
    obey("G1 X5 Q9 F600", ProgramError::word_unused);
    CHECK(run.text("Y1") == "feed 5 1 0"); // G1, F and X5 hold
    obey("G20 G987 G91 X1", ProgramError::g_code_unknown);
    CHECK(run.text("X1") == "feed 55.8 1 0"); // inches and steps, too
    obey("G2 X9 I99 J99", ProgramError::arc_radius_mismatch);
    CHECK(run.interpreter().modal().motion == 20);
    obey("G21 G90 G92 X0 Y0 V7", ProgramError::axis_missing);
    CHECK(run.text("G0 X0 Y0").find("rapid 9") == std::string::npos); // nothing to go
    obey("#7=5 #8=6 G0 V1", ProgramError::axis_missing);
    CHECK(run.last("G0 X#7 Y#8").find("rapid") == 0);
    CHECK(run.interpreter().modal().motion == 0);
}

TEST_CASE("a feed that was not understood is not missed later", "[program][obey]") {
    for (const char* const line :
         {"G1 X1", "G1 X1 F#<none>", "G1 X1 F-5", "G1 X1 F0.01", "F[1/0]", "F", "F0.01", "G76 F0.01"}) {
        CAPTURE(line);
        GcodeRun<double> run;
        CHECK_FALSE(run.push(line).ok());
        run.interpreter().obey_refused();
        CHECK(run.push("G1 X2").ok());
    }
    GcodeRun<double> run; // nobody looks for further errors
    CHECK_FALSE(run.push("G1 X1").ok());
    CHECK(run.push("G1 X2").error == ProgramError::feed_missing);
}

TEST_CASE("lines without a motion word of their own are not judged behind one that was refused", "[program][obey]") {
    GcodeRun<double> run;
    run.run("F100 G1 X1");
    CHECK(run.push("G72 Z-5 R1").error == ProgramError::lathe_unsupported);
    run.interpreter().obey_refused();
    CHECK(run.text("X9 K1 R2") == "");
    CHECK(run.text("G1 X2") == "feed 2 0 0");
    CHECK(run.push("X9 K1").error == ProgramError::word_unused);
}

TEST_CASE("a cycle that was refused leaves no hole without words", "[program][obey][cycle]") {
    const char* const words[] = {"X1 Z-1", "R1", "Q1", "P1", "L2"};
    for (const char* const cycle : {"G73", "G74", "G81", "G82", "G83", "G84", "G85", "G86", "G89"}) {
        for (unsigned given = 0; given < 32; ++given) { // with any of the words
            std::string line = cycle;
            for (unsigned k = 0; k < 5; ++k) {
                line += (given >> k & 1U) != 0 ? std::string(" ") + words[k] : "";
            }
            CAPTURE(line);
            GcodeRun<double> run;
            run.run(std::string("F100 ") + (line.starts_with("G74") ? "M4" : "M3") + " S100");
            if (!run.push(line).ok()) {
                run.interpreter().obey_refused();
            }
            // A word that does not belong there is left out.
            const std::string_view name(cycle);
            const bool pecks = name == "G73" || name == "G83";
            const bool dwells = name == "G82" || name == "G86" || name == "G89";
            const bool complete = (given & 3U) == 3U && (!pecks || (given & 4U) != 0) && (!dwells || (given & 8U) != 0);
            CHECK(run.text("X2").empty() != complete);
            CHECK(run.push(std::string(cycle) + " X4").ok() == complete);
        }
    }
    GcodeRun<double> run; // what is missing may come with the same word again
    run.run("F100");
    CHECK(run.push("G83 X1 Z-1 R1").error == ProgramError::cycle_peck_invalid);
    run.interpreter().obey_refused();
    CHECK(run.push("X2").ok());
    CHECK(run.push("G83 X1 Z-1 R1").error == ProgramError::cycle_peck_invalid);
    CHECK(run.text("G83 X1 Z-1 R1 Q1").find("feed") != std::string::npos);
    CHECK(run.text("X2").find("feed") != std::string::npos);
}

TEST_CASE("assignments of a refused line are taken when it is obeyed, and else forgotten", "[program][obey]") {
    GcodeRun<double> run;
    const std::string line = "#<a>=3 G0 V1";
    CHECK_FALSE(run.push(line).ok());
    CHECK(run.push("G0 X#<a>").error == ProgramError::parameter_unset);
    CHECK_FALSE(run.interpreter().push(line, 3).ok()); // its text is still there
    run.interpreter().obey_refused();
    CHECK(run.last("G0 X#<a>") == "rapid 3 0 0");
}
