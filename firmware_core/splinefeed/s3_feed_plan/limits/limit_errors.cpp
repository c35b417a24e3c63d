// SPDX-License-Identifier: MIT
#include "splinefeed/s3_feed_plan/limits/limit_errors.hpp"

#include "splinefeed/base/sentence_table.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_numbers.hpp"

namespace splinefeed {

namespace {

struct LimitSentence {
    LimitError error;
    const char* text;
};

// What machine_numbers.hpp has no sentence for.
constexpr LimitSentence limit_sentences[] = {
    {LimitError::none, "no error"},
    {LimitError::axes_out_of_range, axes_sentence},
    {LimitError::segments_per_sample_invalid,
     "segments_per_sample must be 0 to 8 and divide the sample period into whole eighths of a us"},
    {LimitError::travel_end_incomplete,
     "travel_end_zone_mm needs travel_end_velocity_mm_s, and travel limits within +-1048576 mm that increase"},
    {LimitError::counts_out_of_range, "position times steps_per_mm must stay within +-2147483647 counts"},
    {LimitError::jerk_in_float,
     "float has too few digits for a jerk limit; compute in fixed or double, or leave max_jerk_mm_s3 out"},
    {LimitError::period_too_short,
     "the sample period is too short for the acceleration: rounding would use a quarter of the limit; use a longer "
     "sample_period_us, a higher acceleration or a finer scalar"},
};

} // namespace

const char* describe(LimitError error) noexcept {
    for (const auto& number : path_numbers) {
        if (number.error == error) {
            return number.sentence;
        }
    }
    for (const auto& number : axis_numbers) {
        if (number.error == error) {
            return number.sentence;
        }
    }
    for (const LimitSentence& sentence : limit_sentences) {
        if (sentence.error == error) {
            return sentence.text;
        }
    }
    return error == sample_period.error ? sample_period.sentence : "unknown error";
}

} // namespace splinefeed
