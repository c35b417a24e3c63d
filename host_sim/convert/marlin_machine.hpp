// SPDX-License-Identifier: MIT
// marlin_sketch: the machine that Marlin tells as its answer to M503.
#pragma once

#include "host_sim/convert/machine_sketch.hpp"

namespace splinefeed::host {

/// Whether a text looks like such an answer: a line with M92, and one with M203.
[[nodiscard]] bool is_marlin_listing(std::string_view text);

/// Of lines like `echo:  M203 X300 Y300 Z5 E25`, with whatever a terminal writes before them. Throws InputError where a
/// number is missing that a machine file needs, where one has two values, and where one is wrong.
/// @param file  of the text, for messages
[[nodiscard]] MachineSketch marlin_sketch(std::string_view text, const std::string& file);

} // namespace splinefeed::host
