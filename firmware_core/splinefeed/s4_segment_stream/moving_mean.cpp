// SPDX-License-Identifier: MIT
#include "splinefeed/s4_segment_stream/moving_mean.hpp"

namespace splinefeed {

void MovingMean::reset(Position place, std::uint32_t duration_q8) noexcept {
    SPLINEFEED_ASSERT(duration_q8 >= (1U << fraction_bits) && places_for(duration_q8) <= storage_.size());
    duration_q8_ = duration_q8;
    whole_ = duration_q8 >> fraction_bits;
    for (std::size_t i = 0; i <= whole_; ++i) {
        storage_[i] = place;
    }
    sum_ = static_cast<std::uint64_t>(place.raw) * whole_;
    next_ = 0;
    mean_ = newest_ = place;
}

// The ring holds the N newest and the one before, at next_: that one leaves, and the one behind it becomes the partial.
void MovingMean::push(Position newest) noexcept {
    newest.raw = larger(newest.raw, newest_.raw); // lest rounding go back, and the sums wrap
    newest_ = newest;
    storage_[next_] = newest;
    next_ = next_ == whole_ ? 0 : next_ + 1;
    const Position oldest = storage_[next_];
    const auto top = static_cast<std::uint64_t>(newest.raw);
    sum_ += top - static_cast<std::uint64_t>(oldest.raw);
    const std::uint64_t behind = top * whole_ - sum_;
    const std::uint64_t part = duration_q8_ & ((1U << fraction_bits) - 1U);
    const Wide all =
        add(shift_left(Wide{0U, behind}, fraction_bits), multiply(top - static_cast<std::uint64_t>(oldest.raw), part));
    const Wide rounded = add(all, Wide{0U, duration_q8_ / 2});
    mean_.raw = newest.raw - static_cast<std::int64_t>(divide(rounded, duration_q8_).quotient);
}

} // namespace splinefeed
