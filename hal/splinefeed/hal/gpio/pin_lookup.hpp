// SPDX-License-Identifier: MIT
// pin_lookup: converts line names to offsets, with helpful error messages. No I/O.
#pragma once

#include "splinefeed/hal/gpio/pin_request.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::hal::gpio {

/// Text path of the chip, for messages: "line 4 ('X_STEP')", without a name "line 4".
[[nodiscard]] std::string line_text(unsigned offset, std::string_view name);

/// Returns the offsets of the wanted lines.
/// @param chip  for messages
/// @param names  names of all lines of the chip, in order; empty for a line without a name
/// Throws GpioError if no line or more than 64 are wanted, a line does not exist, a name is ambiguous, name and offset
/// disagree, or a line is wanted twice.
[[nodiscard]] std::vector<unsigned> find_lines(const std::string& chip, std::span<const std::string> names,
                                               std::span<const PinName> wanted);

} // namespace splinefeed::hal::gpio
