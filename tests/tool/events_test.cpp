// SPDX-License-Identifier: MIT
//
// What an operator does while a program runs, from the command line.
#include "support/catch.hpp"
#include "support/places.hpp"
#include "tool.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

using nlohmann::json;
using splinefeed::test::Call;
using splinefeed::test::last_positions;
using splinefeed::test::Tool;

namespace {

// 100 mm along x at 50 mm/s, 1000 mm/s^2: 2.05 s.
const std::string line = "x,y,z,feed\n0,0,0,\n100,0,0,50\n";

struct Run {
    Call call;
    json summary;
    [[nodiscard]] double seconds() const { return summary["cycle_time_s"].get<double>(); }
};

Run run(const Tool& tool, const std::string& events, const std::string& program = "line.csv") {
    tool.write("e.csv", events);
    const std::string with = events.empty() ? "" : " --events e.csv";
    const Call call = tool("run " + program + with + " --trace t.csv --segments s.csv --summary json --quiet");
    return {call, json::parse(call.output, nullptr, false)};
}

std::vector<std::vector<double>> rows_of(const std::string& text) {
    std::vector<std::vector<double>> rows;
    std::istringstream in(text);
    for (std::string row; std::getline(in, row);) {
        if (row.empty() || std::string("-0123456789").find(row.front()) == std::string::npos) {
            continue; // the header
        }
        std::istringstream fields(row);
        rows.emplace_back();
        for (std::string field; std::getline(fields, field, ',');) {
            rows.back().push_back(std::stod(field));
        }
    }
    return rows;
}

} // namespace

TEST_CASE("A hold adds the time that it stands and changes nothing of where the program ends") {
    const Tool tool;
    tool.write("line.csv", line);
    const std::string path61 = "'" + splinefeed::test::source_folder() + "/examples/path61.csv'";
    for (const std::string& program : {std::string("line.csv"), path61}) {
        const Run plain = run(tool, "", program);
        REQUIRE(plain.call.status == 0);
        const std::vector<std::string> end = last_positions(tool, "s.csv");
        REQUIRE(end.size() >= 3);
        const Run held = run(tool, "t,event,value\n0.5,hold\n1.5,resume\n", program);
        CAPTURE(program, held.call.error);
        REQUIRE(held.call.status == 0);
        CHECK(held.call.error.empty());
        CHECK(last_positions(tool, "s.csv") == end);
        CHECK_FALSE(held.summary["stopped"].get<bool>());
        CHECK(held.summary["optimum_time_s"].is_null());
        // Braking and starting again cost v / a more than the time from hold to resume less the braking
        CHECK(held.seconds() > plain.seconds() + 0.9);
        CHECK(held.seconds() < plain.seconds() + 1.2);
        int standing = 0;
        for (const auto& row : rows_of(tool.read("t.csv"))) {
            standing += row[0] > 0.7 && row[0] < 1.49 ? (row.back() == 0.0 ? 1 : -10000) : 0;
        }
        CHECK(standing > 700);
    }
}

TEST_CASE("A hold that nothing resumes, and an abort, end at rest on the path with status 1") {
    const Tool tool;
    tool.write("line.csv", line);
    for (const auto& [events, part] :
         {std::pair{"0.5,hold\n", "held, and no event resumes it; the machine stands at x="},
          std::pair{"0.5,override,0\n", "held, and no event resumes it; the machine stands at x="},
          std::pair{"0.5,abort\n", "aborted by an event; the machine stands at x="},
          std::pair{"0.4,hold\n0.5,abort\n0.6,resume\n", "aborted by an event; the machine stands at x="}}) {
        const Run stopped = run(tool, events);
        CAPTURE(events, stopped.call.error);
        CHECK(stopped.call.status == 1);
        CHECK(std::count(stopped.call.error.begin(), stopped.call.error.end(), '\n') == 1);
        CHECK(stopped.call.error.find(part) != std::string::npos);
        CHECK(stopped.summary["stopped"].get<bool>());
        const auto rows = rows_of(tool.read("t.csv"));
        REQUIRE(rows.size() > 100);
        CHECK(rows.back().back() == 0.0);
        CHECK(rows.back()[2] == 0.0);
        // 23.75 mm at 0.5 s, and 1.25 mm of braking
        const double x = std::string(events).find("0.4") == 0 ? 20.0 : 25.0;
        CHECK(rows.back()[1] == Approx(x).margin(0.15));
    }
}

TEST_CASE("An override scales the programmed feed, at most to the machine's") {
    const Tool tool;
    tool.write("line.csv", line);
    const Run plain = run(tool, "");
    const std::vector<std::string> end = last_positions(tool, "s.csv");
    CHECK(plain.seconds() == Approx(2.05).margin(0.01));
    const auto fastest = [&] {
        double most = 0.0;
        for (const auto& row : rows_of(tool.read("t.csv"))) {
            most = std::max(most, row.back());
        }
        return most;
    };
    CHECK(fastest() == Approx(50.0).epsilon(1e-3));
    for (const auto& [ratio, feed] :
         {std::pair{0.5, 25.0}, std::pair{1.0, 50.0}, std::pair{1.5, 75.0}, std::pair{2.0, 100.0}}) {
        const Run steered = run(tool, "0,override," + std::to_string(ratio) + "\n");
        CAPTURE(ratio, steered.call.error);
        CHECK(steered.call.status == 0);
        CHECK(steered.seconds() == Approx(100.0 / feed + feed / 1000.0).margin(0.01));
        CHECK(fastest() == Approx(feed).epsilon(1e-3));
        CHECK(last_positions(tool, "s.csv") == end);
    }
    // Twice a feed that is more than half of the machine's is the machine's
    tool.write("fast.csv", "x,y,z,feed\n0,0,0,\n100,0,0,80\n");
    CHECK(run(tool, "0,override,2\n", "fast.csv").seconds() == Approx(1.1).margin(0.01));
    CHECK(fastest() <= 100.0);
    // In the middle: half of the way at 50, the other at 25
    const Run middle = run(tool, "1.025,override,0.5\n");
    CHECK(middle.seconds() == Approx(1.025 + 2.0 + 0.0125).margin(0.03));
}

TEST_CASE("What is planned with events is what is run") {
    const Tool tool;
    tool.write("line.csv", line);
    const std::string events = "0.3,override,0.6\n0.8,hold\n1,resume\n1.4,override,2\n";
    CHECK(run(tool, events).call.status == 0);
    const std::string segments = tool.read("s.csv");
    const Call planned = tool("plan line.csv --events e.csv --segments p.csv --quiet");
    CHECK(planned.status == 0);
    CHECK(planned.output.find("It was steered: 4 events of the operator.") != std::string::npos);
    CHECK(tool.read("p.csv") == segments);
}
