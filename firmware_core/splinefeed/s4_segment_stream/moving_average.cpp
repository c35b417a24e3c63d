// SPDX-License-Identifier: MIT
#include "splinefeed/s4_segment_stream/moving_average.hpp"

namespace splinefeed {

void MovingAverage::reset(PathPosition place, std::uint32_t duration_q8) noexcept {
    SPLINEFEED_ASSERT(duration_q8 >= (1U << fraction_bits) && places_for(duration_q8) <= storage_.size());
    duration_q8_ = duration_q8;
    whole_ = duration_q8 >> fraction_bits;
    for (std::size_t i = 0; i <= whole_; ++i) {
        storage_[i] = place;
    }
    behind_ = {};
    next_ = 0;
    mean_ = newest_ = place;
}

// The ring holds the N newest positions and the one before, at next_. That one leaves, and the one after it becomes the
// partial one. The distances of all N to the newest grow by the last move; then the newest takes the place of the one
// that leaves.
void MovingAverage::push(PathPosition newest) noexcept {
    if (units_between(newest_, newest) < 0) { // rounding
        newest = newest_;
    }
    const std::uint64_t way = newest.raw - newest_.raw;
    newest_ = newest;
    storage_[next_] = newest;
    next_ = next_ == whole_ ? 0 : next_ + 1;
    const std::uint64_t oldest = newest.raw - storage_[next_].raw;
    behind_ = subtract(add(behind_, multiply(way, whole_)), Wide{0U, oldest});
    const std::uint64_t part = duration_q8_ & ((1U << fraction_bits) - 1U);
    const Wide all = add(shift_left(behind_, fraction_bits), multiply(oldest, part));
    const Wide rounded = add(all, Wide{0U, duration_q8_ / 2});
    mean_.raw = newest.raw - divide(rounded, duration_q8_).quotient;
}

} // namespace splinefeed
