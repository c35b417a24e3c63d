// SPDX-License-Identifier: MIT
// core_settings: what the interpreter of the core and ProgramFlow get of a program's settings and lines.
#pragma once

#include "host_sim/program/gcode/flow_code.hpp"
#include "host_sim/program/gcode_settings.hpp"

#include "splinefeed/s0_program/words/fanuc_words.hpp"

namespace splinefeed::host {

/// @param from  must outlive the interpreter
/// @param tools  null: none
/// @param fanuc  for that dialect
[[nodiscard]] ProgramSettings core_settings(const GcodeSettings& from, const MachineTools* tools, FanucWords& fanuc);

/// What leads from line to line in it. @param coolant  must outlive whoever follows it
[[nodiscard]] FlowRules flow_rules(const GcodeSettings& settings, const CoolantState& coolant);

} // namespace splinefeed::host
