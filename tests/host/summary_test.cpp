// SPDX-License-Identifier: MIT
#include "host_sim/output/summary.hpp"

#include "support/catch.hpp"

#include <nlohmann/json.hpp>

using namespace splinefeed::host;

namespace {

Summary sample() {
    Summary summary;
    summary.cycle_time_s = 12.3456789;
    summary.length_mm = 1234.5;
    summary.waypoints = 1000;
    summary.curve_segments = 999;
    summary.feed_segments = 12346;
    summary.scalar = "fixed";
    summary.curve = "g2";
    summary.max_speed_mm_s = 99.99;
    summary.limit_use = {{"x", 0.5, 0.999998, 0.25}, {"c", 0.125, 0.75, std::nullopt}};
    summary.waypoint_error_mm = 3.25e-4;
    summary.optimum_time_s = 12.0;
    summary.planning_time_s = 0.5;
    summary.memory_bytes = {1000, 200, 30};
    summary.smoothing_bound_mm = 2.9e-4;
    summary.peak_rss_bytes = 3 * 1048576;
    return summary;
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("without a waypoint error the key stays, and the text says why") {
    Summary summary = sample();
    CHECK(contains(to_text(summary), "waypoint error"));
    CHECK_FALSE(contains(to_text(summary), "control points"));
    summary.waypoint_error_mm.reset();
    summary.curve = "bspline";
    CHECK(nlohmann::json::parse(to_json(summary)).at("waypoint_error_mm").is_null());
    CHECK_FALSE(contains(to_text(summary), "waypoint error"));
    CHECK(contains(to_text(summary),
                   "The waypoints are control points: the curve is drawn towards them and need not pass"));
}

TEST_CASE("the JSON summary has the keys of the contract, in order") {
    const nlohmann::ordered_json json = nlohmann::ordered_json::parse(to_json(sample()));
    std::vector<std::string> keys;
    for (const auto& item : json.items()) {
        keys.push_back(item.key());
    }
    CHECK(keys == std::vector<std::string>{"cycle_time_s",
                                           "length_mm",
                                           "waypoints",
                                           "curve_segments",
                                           "feed_segments",
                                           "scalar",
                                           "curve",
                                           "max_speed_mm_s",
                                           "limit_use",
                                           "waypoint_error_mm",
                                           "optimum_time_s",
                                           "planning_time_s",
                                           "memory_bytes",
                                           "stopped",
                                           "window_limited",
                                           "stops",
                                           "smoothing_bound_mm",
                                           "peak_rss_bytes",
                                           "limit_share",
                                           "what_would_help"});
    CHECK(json["cycle_time_s"] == 12.3456789);
    CHECK(json["feed_segments"] == 12346);
    CHECK(json["scalar"] == "fixed");
    CHECK(json["curve"] == "g2");
    CHECK(json["limit_use"] == nlohmann::ordered_json::parse(R"({"velocity": {"x": 0.5, "c": 0.125},
        "acceleration": {"x": 0.999998, "c": 0.75}, "jerk": {"x": 0.25}})"));
    CHECK(json["waypoint_error_mm"] == 3.25e-4);
    CHECK(json["optimum_time_s"] == 12.0);
    CHECK(json["memory_bytes"] == nlohmann::ordered_json::parse(R"({"curve": 1000, "feed_plan": 200, "stream": 30})"));
    CHECK(json["stopped"] == false);
    CHECK(json["peak_rss_bytes"] == 3145728);
    CHECK(to_json(sample()).back() == '\n');
}

TEST_CASE("what is absent is null or empty in JSON") {
    Summary summary = sample();
    summary.optimum_time_s.reset();
    summary.limit_use.clear();
    summary.stopped = true;
    const auto json = nlohmann::json::parse(to_json(summary));
    CHECK(json["optimum_time_s"].is_null());
    CHECK(json["limit_use"] == nlohmann::json::parse(R"({"velocity": {}, "acceleration": {}, "jerk": {}})"));
    CHECK(json["stopped"] == true);
    CHECK(json["limit_share"].is_null());
}

TEST_CASE("the shares of the limits are in both forms") {
    Summary summary = sample();
    summary.limit_share =
        LimitShares{{{0.5, 0.25, 0.125}, {0.0, 0.75, std::nullopt}}, 0.375, 0.0, std::nullopt, std::nullopt, 0.0625};
    const auto json = nlohmann::ordered_json::parse(to_json(summary));
    CHECK(json["limit_share"] == nlohmann::ordered_json::parse(R"({"velocity": {"x": 0.5, "c": 0.0},
        "acceleration": {"x": 0.25, "c": 0.75}, "jerk": {"x": 0.125}, "feed": 0.375, "centripetal": 0.0, "chord": 0.0,
        "none": 0.0625})"));
    const std::string text = to_text(summary);
    CHECK(contains(text, "\n\nshare of the time at        velocity  acceleration          jerk\n"));
    CHECK(contains(text, "  axis c                       0.0 %        75.0 %      no limit\n"));
    summary.cycle_time_s = 0.0; // nothing moved
    CHECK_FALSE(contains(to_text(summary), "share of the time"));
}

TEST_CASE("what would help is in both forms, the small gains in JSON only") {
    Summary summary = sample();
    CHECK(nlohmann::json::parse(to_json(summary))["what_would_help"].is_null());
    CHECK_FALSE(contains(to_text(summary), "what would help"));
    summary.what_would_help = LimitAdvice{{{"jerk of x", 12.0, 0.028}, {"programmed feed", 12.34, 0.0001}}};
    const auto json = nlohmann::json::parse(to_json(summary))["what_would_help"];
    REQUIRE(json.size() == 2);
    CHECK(json[0] == nlohmann::json::parse(R"({"limit": "jerk of x", "cycle_time_s": 12.0, "gain": 0.028})"));
    CHECK(contains(to_text(summary), "\n  jerk of x                12.000000 s  2.8 % less\n"));
    CHECK_FALSE(contains(to_text(summary), "programmed feed"));
    CHECK_FALSE(nlohmann::json::parse(to_json(summary)).contains("what_would_help_moves"));
    summary.what_would_help->moves = 20'000; // stand for all
    CHECK(nlohmann::json::parse(to_json(summary))["what_would_help_moves"] == 20'000);
    CHECK(contains(to_text(summary), "planned again for the first 20000 moves\n"));
    summary.what_would_help->limits.clear();
    CHECK(contains(to_text(summary), "no limit alone"));
}

TEST_CASE("the text is a table with units") {
    const std::string text = to_text(sample());
    CHECK(contains(text, "cycle time                 12.345679 s\n"));
    CHECK(contains(text,
                   "optimum                    12.000000 s (acceleration-limited; this run takes 2.88 % longer)\n"));
    CHECK(contains(text, "waypoint error              0.000325 mm at most\n"));
    CHECK(contains(text, "curve segments                   999 g2\n"));
    CHECK(contains(text, "planner's memory                1230 bytes (curve 1000, feed plan 200, stream 30)\n"));
    CHECK(contains(text, "memory of the process            3.0 MiB\n"));
    CHECK(contains(text, "limits used                 velocity  acceleration          jerk\n"));
    CHECK(contains(text, "  axis x                     50.00 %      100.00 %       25.00 %\n"));
    CHECK(contains(text, "  axis c                     12.50 %       75.00 %      no limit\n"));
    CHECK_FALSE(contains(text, ".\n")); // nothing unusual, no sentence
    CHECK(text.back() == '\n');
}

TEST_CASE("columns and rows without content are left out") {
    Summary summary = sample();
    summary.limit_use[0].jerk.reset();
    summary.optimum_time_s.reset();
    summary.peak_rss_bytes = 0;
    const std::string text = to_text(summary);
    CHECK_FALSE(contains(text, "jerk"));
    CHECK_FALSE(contains(text, "optimum"));
    CHECK_FALSE(contains(text, "memory of the process"));
}

TEST_CASE("the unusual gets a sentence") {
    Summary summary = sample();
    summary.stopped = true;
    summary.window_limited = 1;
    summary.stops = 3;
    summary.limit_use[1].acceleration = 1.5;
    const std::string text = to_text(summary);
    CHECK(contains(text, "\n\nThe run was stopped before the end of the program.\n"));
    CHECK(contains(text, "Axis c is above its acceleration limit: 1.5 of it.\n"));
    CHECK(contains(text, "too short 1 time:"));
    CHECK(contains(text, "stops at 3 corners"));
}

TEST_CASE("events that the run did not reach are counted") {
    Summary summary = sample();
    summary.events_not_reached = 2;
    CHECK(contains(to_text(summary), "The run was over before 2 events of the operator.\n"));
    CHECK(nlohmann::json::parse(to_json(summary))["events_not_reached"] == 2);
    CHECK(nlohmann::json::parse(to_json(summary))["events"] == 0);
}

TEST_CASE("of inputs that never rest the last changes are kept, and the others counted") {
    GpioSummary gpio;
    for (std::size_t i = 0; i < GpioSummary::most_changes + 3; ++i) {
        gpio.add({.role = "limit", .axis = "x", .active = true, .time_s = static_cast<double>(i), .position_mm = {}});
    }
    CHECK(gpio.changes.size() == GpioSummary::most_changes);
    CHECK(gpio.changes.front().time_s == 3.0);
    CHECK(gpio.changes_left_out == 3);
    CHECK(contains(to_text(gpio), "3 older changes of inputs are left out.\n"));
    CHECK(nlohmann::json(to_json(gpio))["changes_left_out"] == 3);
}

TEST_CASE("a path within a tolerance says how near it is, and what became of the elements") {
    Summary summary = sample();
    CHECK_FALSE(nlohmann::json::parse(to_json(summary)).contains("tolerance"));
    ToleranceSummary tolerance;
    tolerance.deviation = {0.01, 3, 12, "element 3 (line 12)"};
    tolerance.blended = 5;
    tolerance.stopped = 2;
    tolerance.through = 1;
    tolerance.chains = 4;
    tolerance.elements = 100;
    tolerance.pieces = 20;
    tolerance.exact_stop_s = 24.0;
    summary.tolerance = tolerance;
    const auto json = nlohmann::ordered_json::parse(to_json(summary))["tolerance"];
    CHECK(json ==
          nlohmann::ordered_json::parse(R"({"kept": true, "deviation_mm": {"distance": 0.01, "at": 3, "line": 12},
        "blended": 5, "stopped": 2, "through": 1, "chains": 4, "elements": 100, "pieces": 20, "exact_stop_time_s": 24.0})"));
    const std::string text = to_text(summary);
    CHECK(contains(text, "0.01 mm at most, at element 3 (line 12)"));
    CHECK(contains(text, "5 rounded, 2 with a stop, 1 straight on; chains 4"));
    CHECK(contains(text, "100 to 20 pieces"));
    CHECK(contains(text, "24.000 s (estimated; this run takes 48.6 % less)"));
    CHECK_FALSE(contains(text, "not kept"));
    summary.tolerance->rotary_deviation = ToleranceSummary::Place{0.5, 4, 0, "element 4"};
    summary.tolerance->excess = "the path is 0.5 degrees from element 4";
    CHECK(contains(to_text(summary), "rotary deviation"));
    CHECK(contains(to_text(summary), "The tolerance was not kept: the path is 0.5 degrees from element 4."));
    const auto broken = nlohmann::json::parse(to_json(summary))["tolerance"];
    CHECK(broken["kept"] == false);
    CHECK(broken["deviation_deg"]["distance"] == 0.5);
    CHECK(broken["deviation_deg"]["line"].is_null());
}

TEST_CASE("a run is shorter than with exact stops, longer or as long: never less by a negative share") {
    Summary summary = sample();
    summary.tolerance = ToleranceSummary{};
    summary.tolerance->exact_stop_s = summary.cycle_time_s / 1.012;
    CHECK(contains(to_text(summary), "(estimated; this run takes 1.2 % more)"));
    summary.tolerance->exact_stop_s = summary.cycle_time_s / 1.0004;
    CHECK(contains(to_text(summary), "(estimated; this run takes as long)"));
    summary.tolerance->exact_stop_s = summary.cycle_time_s / 0.9996;
    CHECK(contains(to_text(summary), "(estimated; this run takes as long)"));
    summary.tolerance->exact_stop_s = 0.0;
    CHECK(contains(to_text(summary), "(estimated; this run takes as long)"));
}

TEST_CASE("a deviation of zero is at no element and at no line") {
    Summary summary = sample();
    summary.tolerance = ToleranceSummary{};
    summary.tolerance->rotary_deviation = ToleranceSummary::Place{};
    const std::string text = to_text(summary);
    CHECK(contains(text, "0 mm at most\n"));
    CHECK(contains(text, "0 degrees at most\n"));
    CHECK_FALSE(contains(text, ", at"));
    const auto json = nlohmann::json::parse(to_json(summary))["tolerance"];
    CHECK(json["deviation_mm"]["distance"] == 0.0);
    CHECK(json["deviation_mm"]["at"].is_null());
    CHECK(json["deviation_deg"]["at"].is_null());
}
