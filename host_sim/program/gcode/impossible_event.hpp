// SPDX-License-Identifier: MIT
// impossible, impossible_move: what a real machine cannot do of what a program asks for.
#pragma once

#include "host_sim/program/gcode_settings.hpp"

#include "splinefeed/s0_program/words/program_event.hpp"
#include "splinefeed/s0_program/words/program_item.hpp"

#include <string>

namespace splinefeed::host {

/// Why the machine of these settings cannot do what an event asks for, and what would help: "mist_on: the machine file
/// has no line for this; name it in [coolant.mist], ...". Empty: it can.
[[nodiscard]] std::string impossible(const ProgramEvent& event, const GcodeSettings& settings);
/// The same of a move. A probe and a switch that nobody watches would be run into.
[[nodiscard]] std::string impossible_move(const ProgramItem<double>& item, Dialect dialect);

} // namespace splinefeed::host
