// SPDX-License-Identifier: MIT
#include "host_sim/analysis/program_report.hpp"

#include "host_sim/config/machine_file.hpp"
#include "host_sim/output/program_report_text.hpp"
#include "support/catch.hpp"

#include <nlohmann/json.hpp>

using namespace splinefeed;
using namespace splinefeed::host;

TEST_CASE("Lengths and times are counted by kind, tool and line") {
    const MachineDescription machine = default_machine();
    ProgramReport report(machine);
    PathElement<double> move;
    report.start({});
    move.to[0] = position_from_mm(10.0);
    report.move(move, true, 1);
    report.tool(3);
    move.to[0] = position_from_mm(4.0);
    report.move(move, false, 2);
    move.to[1] = position_from_mm(-5.0);
    report.move(move, false, 2);
    report.moved(0, 0.5, {.velocity = true});
    report.moved(1, 1.0, {.feed = true});
    report.moved(2, 0.25, {.acceleration = true});
    report.stood(7, 3.0);
    report.moved(99, 1.0, {}); // not announced
    CHECK(report.rapids().length_mm == 10.0);
    CHECK(report.rapids().seconds == 0.5);
    CHECK(report.feeds().length_mm == 11.0);
    CHECK(report.feeds().moves == 2);
    CHECK(report.tools().at(0).seconds == 0.5);
    CHECK(report.tools().at(3).seconds == 1.25);
    CHECK(report.dwell_s() == 3.0);
    CHECK(report.feed_box().low[1] == -5.0);
    CHECK(report.rapid_box().high[0] == 10.0);
    const auto lines = report.slowest(2);
    REQUIRE(lines.size() == 2);
    CHECK(lines[0].line == 7);
    CHECK(lines[1].line == 2);
    CHECK(lines[1].feed_s == 1.0);

    const auto json = nlohmann::json::parse(check_json(report, machine, {.cycle_time_s = 4.75}));
    CHECK(json["cycle_time_s"] == 4.75);
    CHECK(json["slowest_lines"][1]["limit"] == "its feed");
    CHECK(json["tools"]["3"]["moves"] == 2);
    const auto wrong =
        nlohmann::json::parse(check_json(report, machine, {.problems = {"p.ngc:1: wrong"}, .problem_count = 3}));
    CHECK(wrong["problems"][0] == "p.ngc:1: wrong");
    CHECK_FALSE(wrong.contains("cycle_time_s"));
    CHECK(wrong["problem_count"] == 3);
    const ProgramFindings found{.problems = {"p.ngc:1: wrong"},
                                .problem_count = 1,
                                .notes = {"p.ngc:3: the program ends here"},
                                .left_out = {{"M104", 2, 5}, {"E", 1, 9}}};
    CHECK(check_text(report, machine, found)
              .find("p.ngc:1: wrong\n\n1 problem\np.ngc:3: the program ends here\n"
                    "left out: M104 2 times, first on line 5; E on line 9\n\n") == 0);
}
