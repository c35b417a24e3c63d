// SPDX-License-Identifier: MIT
// The whole text and JSON of a run, and the lines that differ where something is unusual: tests/host/summaries.txt.
#include "host_sim/output/summary.hpp"

#include "support/golden_text.hpp"

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

void within_a_tolerance(Summary& summary) {
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
}

void with_exact_stops(Summary& summary, double time_s) {
    summary.tolerance = ToleranceSummary{};
    summary.tolerance->exact_stop_s = time_s;
}

void shared_limits(Summary& summary) {
    summary.limit_share =
        LimitShares{{{0.5, 0.25, 0.125}, {0.0, 0.75, std::nullopt}}, 0.375, 0.0, std::nullopt, std::nullopt, 0.0625};
}

void steered_shares(Summary& summary) {
    shared_limits(summary);
    summary.limit_share->override_feed = 0.125;
    summary.limit_share->hold = 0.25;
    summary.limit_share->dwell = 0.05;
}

void what_would_help(Summary& summary) {
    summary.what_would_help = LimitAdvice{{{"window of 4096 cells", {}, 4096, 11.9, 0.036},
                                           {"jerk of x", "axis.x.max_jerk_mm_s3=33000", 0, 12.0, 0.028},
                                           {"programmed feed", {}, 0, 12.34, 0.0001}}};
}

void with_a_program(Summary& summary) {
    ProgramSummary& program = summary.program;
    program.dialect = "marlin, for M104";
    program.left_out = {{"M104", 3, 5}, {"E", 1, 12}};
    program.dwells = 2;
    program.dwell_s = 1.5;
    program.events = 3;
    program.line = 17;
    program.first_events = {{1.5, 4, "change_tool", 2, 0.0, {}},
                            {2.0, 0, "spindle_on", 0, 12000.0, {}},
                            {2.5, 9, "message", 0, 0.0, "done"}};
}

void on_drives(Summary& summary) {
    LinkSummary link;
    link.drives.push_back({"modbus-tcp://127.0.0.1:1502?unit=1", {.exchanges = 100, .segments = 90, .timeouts = 1}});
    link.drives.push_back({"modbus-tcp://127.0.0.1:1502?unit=2",
                           {.exchanges = 50,
                            .segments = 45,
                            .disconnects = 2,
                            .corrupt = 3,
                            .stale = 4,
                            .misfits = 5,
                            .exceptions = 6,
                            .resent = 7}});
    link.clocks_s = 0.0005;
    link.resumes = 1;
    link.bus_s = 0.25;
    summary.link = link;
}

void on_lines(Summary& summary) {
    GpioSummary gpio;
    gpio.edges = 1000;
    gpio.median_late_s = 1e-5;
    gpio.p99_late_s = 4e-5;
    gpio.most_late_s = 9e-5;
    gpio.late = {{1e-5, 600}, {2e-5, 400}};
    gpio.schedule_slip_s = 0.001;
    gpio.buffer_underruns = 2;
    gpio.began_monotonic_s = 77.5;
    gpio.missed = 3;
    gpio.changes_left_out = 4;
    gpio.add({.role = "limit", .axis = "x", .active = true, .time_s = 1.25, .position_mm = {{10.5, -3.0}}});
    gpio.add({.role = "e-stop", .axis = {}, .active = false, .time_s = 2.5, .position_mm = {}});
    summary.gpio = gpio;
}

template <auto member>
void of_events(Summary& summary) {
    summary.*member = 2;
}

using Row = std::pair<const char*, void (*)(Summary&)>;

Row row(const char* what, void (*change)(Summary&)) {
    return {what, change};
}

