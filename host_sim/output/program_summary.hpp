// SPDX-License-Identifier: MIT
// ProgramSummary: what a program asked for besides motion, and when it happened.
#pragma once

#include "host_sim/program/left_out_list.hpp"

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace splinefeed::host {

struct ProgramSummary {
    /// The first ones are kept, so the memory of an endless program is bounded.
    static constexpr std::size_t most_events = 1000;

    struct Event {
        double time_s = 0.0;
        std::uint64_t line = 0; ///< 0: unknown
        std::string what;       ///< as element files name it
        std::int32_t number = 0;
        double value = 0.0;
        std::string text;
    };
    std::uint64_t dwells = 0;
    double dwell_s = 0.0;     ///< as programmed
    std::uint64_t events = 0; ///< all of them
    std::vector<Event> first_events;
    std::vector<LeftOutList::Entry> left_out; ///< words and lines that were not followed
    std::string dialect;                      ///< that --dialect auto takes, and why; else empty
    std::uint64_t line = 0; ///< of the last move or dwell that was begun, where the machine stands; 0: unknown

    [[nodiscard]] bool empty() const noexcept {
        return dwells == 0 && events == 0 && line == 0 && left_out.empty() && dialect.empty();
    }
};

[[nodiscard]] nlohmann::ordered_json to_json(const ProgramSummary& summary);
[[nodiscard]] nlohmann::ordered_json program_schema();
/// [{"t": 1.5, "what": "change_tool", "line": 4, "number": 2}, ...]: members that say nothing are left out.
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<ProgramSummary::Event>& events);
/// [{"what": "M104", "count": 3, "line": 5}, ...]
[[nodiscard]] nlohmann::ordered_json to_json(const std::vector<LeftOutList::Entry>& left_out);
/// "left out: M104 3 times, first on line 5; E 200 times, first on line 12". Empty: nothing was.
[[nodiscard]] std::string to_text(const std::vector<LeftOutList::Entry>& left_out);
/// Rows for the table of a summary.
[[nodiscard]] std::string to_text(const ProgramSummary& summary);

} // namespace splinefeed::host
