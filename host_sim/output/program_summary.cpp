// SPDX-License-Identifier: MIT
#include "host_sim/output/program_summary.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

nlohmann::ordered_json to_json(const ProgramSummary& summary) {
    using Json = nlohmann::ordered_json;
    Json json;
    json["dwells"] = summary.dwells;
    json["dwell_s"] = summary.dwell_s;
    json["events"] = summary.events;
    json["line"] = summary.line > 0 ? Json(summary.line) : Json(nullptr);
    json["first_events"] = Json::array();
    for (const ProgramSummary::Event& event : summary.first_events) {
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
        json["first_events"].push_back(std::move(entry));
    }
    return json;
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
    return text;
}

} // namespace splinefeed::host
