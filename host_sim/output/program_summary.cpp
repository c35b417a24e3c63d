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
    {text_row("what", "The word or line."),
     [](const Entry& entry) {
         return Json(entry.what);
     }},
    {count_row("count", "How often."),
     [](const Entry& entry) {
         return Json(entry.count);
     }},
    {count_row("line", "Where it is first."),
     [](const Entry& entry) {
         return Json(entry.line);
     }},
};

using Event = ProgramSummary::Event;
constexpr WrittenKey<Event> event_keys[] = {
    {number_row("t", "s", "When it happens."),
     [](const Event& event) {
         return Json(event.time_s);
     }},
    {text_row("what", "As element files name it."),
     [](const Event& event) {
         return Json(event.what);
     }},
    {not_always(count_row("line", "Of the program.")),
     [](const Event& event) {
         return event.line > 0 ? Json(event.line) : left_out();
     }},
    {{.key = "number", .kind = KeyKind::whole, .sentence = "Of a tool, an output."},
     [](const Event& event) {
         return event.number != 0 ? Json(event.number) : left_out();
     }},
    {{.key = "value", .kind = KeyKind::number, .sentence = "Of a spindle: 1/min."},
     [](const Event& event) {
         return event.value != 0.0 ? Json(event.value) : left_out();
     }},
    {not_always(text_row("text", "Of a message.")),
     [](const Event& event) {
         return event.text.empty() ? left_out() : Json(event.text);
     }},
};

constexpr WrittenKey<ProgramSummary> program_keys[] = {
    {not_always(text_row("dialect", "What --dialect auto takes, and why.")),
     [](const ProgramSummary& s) {
         return s.dialect.empty() ? left_out() : Json(s.dialect);
     }},
    {not_always(inside_row("left_out", "Words and lines that were not followed.")),
     [](const ProgramSummary& s) { return s.left_out.empty() ? left_out() : to_json(s.left_out); },
     [] {
         return list_schema(written_schema(left_out_keys));
     }},
    {count_row("dwells", "How many."),
     [](const ProgramSummary& s) {
         return Json(s.dwells);
     }},
    {number_row("dwell_s", "s", "All of them; the cycle time includes it."),
     [](const ProgramSummary& s) {
         return Json(s.dwell_s);
     }},
    {count_row("events", "All of them."),
     [](const ProgramSummary& s) {
         return Json(s.events);
     }},
    {nullable(count_row("line", "Of the last move or dwell that was begun, where the machine stands.")),
     [](const ProgramSummary& s) {
         return s.line > 0 ? Json(s.line) : Json(nullptr);
     }},
    {inside_row("first_events", "At most 1000."), [](const ProgramSummary& s) { return to_json(s.first_events); },
     [] {
         return list_schema(written_schema(event_keys));
     }},
};

} // namespace

Json to_json(const std::vector<Entry>& left_out_words) {
    Json list = Json::array();
    for (const Entry& entry : left_out_words) {
        list.push_back(written(entry, left_out_keys));
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
    return written(summary, program_keys);
}

Json program_schema() {
    return written_schema(program_keys);
}

Json to_json(const std::vector<Event>& events) {
    Json list = Json::array();
    for (const Event& event : events) {
        list.push_back(written(event, event_keys));
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
