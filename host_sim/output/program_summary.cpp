// SPDX-License-Identifier: MIT
#include "host_sim/output/program_summary.hpp"

#include "host_sim/base/input_error.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace splinefeed::host {

using Json = nlohmann::ordered_json;

Json to_json(const std::vector<LeftOutList::Entry>& left_out) {
    Json list = Json::array();
    for (const LeftOutList::Entry& entry : left_out) {
        list.push_back(Json{{"what", entry.what}, {"count", entry.count}, {"line", entry.line}});
    }
    return list;
}

std::string to_text(const std::vector<LeftOutList::Entry>& left_out) {
    std::string text;
    for (const LeftOutList::Entry& entry : left_out) {
        text += entry.count == 1
                    ? fmt::format("{}{} on line {}", text.empty() ? "" : "; ", printable(entry.what), entry.line)
                    : fmt::format("{}{} {} times, first on line {}", text.empty() ? "" : "; ", printable(entry.what),
                                  entry.count, entry.line);
    }
    return text.empty() ? text : "left out: " + text + "\n";
}

Json to_json(const ProgramSummary& summary) {
    Json object;
    if (!summary.dialect.empty()) {
        object["dialect"] = summary.dialect;
    }
    if (!summary.left_out.empty()) {
        object["left_out"] = to_json(summary.left_out);
    }
    object["dwells"] = summary.dwells;
    object["dwell_s"] = summary.dwell_s;
    object["events"] = summary.events;
    object["line"] = summary.line > 0 ? Json(summary.line) : Json(nullptr);
    object["first_events"] = to_json(summary.first_events);
    return object;
}

Json to_json(const std::vector<ProgramSummary::Event>& events) {
    Json list = Json::array();
    for (const ProgramSummary::Event& event : events) {
        Json entry{{"t", event.time_s}, {"what", event.what}};
        if (event.line > 0) {
            entry["line"] = event.line;
        }
        if (event.number != 0) {
            entry["number"] = event.number;
        }
        if (event.value != 0.0) {
            entry["value"] = event.value;
        }
        if (!event.text.empty()) {
            entry["text"] = event.text;
        }
        list.push_back(std::move(entry));
    }
    return list;
}

std::string to_text(const ProgramSummary& summary) {
    std::string text;
    if (summary.dwells > 0) {
        text += fmt::format("{:<22}{:>14} s in all: {}\n", "dwells", fmt::format("{:.6g}", summary.dwell_s),
                            summary.dwells);
    }
    if (summary.events > 0) {
        text += fmt::format("{:<22}{:>14} of the program\n", "events", summary.events);
    }
    if (!summary.dialect.empty()) {
        text += printable(summary.dialect) + "\n";
    }
    return text + to_text(summary.left_out);
}

} // namespace splinefeed::host
