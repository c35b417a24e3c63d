// SPDX-License-Identifier: MIT
#include "host_sim/output/program_summary.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/output/written_key.hpp"

#include <fmt/format.h>

namespace splinefeed::host {

using Json = nlohmann::ordered_json;

namespace {

using Entry = LeftOutList::Entry;
constexpr WrittenKey<Entry> left_out_keys[] = {
    text<&Entry::what>("what", "The word or line."),
    count<&Entry::count>("count", "How often."),
    count<&Entry::line>("line", "Where it is first."),
};

using Event = ProgramSummary::Event;
constexpr WrittenKey<Event> event_keys[] = {
    quantity<&Event::time_s>("t", "s", "When it happens."),
    text<&Event::what>("what", "As element files name it."),
    if_any(count<&Event::line>("line", "Of the program.")),
    if_any(formed<&Event::number>("number", R"({"type": "integer"})", "Of a tool, an output.")),
    if_any(quantity<&Event::value>("value", "", "Of a spindle: 1/min.")),
    if_any(text<&Event::text>("text", "Of a message.")),
};

using Program = ProgramSummary;
constexpr WrittenKey<Program> program_keys[] = {
    if_any(text<&Program::dialect>("dialect", "What --dialect auto takes, and why.")),
    if_any(objects<&Program::left_out, left_out_keys>("left_out", "Words and lines that were not followed.")),
    count<&Program::dwells>("dwells", "How many."),
    quantity<&Program::dwell_s>("dwell_s", "s", "All of them; the cycle time includes it."),
    count<&Program::events>("events", "All of them."),
    or_null(count<&Program::line>("line", "Of the last move or dwell that was begun, where the machine stands.")),
    objects<&Program::first_events, event_keys>("first_events", "At most 1000."),
};

} // namespace

Json to_json(const std::vector<Entry>& left_out_words) {
    return written_list(left_out_words, left_out_keys);
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
    return written(summary, program_keys);
}

Json program_schema() {
    return written_schema(program_keys);
}

Json to_json(const std::vector<Event>& events) {
    return written_list(events, event_keys);
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
