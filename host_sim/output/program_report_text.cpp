// SPDX-License-Identifier: MIT
#include "host_sim/output/program_report_text.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/output/program_summary.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace splinefeed::host {

using Json = nlohmann::ordered_json;

namespace {

constexpr std::size_t most_slow_lines = 10;

std::string range(const AxisBox& box, unsigned k) {
    return box.empty ? "-" : fmt::format("{:.3f} to {:.3f}", box.low[k], box.high[k]);
}

const char* what_bound(const ProgramReport::Line& line) {
    const double most = std::max({line.feed_s, line.velocity_s, line.acceleration_s});
    return most <= 0.0               ? "no limit"
           : most == line.feed_s     ? "its feed"
           : most == line.velocity_s ? "the velocity of an axis"
                                     : "the acceleration of an axis";
}

std::string totals_row(std::string_view name, const MoveTotal& total) {
    return fmt::format("{:<22}{:>12.3f} mm{:>12.3f} s{:>10} moves\n", name, total.length_mm, total.seconds,
                       total.moves);
}

Json totals_json(const MoveTotal& total) {
    return {{"length_mm", total.length_mm}, {"time_s", total.seconds}, {"moves", total.moves}};
}

Json box_json(const AxisBox& box, const MachineDescription& machine) {
    Json object = Json::object();
    for (unsigned k = 0; !box.empty && k < static_cast<unsigned>(machine.settings.axes); ++k) {
        object[machine.axis_name[k]] = {box.low[k], box.high[k]};
    }
    return object;
}

} // namespace

std::string check_text(const ProgramReport& report, const MachineDescription& machine,
                       const ProgramFindings& findings) {
    std::string text;
    for (const std::string& problem : findings.problems) {
        text += printable(problem) + "\n";
    }
    text += fmt::format("{}{} problem{}\n", findings.problems.empty() ? "" : "\n", findings.problem_count,
                        findings.problem_count == 1 ? "" : "s");
    for (const std::string& note : findings.notes) {
        text += printable(note) + "\n";
    }
    text += to_text(findings.left_out) + "\n";
    text += fmt::format("{:<6}{:>28}{:>28}{:>28}\n", "axis", "feeds", "rapids", "travel");
    for (const unsigned k : indices(machine.settings.axes)) {
        const auto& travel = machine.travel[k];
        text += fmt::format("{:<6}{:>28}{:>28}{:>28}\n", machine.axis_name[k], range(report.feed_box(), k),
                            range(report.rapid_box(), k),
                            travel ? fmt::format("{:.3f} to {:.3f}", travel->low, travel->high) : "no limit");
    }
    if (!findings.problems.empty()) {
        return text;
    }
    text += fmt::format("\n{:<22}{:>12.3f} s\n", "cycle time", findings.cycle_time_s);
    text += totals_row("feeds", report.feeds());
    text += totals_row("rapids", report.rapids());
    text += fmt::format("{:<22}{:>27.3f} s\n", "dwells", report.dwell_s());
    for (const auto& [number, total] : report.tools()) {
        text += totals_row(number > 0 ? fmt::format("tool {}", number) : "no tool", total);
    }
    text += "\nlines that take most time\n";
    for (const ProgramReport::Line& line : report.slowest(most_slow_lines)) {
        text += fmt::format("  line {:<10}{:>12.3f} s   limited by {}\n", line.line, line.seconds, what_bound(line));
    }
    return text;
}

std::string check_json(const ProgramReport& report, const MachineDescription& machine,
                       const ProgramFindings& findings) {
    Json object;
    object["problems"] = findings.problems;
    object["problem_count"] = findings.problem_count;
    object["notes"] = findings.notes;
    object["left_out"] = to_json(findings.left_out);
    object["feed_box"] = box_json(report.feed_box(), machine);
    object["rapid_box"] = box_json(report.rapid_box(), machine);
    object["travel"] = Json::object();
    for (const unsigned k : indices(machine.settings.axes)) {
        if (machine.travel[k]) {
            object["travel"][machine.axis_name[k]] = {machine.travel[k]->low, machine.travel[k]->high};
        }
    }
    if (findings.problems.empty()) {
        object["cycle_time_s"] = findings.cycle_time_s;
        object["feeds"] = totals_json(report.feeds());
        object["rapids"] = totals_json(report.rapids());
        object["dwell_s"] = report.dwell_s();
        object["tools"] = Json::object();
        for (const auto& [number, total] : report.tools()) {
            object["tools"][std::to_string(number)] = totals_json(total);
        }
        object["slowest_lines"] = Json::array();
        for (const ProgramReport::Line& line : report.slowest(most_slow_lines)) {
            object["slowest_lines"].push_back(
                Json{{"line", line.line}, {"time_s", line.seconds}, {"limit", what_bound(line)}});
        }
    }
    return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace splinefeed::host
