// SPDX-License-Identifier: MIT
#include "host_sim/output/summary.hpp"

#include "host_sim/analysis/limit_share.hpp"
#include "host_sim/curve/curve_arguments.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

namespace splinefeed::host {

namespace {

std::string in_tenths(double share) {
    return fmt::format("{:.1f} %", share * 100.0);
}

/// One row per axis and one per limit of the path, in percent of the time; each ends with a line end.
/// @param names  names of the axes, as many as there are in `shares`
std::string share_table(const std::vector<std::string>& names, const LimitShares& shares) {
    const bool any_jerk =
        std::ranges::any_of(shares.axis, [](const LimitShares::Axis& axis) { return axis.jerk.has_value(); });
    std::string text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "{:<22}{:>14}{:>14}{}\n", "share of the time at", "velocity", "acceleration",
                   any_jerk ? "          jerk" : "");
    for (std::size_t k = 0; k < shares.axis.size(); ++k) {
        const LimitShares::Axis& axis = shares.axis[k];
        fmt::format_to(out, "{:<22}{:>14}{:>14}", "  axis " + names[k], in_tenths(axis.velocity),
                       in_tenths(axis.acceleration));
        if (any_jerk) {
            fmt::format_to(out, "{:>14}", axis.jerk ? in_tenths(*axis.jerk) : "no limit");
        }
        fmt::format_to(out, "\n");
    }
    const auto row = [&out](const char* label, double share) {
        fmt::format_to(out, "{:<22}{:>14}\n", label, in_tenths(share));
    };
    row("  path feed", shares.feed);
    const std::pair<const char*, std::optional<double>> others[] = {{"  centripetal", shares.centripetal},
                                                                    {"  chord error", shares.chord}};
    const std::pair<const char*, double> asked[] = {
        {"  with an override", shares.override_feed}, {"  hold", shares.hold}, {"  dwell", shares.dwell}};
    for (const auto& [label, share] : asked) {
        if (share > 0.0) {
            row(label, share);
        }
    }
    for (const auto& [label, share] : others) {
        if (share) {
            row(label, *share);
        }
    }
    row("  no limit", shares.none);
    return text;
}

// A use above this is worth a sentence: the tolerance of the simulated machine.
constexpr double over_limit = 1.0 + 1e-6;

using Lines = std::back_insert_iterator<std::string>;

void row(Lines out, std::string_view label, const std::string& value, std::string_view unit) {
    fmt::format_to(out, "{:<22}{:>14}{}{}\n", label, value, unit.empty() ? "" : " ", unit);
}

// Lengths of a millionth of a millimetre are of interest and so are kilometres.
std::string fine(double value) {
    return fmt::format("{:.3g}", value);
}

std::string percent(double use) {
    return fmt::format("{:.2f} %", use * 100.0);
}

std::string plural(std::uint64_t n, std::string_view thing) {
    return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
}

// Of the optimum: how much longer the run takes.
std::string longer(const Summary& summary) {
    const double optimum = summary.optimum_time_s.value_or(0.0);
    return optimum > 0.0
               ? fmt::format("; this run takes {:.2f} % longer)", (summary.cycle_time_s / optimum - 1.0) * 100.0)
               : ")";
}

void write_limit_use(Lines out, const Summary& summary) {
    const auto& uses = summary.limit_use;
    const bool any_jerk = std::ranges::any_of(uses, [](const Summary::AxisUse& use) { return use.jerk.has_value(); });
    fmt::format_to(out, "\n{:<22}{:>14}{:>14}{}\n", "limits used", "velocity", "acceleration",
                   any_jerk ? "          jerk" : "");
    for (const Summary::AxisUse& use : uses) {
        fmt::format_to(out, "{:<22}{:>14}{:>14}", "  axis " + use.axis, percent(use.velocity),
                       percent(use.acceleration));
        if (any_jerk) {
            fmt::format_to(out, "{:>14}", use.jerk ? percent(*use.jerk) : "no limit");
        }
        fmt::format_to(out, "\n");
    }
}

void write_use_sentence(Lines out, const std::string& axis, std::string_view limit, double use) {
    if (use > over_limit) {
        fmt::format_to(out, "Axis {} is above its {} limit: {:.7g} of it.\n", axis, limit, use);
    }
}

std::vector<std::string> axis_names(const Summary& summary) {
    std::vector<std::string> names;
    for (const Summary::AxisUse& use : summary.limit_use) {
        names.push_back(use.axis);
    }
    return names;
}

void write_sentences(Lines out, const Summary& summary) {
    if (summary.stopped) {
        fmt::format_to(out, "The run was stopped before the end of the program.\n");
    }
    if (summary.events_not_reached > 0) {
        fmt::format_to(out, "The run was over before {} of the operator.\n",
                       plural(summary.events_not_reached, "event"));
    }
    if (summary.events > 0) {
        fmt::format_to(out, "It was steered: {} of the operator.\n", plural(summary.events, "event"));
    }
    if (!passes_waypoints(summary.curve)) {
        fmt::format_to(out,
                       "The waypoints are control points: the curve is drawn towards them and need not pass them.\n");
    }
    if (summary.tolerance && !summary.tolerance->excess.empty()) {
        fmt::format_to(out, "The tolerance was not kept: {}.\n", summary.tolerance->excess);
    }
    for (const Summary::AxisUse& use : summary.limit_use) {
        write_use_sentence(out, use.axis, "velocity", use.velocity);
        write_use_sentence(out, use.axis, "acceleration", use.acceleration);
        write_use_sentence(out, use.axis, "jerk", use.jerk.value_or(0.0));
    }
    const auto most = std::ranges::max_element(summary.limit_use, {}, &Summary::AxisUse::jerk_reserved);
    if (most != summary.limit_use.end() && most->jerk_reserved.value_or(0.0) > 0.01) {
        fmt::format_to(out,
                       "At this sample period {:.2g} % of the jerk limit of {} is kept for rounding: a longer one "
                       "keeps less.\n",
                       100.0 * *most->jerk_reserved, most->axis);
    }
    if (summary.window_limited > 0) {
        fmt::format_to(out, "The planning window was too short {}: a longer one may be faster.\n",
                       plural(summary.window_limited, "time"));
    }
    if (summary.slow_legs.value_or(0) > 0) {
        fmt::format_to(out, "No new plan was found in {} of {} searches, and the machine went on by the plan before.\n",
                       *summary.slow_legs, *summary.searched_legs);
    }
    if (summary.stops > 0) {
        fmt::format_to(out, "The machine stops at {} on the way, where the path turns sharply.\n",
                       plural(summary.stops, "corner"));
    }
}

// What is less than a tenth of a percent is not worth a row.
void write_help(Lines out, const Summary& summary) {
    constexpr double least = 0.0005;
    constexpr std::size_t most = 5;
    const std::uint64_t moves = summary.what_would_help->moves;
    const auto& all = summary.what_would_help->limits;
    if (all.empty() || all.front().gain < least) {
        fmt::format_to(out, "\nwhat would help       no limit alone: 10 % more of one saves less than 0.05 %\n");
        return;
    }
    fmt::format_to(out, "\n{:<22}{:>14}    10 % more of one limit, planned again{}\n", "what would help", "cycle time",
                   moves > 0 ? fmt::format(" for the first {} moves", moves) : std::string());
    for (std::size_t i = 0; i < std::min(most, all.size()) && all[i].gain >= least; ++i) {
        fmt::format_to(out, "{:<22}{:>14.6f} s  {:.1f} % less\n", "  " + all[i].limit, all[i].cycle_time_s,
                       100.0 * all[i].gain);
    }
    if (const RaisedLimit& first = all.front(); first.window > 0) {
        fmt::format_to(out, "  to try the first: --window {}\n", first.window);
    } else if (!first.setting.empty()) {
        fmt::format_to(out, "  to try the first: --set {}\n", first.setting);
    }
}

std::string at_place(const ToleranceSummary::Place& place) {
    return place.name.empty() ? std::string() : ", at " + place.name;
}

// "1.2 % less" than with exact stops; the estimate knows no sample period, so a run may take a little more.
std::string less_or_more(double time_s, double of_s) {
    constexpr double shown = 0.05; // [%] what is less than that is printed as 0.0
    const double saved = of_s > 0.0 ? 100.0 * (1.0 - time_s / of_s) : 0.0;
    return std::fabs(saved) < shown ? "as long"
                                    : fmt::format("{:.1f} % {}", std::fabs(saved), saved > 0.0 ? "less" : "more");
}

void write_tolerance(Lines out, const Summary& summary) {
    const ToleranceSummary& tolerance = *summary.tolerance;
    row(out, "deviation", fine(tolerance.deviation.distance), "mm at most" + at_place(tolerance.deviation));
    if (tolerance.rotary_deviation) {
        row(out, "rotary deviation", fine(tolerance.rotary_deviation->distance),
            "degrees at most" + at_place(*tolerance.rotary_deviation));
    }
    row(out, "joints", std::to_string(tolerance.blended),
        fmt::format("rounded, {} with a stop, {} straight on; chains {}", tolerance.stopped, tolerance.through,
                    tolerance.chains));
    row(out, "elements", std::to_string(tolerance.elements), fmt::format("to {} pieces", tolerance.pieces));
    row(out, "with exact stops", fmt::format("{:.3f}", tolerance.exact_stop_s),
        summary.stopped ? "s (estimated)"
                        : fmt::format("s (estimated; this run takes {})",
                                      less_or_more(summary.cycle_time_s, tolerance.exact_stop_s)));
}

} // namespace

