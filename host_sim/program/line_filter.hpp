// SPDX-License-Identifier: MIT
// LineFilter: leaves out the lines of a program that are no G-code, as the user says or as the controller does.
#pragma once

#include "host_sim/program/gcode_settings.hpp"
#include "host_sim/program/left_out_list.hpp"

#include <string_view>

namespace splinefeed::host {

/// The name that a line begins with, which is no word of G-code: START_PRINT, EXCLUDE_OBJECT_END. Empty: there is none.
[[nodiscard]] std::string_view macro_name(std::string_view line) noexcept;

/// Whether lines of the dialect may be macros: a name with its words.
[[nodiscard]] constexpr bool has_macros(Dialect dialect) noexcept {
    return dialect == Dialect::klipper;
}

/// Whether the line is a macro that Klipper knows, and that moves nothing.
[[nodiscard]] bool is_still_macro(std::string_view name) noexcept;

/// By its first word: a macro, a $ command, or what the settings name.
/// @param pattern  in capitals; a * at its end is any rest
[[nodiscard]] bool fits(std::string_view pattern, std::string_view word) noexcept;

/// What of the line tells that it is left out: its first word. Empty: it is read, or is a kept_line().
[[nodiscard]] std::string_view left_out_line(std::string_view line, const GcodeSettings& settings) noexcept;

} // namespace splinefeed::host
