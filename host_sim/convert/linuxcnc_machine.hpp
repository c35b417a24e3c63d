// SPDX-License-Identifier: MIT
// linuxcnc_sketch: the machine that an INI file of LinuxCNC describes.
#pragma once

#include "host_sim/convert/machine_answers.hpp"
#include "host_sim/convert/machine_sketch.hpp"

namespace splinefeed::host {

/// Throws InputError where a number is missing that a machine file needs, where one is wrong, and where the joints are
/// no axes. @param file  of the text, for messages
[[nodiscard]] MachineSketch linuxcnc_sketch(std::string_view text, const std::string& file, MachineAnswers& answers);

} // namespace splinefeed::host
