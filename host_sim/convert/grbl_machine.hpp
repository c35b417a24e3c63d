// SPDX-License-Identifier: MIT
// grbl_sketch: the machine that a controller of the grbl family tells as its answer to $$.
#pragma once

#include "host_sim/convert/machine_sketch.hpp"

#include <string>
#include <string_view>

namespace splinefeed::host {

/// Of lines like `$110=8000.000`, with whatever a terminal writes before them, and a description behind. Other lines
/// are left out. Throws InputError where a number is missing that a machine file needs, where one has two values, and
/// where one is no number or out of range.
/// @param file  of the listing, for messages
[[nodiscard]] MachineSketch grbl_sketch(std::string_view listing, const std::string& file);

} // namespace splinefeed::host