std::string to_text(const Summary& summary) {
    std::string text;
    const Lines out(text);
    row(out, "cycle time", fmt::format("{:.6f}", summary.cycle_time_s), "s");
    if (summary.optimum_time_s) {
        row(out, "optimum", fmt::format("{:.6f}", *summary.optimum_time_s),
            "s (acceleration-limited" + longer(summary));
    }
    row(out, "path length", fmt::format("{:.6f}", summary.length_mm), "mm");
    row(out, "largest speed", fmt::format("{:.6f}", summary.max_speed_mm_s), "mm/s");
    if (summary.waypoint_error_mm) {
        row(out, "waypoint error", fine(*summary.waypoint_error_mm), "mm at most");
    }
    if (summary.tolerance) {
        write_tolerance(out, summary);
    }
    text += to_text(summary.program);
    row(out, "smoothing error", fine(summary.smoothing_bound_mm), "mm at most");
    row(out, summary.curve == "gcode" ? "moves" : "waypoints", std::to_string(summary.waypoints), "");
    row(out, "curve segments", std::to_string(summary.curve_segments), summary.curve);
    row(out, "feed segments", std::to_string(summary.feed_segments),
        summary.jerk_scalar.empty() ? summary.scalar : summary.scalar + ", planned in " + summary.jerk_scalar);
    row(out, "planning time", fmt::format("{:.3f}", summary.planning_time_s), "s");
    const Summary::MemoryBytes& memory = summary.memory_bytes;
    row(out, "planner's memory", std::to_string(memory.curve + memory.feed_plan + memory.stream),
        fmt::format("bytes (curve {}, feed plan {}, stream {})", memory.curve, memory.feed_plan, memory.stream));
    if (summary.peak_rss_bytes > 0) {
        row(out, "memory of the process",
            fmt::format("{:.1f}", static_cast<double>(summary.peak_rss_bytes) / 1048576.0), "MiB");
    }
    if (!summary.limit_use.empty()) {
        write_limit_use(out, summary);
    }
    if (summary.link) {
        text += '\n' + to_text(*summary.link);
    }
    if (summary.gpio) {
        text += '\n' + to_text(*summary.gpio);
    }
    if (summary.limit_share && summary.cycle_time_s > 0.0) {
        text += '\n' + share_table(axis_names(summary), *summary.limit_share);
    }
    if (summary.what_would_help) {
        write_help(out, summary);
    }
    std::string sentences;
    write_sentences(Lines(sentences), summary);
    if (!sentences.empty()) {
        text += '\n';
        text += sentences;
    }
    return text;
}

} // namespace splinefeed::host
