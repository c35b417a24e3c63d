// SPDX-License-Identifier: MIT
// fit_to_target: a machine with limits and segments that its target carries.
#pragma once

#include "host_sim/planning/machine_limits.hpp"
#include "host_sim/ports/run_target.hpp"

namespace splinefeed::host {

/// The limits with segments that the lines carry: those of the machine file, or longer ones. Then nothing is lost but
/// smoothness in space, which the summary states. Checks that the target can carry the machine. Throws UsageError.
/// @param quiet  leaves out notes about it
[[nodiscard]] PlanFigures fit_to_target(MachineDescription& machine, ScalarKind scalar, const RunTarget& target,
                                        bool quiet);

} // namespace splinefeed::host
