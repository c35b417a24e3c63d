// SPDX-License-Identifier: MIT
// M2 and M30 end the program behind the motion of their block; an abort ends the block.
#include "support/gcode.hpp"
#include "support/random_gcode.hpp"
#include "support/rounds.hpp"

using namespace splinefeed_test;

namespace {

std::string event(EventKind kind, const std::string& rest = " 0 0") {
    return "event " + std::to_string(static_cast<int>(kind)) + rest;
}

// What a program in a turned work system that M2 leaves makes of these lines.
std::string ended(const std::string& last_lines) {
    GcodeRun<double> run;
    run.run("G10 L2 P2 X10 Y5 Z7 R90\nG55 G0 X0 Y0 Z2 F600 M3 S1000");
    return run.text(last_lines);
}

} // namespace

TEST_CASE("a block with M2 is executed before the program ends", "[program][end]") {
    for (const std::string block :
         {"G1 X1", "G2 X2 I1", "G18 G3 X2 I1", "G81 X1 Y1 Z-3 R1 L2", "G83 X1 Z-3 R1 Q1", "G86 X1 Z-3 R1 P1",
          "G5 X3 Y0 I1 J1 P-1 Q1", "G5.1 X3 I1 J1", "G28 X1", "G93 G1 X1 F3"}) {
        CAPTURE(block);
        CHECK(ended(block + " M2") == ended(block + "\nM2"));
        CHECK(ended(block + " M30") == ended(block + "\nM30"));
    }
    CHECK(ended("G5.2 X1 Y1\nX2 Y0 P2\nG5.3\nM2") != "");
}

TEST_CASE("offsets that a block assigns hold behind it", "[program][end]") {
    for (const std::string block :
         {"G1 X1", "G2 X2 I1", "G81 X1 Y1 Z-3 R1 L2", "G86 X1 Z-3 R1 P1", "G28 X1", "G4 P1"}) {
        CAPTURE(block);
        const std::string assigned = "#5241=99 #5250=15 #5230=9 #1=2";
        CHECK(ended(block + " " + assigned + "\nG0 X1") == ended(block + "\n" + assigned + "\nG0 X1"));
        CHECK(ended(block + " " + assigned + " M2") == ended(block + "\n#5241=99 #5250=15 #5230=9\nM2"));
    }
    GcodeRun<double> run;
    REQUIRE(run.interpreter().push("G0 X1 #5221=5", 1).ok());
    run.interpreter().start({}); // an abort
    CHECK(run.last("G0 X1") == "rapid 1 0 0");
}

TEST_CASE("the end of the program leaves G54, and tells", "[program][end]") {
    GcodeRun<double> run;
    run.run("G10 L2 P2 X10\nG55 G0 X1");
    CHECK(run.text("X2 M30") ==
          "rapid 12 0 0\n" + event(EventKind::offsets_changed) + "\n" + event(EventKind::program_end, " stop 30 0"));
    CHECK(run.interpreter().offsets().active == 0);
    CHECK(run.interpreter().has_ended());
    run.interpreter().restart();
    CHECK(run.text("G0 X1 M2") == "rapid 1 0 0\n" + event(EventKind::program_end, " stop 2 0")); // it was in effect
}

TEST_CASE("A M2 is A and then M2", "[program][end][random]") {
    int compared = 0;
    for (int round = static_cast<int>(first_round()); round < rounds(2000, 50000); ++round) {
        const std::uint64_t seed = 5000 + static_cast<std::uint64_t>(round);
        RandomGcode random(seed);
        GcodeRun<double> together;
        GcodeRun<double> apart;
        std::string program;
        for (int n = random.integer(0, 12); n > 0; --n) {
            const std::string line = random.line();
            program += line + "\n";
            const bool taken = together.push(line).ok();
            REQUIRE(apart.push(line).ok() == taken);
        }
        const std::string line = random.line();
        const std::string end = random.integer(0, 1) == 0 ? "M2" : "M30";
        INFO("SPLINEFEED_ROUND=" << round << " (seed " << seed << "):\n" << program << line << " " << end);
        together.items().clear();
        apart.items().clear();
        if (!together.push(line + " " + end).ok()) {
            continue;
        }
        ++compared;
        REQUIRE(apart.push(line).ok());
        REQUIRE(apart.push(end).ok());
        REQUIRE(together.items().size() == apart.items().size());
        for (std::size_t i = 0; i < together.items().size(); ++i) {
            REQUIRE(together.item_text(i, 6) == apart.item_text(i, 6));
            REQUIRE(together.items()[i].stops_before == apart.items()[i].stops_before);
            if (together.items()[i].kind == ItemKind::move) {
                REQUIRE(together.items()[i].element.feed_mm_s == apart.items()[i].element.feed_mm_s);
                REQUIRE(together.items()[i].element.tolerance_mm == apart.items()[i].element.tolerance_mm);
            }
        }
        REQUIRE(together.interpreter().offsets() == apart.interpreter().offsets());
        REQUIRE(together.interpreter().modal() == apart.interpreter().modal());
        REQUIRE(together.interpreter().position() == apart.interpreter().position());
    }
    CHECK(compared > rounds(2000, 50000) / 4);
}

TEST_CASE("an abort drops the rest of a block", "[program][end]") {
    const char* const blocks[] = {"G81 X5 Y5 Z-3 R1 L3 M2", "G5.3", "M6 T2 M3 S5 G1 X3 M30", "M6 T2 M7 G28 X3"};
    for (const std::string block : blocks) {
        for (const bool restarts : {false, true}) {
            for (int taken = 0; taken < 4; ++taken) {
                CAPTURE(block, taken, restarts);
                GcodeRun<double> run;
                run.run("G0 X1 F600 M3 S1000");
                if (block == "G5.3") { // pieces of a rational curve
                    run.run("G5.2 X10 Y10 P5 L4\nX20 Y-5 P1\nX30 Y5 P0.2\nX40 Y0 P3\nX50 Y1 P1");
                }
                Interpreter<double>& interpreter = run.interpreter();
                REQUIRE(interpreter.push(block, 9).ok());
                ProgramItem<double> item;
                for (int i = 0; i < taken; ++i) {
                    REQUIRE(interpreter.next(item) == Pull::item);
                    CHECK(interpreter.push("G0 X0", 10).error == ProgramError::block_pending);
                }
                if (restarts) {
                    interpreter.restart();
                }
                interpreter.start({});
                CHECK_FALSE(interpreter.has_ended());
                CHECK(interpreter.next(item) == Pull::starved);
                CHECK(run.last("G90 G0 X7") == "rapid 7 0 0");
            }
        }
    }
}
