// SPDX-License-Identifier: MIT
#include "host_sim/program/event_file.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/base/text_file.hpp"
#include "host_sim/base/trimmed_text.hpp"

#include <array>
#include <fmt/format.h>

namespace splinefeed::host {

namespace {

constexpr std::size_t largest_file = std::size_t{1} << 24;
constexpr double longest_s = 86400.0;
constexpr std::array<std::string_view, 4> words{"hold", "resume", "abort", "override"};
constexpr std::array<Operation, 4> operations{Operation::hold, Operation::resume, Operation::abort,
                                              Operation::override_feed};

std::vector<std::string_view> fields_of(std::string_view line) {
    std::vector<std::string_view> fields;
    for (;;) {
        const std::size_t comma = line.find(',');
        fields.push_back(trimmed(line.substr(0, comma)));
        if (comma == std::string_view::npos) {
            return fields;
        }
        line.remove_prefix(comma + 1);
    }
}

/// A number in the range; false otherwise.
bool take_number(std::string_view text, double most, double& out) {
    return read_number(text, out) == NumberText::number && out >= 0.0 && out <= most;
}

OperatorEvent event_of(const std::vector<std::string_view>& fields, const std::string& path, std::uint64_t line,
                       double before_s) {
    const auto refuse = [&](const std::string& text) {
        throw InputError(path, line, text);
    };
    OperatorEvent event;
    event.line = line;
    if (!take_number(fields[0], longest_s, event.time_s)) {
        refuse(fmt::format("{}: the time must be a number of seconds, 0 to 86400", in_quotes(fields[0])));
    }
    if (event.time_s < before_s) {
        refuse(fmt::format("{} s is before the event above, at {} s; put the rows in order of time", event.time_s,
                           before_s));
    }
    if (fields.size() < 2 || fields[1].empty()) {
        refuse("the row has a time only; it must be like 0.5,hold or 0.5,override,0.8");
    }
    std::size_t i = 0;
    while (i < words.size() && fields[1] != words[i]) {
        ++i;
    }
    if (i == words.size()) {
        refuse(fmt::format("there is no event {}{}", in_quotes(fields[1]), suggestion(fields[1], words)));
    }
    event.operation = operations[i];
    const bool has_value = fields.size() > 2 && !fields[2].empty();
    if (fields.size() > 3) {
        refuse(fmt::format("the row has {} fields; it must be like 0.5,hold or 0.5,override,0.8", fields.size()));
    }
    if (event.operation != Operation::override_feed && has_value) {
        refuse(fmt::format("{} takes no value; leave {} out", fields[1], in_quotes(fields[2])));
    }
    if (event.operation == Operation::override_feed && !(has_value && take_number(fields[2], 2.0, event.value))) {
        refuse(fmt::format("{}: the value of an override must be a number from 0 to 2",
                           in_quotes(has_value ? fields[2] : "")));
    }
    return event;
}

} // namespace

std::vector<OperatorEvent> read_event_file(const std::string& path) {
    const std::string text = read_text_file(path, largest_file);
    std::vector<OperatorEvent> events;
    std::string_view rest = text;
    bool first = true;
    for (std::uint64_t line = 1; !rest.empty(); ++line) {
        const std::size_t end = rest.find('\n');
        const std::string_view row = trimmed(rest.substr(0, end));
        rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
        if (row.empty() || row.front() == '#') {
            continue;
        }
        const std::vector<std::string_view> fields = fields_of(row);
        const bool header = first && fields[0] == "t";
        first = false;
        if (!header) {
            events.push_back(event_of(fields, path, line, events.empty() ? 0.0 : events.back().time_s));
        }
    }
    return events;
}

} // namespace splinefeed::host
