// SPDX-License-Identifier: MIT
// program_report_text: what `splinefeed check` prints.
#pragma once

#include "host_sim/analysis/program_report.hpp"
#include "host_sim/program/left_out_list.hpp"

#include <string>
#include <vector>

namespace splinefeed::host {

/// What was found besides the moves.
struct ProgramFindings {
    std::vector<std::string> problems{}; ///< each one line; with one of them there is no plan, and so no time
    std::uint64_t problem_count = 0;     ///< of all places
    std::vector<std::string> notes{};    ///< what is no problem, and should be known
    std::vector<LeftOutList::Entry> left_out{};
    double cycle_time_s = 0.0;
};

[[nodiscard]] std::string check_text(const ProgramReport& report, const MachineDescription& machine,
                                     const ProgramFindings& findings);
/// The same as one JSON object.
[[nodiscard]] std::string check_json(const ProgramReport& report, const MachineDescription& machine,
                                     const ProgramFindings& findings);

} // namespace splinefeed::host
