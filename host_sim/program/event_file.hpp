// SPDX-License-Identifier: MIT
// event_file: reads the actions of an operator during a program, with their times.
#pragma once

#include "host_sim/base/file_key.hpp"

#include <string>
#include <vector>

namespace splinefeed::host {

enum class Operation { hold, resume, abort, override_feed };

struct OperatorEvent {
    double time_s = 0.0;
    Operation operation = Operation::hold;
    double value = 0.0;     ///< for an override: factor of the programmed feed, 0 to 2
    std::uint64_t line = 0; ///< in its file
};

/// In the order of Operation.
inline constexpr std::string_view operation_names[] = {"hold", "resume", "abort", "override"};
inline constexpr FileKey operator_event_keys[] = {
    needed(number_key("t", 0, 86400, "s", "When it happens; rows are in order of time.")),
    needed(choice_key("event", operation_names, "What the operator does.")),
    number_key("value", 0, 2, "", "Of an override: what the programmed feed is multiplied by."),
};
/// A row of the file.
inline constexpr FileTable operator_event_table{
    "a row", operator_event_keys,
    R"({"if": {"properties": {"event": {"const": "override"}}}, "then": {"required": ["value"]},
        "else": {"not": {"required": ["value"]}}})"};

/// Rows `t,hold|resume|abort` and `t,override,value` in order of time; an optional header t,event,value; comments (#)
/// and blank lines. Throws InputError.
[[nodiscard]] std::vector<OperatorEvent> read_event_file(const std::string& path);

} // namespace splinefeed::host
