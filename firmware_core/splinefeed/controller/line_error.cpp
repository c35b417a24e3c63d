// SPDX-License-Identifier: MIT
#include "splinefeed/controller/line_error.hpp"

namespace splinefeed {

namespace {

// In a struct: its names stay in it where sources are compiled as one.
struct LineErrorTable {
    using enum ProgramError;
    struct Row {
        ProgramError error;
        LineError number;
    };
    static constexpr Row rows[] = {
        {line_too_long, LineError::too_long},
        {character_invalid, LineError::expected_letter},
        {number_invalid, LineError::bad_number},
        {number_has_exponent, LineError::bad_number},
        {word_repeated, LineError::word_twice},
        {modal_group_conflict, LineError::modal_conflict},
        {axis_words_twice, LineError::axis_words_twice},
        {axis_words_missing, LineError::axis_words_missing},
        {axis_word_unused, LineError::unused_words},
        {word_unused, LineError::unused_words},
        {integer_needed, LineError::not_an_integer},
        {feed_missing, LineError::feed_missing},
        {inverse_feed_missing, LineError::feed_missing},
        {g10_invalid, LineError::value_missing},
        {dwell_invalid, LineError::value_missing},
        {g92_axes_missing, LineError::axis_words_missing},
        {arc_axes_unsuited, LineError::arc_axes},
        {arc_centre_missing, LineError::arc_offsets},
        {arc_centre_and_radius, LineError::unused_words},
        {arc_radius_zero, LineError::bad_target},
        {arc_radius_too_small, LineError::arc_radius},
        {arc_radius_mismatch, LineError::bad_target},
        {arc_end_is_start, LineError::bad_target},
        {probe_too_short, LineError::bad_target},
        {position_out_of_range, LineError::bad_target},
        {move_too_long, LineError::bad_target},
        {points_too_far, LineError::bad_target},
        {number_out_of_range, LineError::bad_range},
        {result_out_of_range, LineError::bad_range},
        {feed_out_of_range, LineError::bad_range},
        {tolerance_out_of_range, LineError::bad_range},
        {feed_negative, LineError::bad_range},
        {speed_negative, LineError::bad_range},
        {jog_word_unsuited, LineError::jog_word},
        {grbl_command_unsupported, LineError::unknown_command},
    };
};

} // namespace

LineError line_error_of(ProgramError error) noexcept {
    for (const LineErrorTable::Row& row : LineErrorTable::rows) {
        if (row.error == error) {
            return row.number;
        }
    }
    return LineError::unsupported_word;
}

} // namespace splinefeed
