// SPDX-License-Identifier: MIT
// make_simulated_tool: the simulated machine in real time, for a controller.
#pragma once

#include "host_sim/serve/served_machine.hpp"

namespace splinefeed::host {

/// A machine that executes each segment when its time has passed. Where segments come late the motion waits.
/// @param position  where it stands [mm]   @param known  whether that is so
[[nodiscard]] std::unique_ptr<ServedMachine> make_simulated_tool(const MachineDescription& machine,
                                                                 int segments_per_sample,
                                                                 const PerAxis<double>& position, bool known);

} // namespace splinefeed::host
