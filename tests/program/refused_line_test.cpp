// SPDX-License-Identifier: MIT
// A refused line leaves everything as it was, whatever the program did before: an interpreter that was given lines that
// it refused makes of a program what one makes that was not.
#include "support/gcode.hpp"
#include "support/random_gcode.hpp"
#include "support/rounds.hpp"

using namespace splinefeed_test;

namespace {

// What a program may read back, and what items do not show.
void check_same(GcodeRun<double>& one, GcodeRun<double>& other) {
    REQUIRE(one.interpreter().offsets() == other.interpreter().offsets());
    REQUIRE(one.interpreter().modal() == other.interpreter().modal());
    REQUIRE(one.interpreter().position() == other.interpreter().position());
    REQUIRE(one.table() == other.table());
}

void report(GcodeRun<double>& run, bool contact, int number) {
    if (run.items().empty()) {
        return;
    }
    const ProgramItem<double>& last = run.items().back();
    if (last.kind == ItemKind::move && last.move == MoveKind::probe) {
        PerAxis<Position> at = run.interpreter().position();
        at[0].raw += number;
        run.interpreter().report_probe(contact, at, at);
    } else if (last.kind == ItemKind::event && last.event.kind == EventKind::input_wait) {
        run.interpreter().report_input(Decimal::from_integer(number));
    }
}

} // namespace

TEST_CASE("a refused line leaves everything as it was", "[program][refusals][random]") {
    const std::uint64_t first = 20261123;
    int refused = 0;
    int taken = 0;
    for (int round = static_cast<int>(first_round()); round < rounds(200, 5000); ++round) {
        const std::uint64_t seed = first + static_cast<std::uint64_t>(round);
        RandomGcode random(seed);
        GcodeRun<double> with;
        GcodeRun<double> without;
        std::string program;
        for (int n = 0; n < 60; ++n) {
            // #<full> is refused after all other words of its line have been executed.
            const std::string line = random.line() + (random.integer(0, 5) == 0 ? " #3=7 #<_g>=8 #<full>=1" : "");
            program += line + "\n";
            INFO("SPLINEFEED_ROUND=" << round << " (seed " << seed << "):\n" << program);
            with.items().clear();
            without.items().clear();
            if (!with.push(line).ok()) {
                ++refused;
                check_same(with, without);
                continue;
            }
            ++taken;
            REQUIRE(without.push(line).ok());
            REQUIRE(with.items().size() == without.items().size());
            for (std::size_t i = 0; i < with.items().size(); ++i) {
                REQUIRE(with.item_text(i, 6) == without.item_text(i, 6));
                REQUIRE(with.items()[i].stops_before == without.items()[i].stops_before);
            }
            const bool contact = random.integer(0, 1) == 1;
            const int number = random.integer(-1, 9);
            report(with, contact, number);
            report(without, contact, number);
            check_same(with, without);
        }
    }
    INFO(taken << " lines taken, " << refused << " refused");
    CHECK(taken > 20 * rounds(200, 5000));
    CHECK(refused > 10 * rounds(200, 5000));
}

TEST_CASE("what motion leaves for later blocks is put back, too", "[program][refusals]") {
    GcodeRun<double> run;
    run.run("F600 G5 X10 Y0 I1 J1 P-2 Q3\nM66 P1");
    run.interpreter().report_input(Decimal::from_integer(1));
    run.run("G38.2 Z-5\nG5 X10 Y0 I1 J1 P-2 Q3");
    CHECK(run.push("X20 P-9 Q-9 #<full>=1").error == ProgramError::parameter_storage_full);
    CHECK(run.push("G38.3 X99999").error == ProgramError::move_too_long);
    CHECK(run.push("#5399=8 #5061=8 #5070=0 #1=8 #<full>=1").error == ProgramError::parameter_storage_full);
    run.run("X20 Y0 P-2 Q3"); // goes on as the first one ended
    CHECK(run.items().back().element.bezier.points[0][1] == 2.0 * 4096.0);
    CHECK(run.items().back().element.bezier.points[1][1] == -3.0 * 4096.0);
    CHECK(run.last("G0 X#5399 Y#5070 Z#5063") == "rapid 1 1 -5");
    Decimal none;
    CHECK_FALSE(run.table().read(1, none));
    CHECK(run.push("#1=8 #5221=2000000").error == ProgramError::position_out_of_range);
    CHECK_FALSE(run.table().read(1, none));
}

TEST_CASE("a control point of a refused line is none", "[program][refusals]") {
    GcodeRun<double> run;
    run.run("F600 G5.2 X10 Y10 L3");
    CHECK(run.push("X99 Y99 P50 #<full>=1").error == ProgramError::parameter_storage_full);
    run.run("X20 Y0 P0.5");
    CHECK(run.push("G5.3 #<full>=1").error == ProgramError::parameter_storage_full);
    CHECK(run.push("G0 X1").error == ProgramError::nurbs_not_ended);
    CHECK(run.last("G5.3").find("feed bezier 20 0 0") == 0);
}

TEST_CASE("a refused first line does not begin the program", "[program][refusals]") {
    GcodeRun<double> run;
    CHECK(run.push("G1 X1").error == ProgramError::feed_missing);
    CHECK(run.text("%\nG0 X1").find("rapid 1 0 0") == 0);
}
