// SPDX-License-Identifier: MIT
// klipper_sketch: the machine that a printer.cfg of Klipper describes.
#pragma once

#include "host_sim/convert/machine_sketch.hpp"

namespace splinefeed::host {

/// Throws InputError where a number is missing that a machine file needs, where one is wrong, and of machines whose
/// axes are not x, y and z: delta and others. @param file  of the text, for messages
[[nodiscard]] MachineSketch klipper_sketch(std::string_view text, const std::string& file);

} // namespace splinefeed::host
