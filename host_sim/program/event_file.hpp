// SPDX-License-Identifier: MIT
// event_file: reads the actions of an operator during a program, with their times.
#pragma once

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

/// Rows `t,hold|resume|abort` and `t,override,value` in order of time; an optional header t,event,value; comments (#)
/// and blank lines. Throws InputError.
[[nodiscard]] std::vector<OperatorEvent> read_event_file(const std::string& path);

} // namespace splinefeed::host
