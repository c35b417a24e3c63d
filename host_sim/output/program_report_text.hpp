// SPDX-License-Identifier: MIT
// program_report_text: what `splinefeed check` prints.
#pragma once

#include "host_sim/analysis/program_report.hpp"

#include <string>
#include <vector>

namespace splinefeed::host {

/// @param problems  each one line; with one of them there is no plan, and so no time
[[nodiscard]] std::string check_text(const ProgramReport& report, const MachineDescription& machine,
                                     const std::vector<std::string>& problems, double cycle_time_s);
/// The same as one JSON object.
[[nodiscard]] std::string check_json(const ProgramReport& report, const MachineDescription& machine,
                                     const std::vector<std::string>& problems, double cycle_time_s);

} // namespace splinefeed::host
