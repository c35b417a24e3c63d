// SPDX-License-Identifier: MIT
//
// Machines with a jerk limit, from the command line.
#include "support/catch.hpp"
#include "support/places.hpp"
#include "tool.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using nlohmann::json;
using splinefeed::test::Call;
using splinefeed::test::last_positions;
using splinefeed::test::Tool;

namespace {

const std::string examples = "'" + splinefeed::test::source_folder() + "/examples/";
const std::string machine = " -m " + examples + "jerk_limited.toml'";

} // namespace

TEST_CASE("A jerk-limited machine keeps its limits and ends where an acceleration-limited one does") {
    const Tool tool;
    // Over the least time without a jerk limit, as measured and rounded up: what a jerk limit costs is in it, most for
    // the star's 29 stops. tests/judge/gates.py holds the least time with it against the run.
    struct Program {
        const char* file;
        double over_least;
    };
    for (const auto& [program, over_least] :
         {Program{"path61.csv'", 1.010}, Program{"circle720.csv'", 1.0291}, Program{"square.csv'", 1.033},
          Program{"star.csv'", 1.203}, Program{"butterfly.json'", 1.033}}) {
        for (const char* scalar : {" --scalar fixed", " --scalar double"}) {
            const Call call = tool("run " + examples + program + machine + scalar + " --summary json --quiet");
            CAPTURE(program, scalar, call.error);
            REQUIRE(call.status == 0); // the simulated machine stops where a limit is broken
            const json summary = json::parse(call.output);
            double most = 0.0;
            for (const auto& [axis, use] : summary["limit_use"]["jerk"].items()) {
                CHECK(use.get<double>() <= 0.9995); // as measured and rounded up: the plan keeps a reserve
                most = std::max(most, use.get<double>());
            }
            CHECK(most > 0.995);
            const double seconds = summary["cycle_time_s"].get<double>();
            CHECK(seconds >= summary["optimum_time_s"].get<double>());
            CHECK(seconds <= over_least * summary["optimum_time_s"].get<double>());
        }
    }
}

TEST_CASE("What rounding takes of a jerk limit is told, and said where it is more than a hundredth") {
    const Tool tool;
    const std::string plan = "plan " + examples + "path61.csv'" + machine + " --no-advice --set sample_period_us=";
    for (const auto& [period_us, least, most] : {std::array{1000.0, 0.0004, 0.001}, std::array{50.0, 0.011, 0.013}}) {
        CAPTURE(period_us);
        const json reserved =
            json::parse(tool(plan + fmt::format("{} --summary json", period_us)).output)["jerk_reserved"];
        CHECK(reserved.size() == 3);
        for (const json& part : reserved) {
            CHECK(part.get<double>() > least);
            CHECK(part.get<double>() < most);
        }
        const std::string text = tool(plan + fmt::format("{}", period_us)).output;
        CHECK((text.find("of the jerk limit of x is kept for rounding") != std::string::npos) == (most > 0.01));
    }
}

// Of a chain of very short lines a cell's distance from the curve may take all of the jerk.
TEST_CASE("A contour of short lines is never slow as a whole because of one of its cells") {
    const Tool tool;
    for (std::uint32_t random : {9U, 18U, 21U}) {
        std::string program = "G21 G17 G90 G64 P0.01\nG0 X23.8415 Y0 Z0\nG1 F6000\n";
        for (double t = 0.0; t < 6.2831; t += std::array{0.0007, 0.003, 0.006, 0.009}[random >> 16U & 3U]) {
            const double radius = 20.0 + 3.0 * std::cos(3.0 * t) + std::sin(7.0 * t + 1.0);
            program += fmt::format("X{:.3f} Y{:.3f}\n", radius * std::cos(t), radius * std::sin(t));
            random = (random * 1103515245U + 12345U) % 0x80000000U;
        }
        tool.write("contour.ngc", program + "M2\n");
        const Call call = tool("run contour.ngc" + machine + " --summary json --quiet");
        CAPTURE(call.error);
        REQUIRE(call.status == 0);
        const json summary = json::parse(call.output);
        CHECK(summary["cycle_time_s"].get<double>() < 2.0 * summary["optimum_time_s"].get<double>());
    }
}

TEST_CASE("A jerk-limited run is steered and ends where it ends unsteered") {
    const Tool tool;
    const std::string run = "run " + examples + "path61.csv'" + machine + " --summary json --quiet";
    const Call plain = tool(run + " --segments plain.csv");
    REQUIRE(plain.status == 0);
    tool.write("e.csv", "t,event,value\n0.2,hold,\n0.9,resume,\n1.1,override,0.5\n1.6,override,2\n");
    const Call steered = tool(run + " --segments steered.csv --events e.csv");
    CAPTURE(steered.error);
    REQUIRE(steered.status == 0); // the machine found every limit kept
    const double seconds = json::parse(steered.output)["cycle_time_s"].get<double>();
    CHECK(seconds > json::parse(plain.output)["cycle_time_s"].get<double>() + 0.4);
    CHECK(last_positions(tool, "plain.csv") == last_positions(tool, "steered.csv"));
    tool.write("a.csv", "t,event\n0.3,abort\n");
    const Call aborted = tool(run + " --events a.csv");
    CHECK(aborted.status == 1);
    CHECK(aborted.error.find("abort") != std::string::npos);
}