const Row rows[] = {
    row("a plan with a jerk limit, in another scalar", [](Summary& s) { s.jerk_scalar = "double"; }),
    row("a run that was steered", of_events<&Summary::events>),
    row("what a program asked for", with_a_program),
    row("a program that has begun no line", [](Summary& s) { s.program.dwells = 1; }),
    row("a run on drives", on_drives),
    row("a run on drives that follow targets",
        [](Summary& s) {
            on_drives(s);
            s.link->target_period_us = 2000;
            s.link->between_targets_mm = 0.003;
            s.link->late_us = 700;
        }),
    row("a run on lines", on_lines),
    row("a curve of control points has no waypoint error",
        [](Summary& s) {
            s.waypoint_error_mm.reset();
            s.curve = "bspline";
        }),
    row("no optimum, no limits, no jerk, and the memory is unknown",
        [](Summary& s) {
            s.optimum_time_s.reset();
            s.limit_use.clear();
            s.peak_rss_bytes = 0;
        }),
    row("no axis has a jerk limit", [](Summary& s) { s.limit_use[0].jerk.reset(); }),
    row("shares of the limits", shared_limits),
    row("shares of a run with an override, a hold and a dwell", steered_shares),
    row("shares of a path with a centripetal limit and a chord error, and no axis with a jerk limit",
        [](Summary& s) {
            shared_limits(s);
            s.limit_share->axis[0].jerk.reset();
            s.limit_share->centripetal = 0.02;
            s.limit_share->chord = 0.0;
        }),
    row("shares where nothing moved",
        [](Summary& s) {
            shared_limits(s);
            s.cycle_time_s = 0.0;
            s.optimum_time_s.reset();
        }),
    row("what would help: small gains in JSON only", what_would_help),
    row("what would help, of the first moves",
        [](Summary& s) {
            what_would_help(s);
            s.what_would_help->moves = 20'000;
        }),
    row("nothing would help",
        [](Summary& s) {
            what_would_help(s);
            s.what_would_help->limits.clear();
        }),
    row("a run that was stopped, above a limit, with a window that is too short",
        [](Summary& s) {
            s.stopped = true;
            s.window_limited = 1;
            s.searched_legs = 40;
            s.slow_legs = 2;
            s.stops = 3;
            s.limit_use[1].acceleration = 1.5;
        }),
    row("a jerk limit of which rounding takes more than a hundredth",
        [](Summary& s) { s.limit_use[0].jerk_reserved = 0.0345; }),
    row("events that the run did not reach", of_events<&Summary::events_not_reached>),
    row("a path within a tolerance", within_a_tolerance),
    row("a tolerance that was not kept",
        [](Summary& s) {
            within_a_tolerance(s);
            s.tolerance->rotary_deviation = ToleranceSummary::Place{0.5, 4, 0, "element 4"};
            s.tolerance->excess = "the path is 0.5 degrees from element 4";
        }),
    row("a deviation of zero is at no element and at no line",
        [](Summary& s) {
            with_exact_stops(s, 0.0);
            s.tolerance->rotary_deviation = ToleranceSummary::Place{};
        }),
    row("longer than with exact stops", [](Summary& s) { with_exact_stops(s, s.cycle_time_s / 1.012); }),
    row("as long, rounded up", [](Summary& s) { with_exact_stops(s, s.cycle_time_s / 1.0004); }),
    row("as long, rounded down", [](Summary& s) { with_exact_stops(s, s.cycle_time_s / 0.9996); }),
};

} // namespace

TEST_CASE("summaries: the text and the JSON are those of summaries.txt") {
    const std::string usual = to_text(sample()) + to_json(sample());
    std::string all = usual;
    for (const auto& [what, change] : rows) {
        Summary summary = sample();
        change(summary);
        all += std::string("\n= ") + what + "\n" +
               splinefeed_test::changed_lines(usual, to_text(summary) + to_json(summary));
    }
    splinefeed_test::require_golden("host/summaries.txt", all);
}

TEST_CASE("of inputs that never rest the last changes are kept, and the others counted") {
    GpioSummary gpio;
    for (std::size_t i = 0; i < GpioSummary::most_changes + 3; ++i) {
        gpio.add({.role = "limit", .axis = "x", .active = true, .time_s = static_cast<double>(i), .position_mm = {}});
    }
    CHECK(gpio.changes.size() == GpioSummary::most_changes);
    CHECK(gpio.changes.front().time_s == 3.0);
    CHECK(gpio.changes_left_out == 3);
    CHECK(to_text(gpio).find("3 older changes of inputs are left out.\n") != std::string::npos);
    CHECK(to_json(gpio).at("changes_left_out") == 3);
}
