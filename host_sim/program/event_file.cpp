// SPDX-License-Identifier: MIT
#include "host_sim/program/event_file.hpp"

#include "host_sim/base/input_error.hpp"
#include "host_sim/base/nearest_name.hpp"
#include "host_sim/base/number_text.hpp"
#include "host_sim/base/text_file.hpp"
#include "host_sim/base/trimmed_text.hpp"

#include <algorithm>

namespace splinefeed::host {

namespace {

constexpr std::size_t largest_file = std::size_t{1} << 24;

/// A number in the range of the row; false otherwise.
bool take_number(std::string_view text, const FileKey& row, double& out) {
    return read_number(text, out) == NumberText::number && out >= row.low && out <= row.high;
}

OperatorEvent event_of(const std::vector<std::string_view>& fields, const std::string& path, std::uint64_t line,
                       double before_s) {
    OperatorEvent event;
    event.line = line;
    if (const FileKey& row = operator_event_table.row("t"); !take_number(fields[0], row, event.time_s)) {
        throw InputError(path, line, "{}: the time must be a number of seconds, {} to {}", in_quotes(fields[0]),
                         row.low, row.high);
    }
    if (event.time_s < before_s) {
        throw InputError(path, line, "{} s is before the event above, at {} s; put the rows in order of time",
                         event.time_s, before_s);
    }
    if (fields.size() < 2 || fields[1].empty()) {
        throw InputError(path, line, "the row has a time only; it must be like 0.5,hold or 0.5,override,0.8");
    }
    const auto* const name = std::ranges::find(operation_names, fields[1]);
    if (name == std::end(operation_names)) {
        throw InputError(path, line, "there is no event {}{}", in_quotes(fields[1]),
                         suggestion(fields[1], operation_names));
    }
    event.operation = static_cast<Operation>(name - operation_names);
    const bool has_value = fields.size() > 2 && !fields[2].empty();
    if (fields.size() > 3) {
        throw InputError(path, line, "the row has {} fields; it must be like 0.5,hold or 0.5,override,0.8",
                         fields.size());
    }
    if (event.operation != Operation::override_feed && has_value) {
        throw InputError(path, line, "{} takes no value; leave {} out", fields[1], in_quotes(fields[2]));
    }
    const FileKey& row = operator_event_table.row("value");
    if (event.operation == Operation::override_feed && !(has_value && take_number(fields[2], row, event.value))) {
        throw InputError(path, line, "{}: the value of an override must be a number from {} to {}",
                         in_quotes(has_value ? fields[2] : ""), row.low, row.high);
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
        std::vector<std::string_view> fields = split(row, ',');
        std::ranges::transform(fields, fields.begin(), trimmed);
        const bool header = first && fields[0] == "t";
        first = false;
        if (!header) {
            events.push_back(event_of(fields, path, line, events.empty() ? 0.0 : events.back().time_s));
        }
    }
    return events;
}

} // namespace splinefeed::host
