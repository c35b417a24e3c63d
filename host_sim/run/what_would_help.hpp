// SPDX-License-Identifier: MIT
// what_would_help: how long a run would take if one of its limits were higher.
#pragma once

#include "host_sim/output/summary.hpp"
#include "host_sim/planning/planned_path.hpp"
#include "host_sim/program/path_input.hpp"
#include "host_sim/run/run_machine.hpp"

namespace splinefeed::host {

/// Of the run. All that it points to must outlive the call.
struct HelpArguments {
    const PathArguments* path = nullptr;
    const RunMachine* machine = nullptr;
    const MachineState* begins = nullptr;
    PlannerChoice planner;
    double standing_s = 0.0; ///< part of the cycle time that is none of the plan: dwells
    std::optional<std::uint64_t> waypoints;
    bool quiet = false;
};

/// Raises each limit that bound by a tenth, one at a time, and plans the program again, in double; and with a window of
/// four times as many cells, where it may have been too short. The largest gain
/// first. Costs as much as so many plans; of a program in G-code its first 10,000 moves stand for all. Progress is
/// shown. Throws InputError and UsageError.
/// @pre the input can be read again, and the run was neither stopped nor steered
[[nodiscard]] LimitAdvice what_would_help(const HelpArguments& arguments, const Summary& summary);

} // namespace splinefeed::host
