// SPDX-License-Identifier: MIT
// serve_settings: a machine file as a controller is told of it.
#pragma once

#include "host_sim/ports/run_target.hpp"
#include "host_sim/run/run_machine.hpp"

#include "splinefeed/controller/controller_settings.hpp"

namespace splinefeed::host {

/// Texts refer to the machine and its switches, which must outlive the settings. Throws UsageError where senders could
/// not show the machine's axes.
[[nodiscard]] ControllerSettings serve_settings(const RunMachine& machine_of_run, const SwitchFacts& switches);

} // namespace splinefeed::host
