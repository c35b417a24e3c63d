// SPDX-License-Identifier: MIT
// line_lookup: names of lines to offsets, and what to say where that fails. No I/O.
#pragma once

#include "splinefeed/hal/gpio/line_request.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::hal::gpio {

/// "line 4 ('X_STEP')", without a name "line 4".
[[nodiscard]] std::string line_text(unsigned offset, std::string_view name);

/// The offsets of the lines that are wanted.
/// @param chip  for messages
/// @param names  of all lines of the chip, in order; empty where one has none
/// Throws GpioError where none or more than 64 are wanted, a line is not there, a name is there twice and no offset
/// says which, the name at the offset is another one, or two of those wanted are the same line.
[[nodiscard]] std::vector<unsigned> find_lines(const std::string& chip, std::span<const std::string> names,
                                               std::span<const LineName> wanted);

} // namespace splinefeed::hal::gpio
