// SPDX-License-Identifier: MIT
// parse_line: a line from the host to a command. docs/reference/firmware_protocol.md lists them.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/number/position.hpp"
#include "splinefeed/s0_program/text/decimal.hpp"
#include "splinefeed/s1_curve/waypoint.hpp"

#include <string_view>

namespace firmware {

enum class Verb : std::uint8_t {
    nothing, ///< an empty line, a comment, a header of columns
    waypoint,
    end,
    at,
    feed,
    reset,
    memory,
    stall,
    invalid
};

struct Command {
    Verb verb = Verb::nothing;
    splinefeed::PerAxis<splinefeed::Position> position{};      ///< waypoint, at
    splinefeed::Decimal number{};                              ///< waypoint: mm/s, 0: not stated; feed: percent
    splinefeed::Corner corner = splinefeed::Corner::automatic; ///< waypoint
    const char* error = nullptr;                               ///< invalid: what is wrong, what would be right
};

/// @param line  without its line end
[[nodiscard]] Command parse_line(std::string_view line, unsigned axes) noexcept;

} // namespace firmware
