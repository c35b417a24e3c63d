// SPDX-License-Identifier: MIT
// LineError: the numbers by which lines are refused.
#pragma once

#include "splinefeed/s0_program/text/program_errors.hpp"

#include <cstdint>

namespace splinefeed {

/// grbl 1.1's numbers; above 38 grblHAL's.
enum class LineError : std::uint8_t {
    none = 0,
    expected_letter = 1,
    bad_number = 2,
    unknown_command = 3,
    no_homing = 5,
    not_now = 8, ///< only in Idle
    locked = 9,  ///< alarm, jog, or a line behind one that was refused
    too_long = 11,
    start_up_too_long = 14,
    jog_word = 16,
    unsupported_word = 20,
    modal_conflict = 21,
    feed_missing = 22,
    not_an_integer = 23,
    axis_words_twice = 24,
    word_twice = 25,
    axis_words_missing = 26,
    value_missing = 28,
    arc_axes = 32,
    bad_target = 33,
    arc_radius = 34,
    arc_offsets = 35,
    unused_words = 36,
    bad_range = 39,
    emergency_stop = 50,
    setting_disabled = 53,
};

/// The number for an error of G-code.
[[nodiscard]] LineError line_error_of(ProgramError error) noexcept;

} // namespace splinefeed
