// SPDX-License-Identifier: MIT
// event_file: what an operator does while a program runs, and when.
#pragma once

#include <string>
#include <vector>

namespace splinefeed::host {

enum class Operation { hold, resume, abort, override_feed };

struct OperatorEvent {
    double time_s = 0.0;
    Operation operation = Operation::hold;
    double value = 0.0;     ///< of an override: factor of the programmed feed, 0 to 2
    std::uint64_t line = 0; ///< in its file
};

/// Rows `t,hold|resume|abort` and `t,override,value` in order of time; an optional header t,event,value; comments (#)
/// and blank lines. Throws InputError.
[[nodiscard]] std::vector<OperatorEvent> read_event_file(const std::string& path);

} // namespace splinefeed::host
