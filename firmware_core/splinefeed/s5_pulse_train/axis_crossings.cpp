// SPDX-License-Identifier: MIT
//
// Instants are u = time / duration in units of 2^-32, so T ticks have a resolution of T / 2^32: 2^-12 for 100 ms.
//
// The previous steps predict the next one: with the last two intervals I and I' (I is the later one), I* = 2 I - I' and
// u* = u + I*. If e counts are missing there, the correction is e I* to first order, because I* is the time of one
// count:
//
//   u = u* + e I*
//
// The velocity at u* differs from one count per I* by a part of about |I* - I| / 2 I* if the acceleration continues as
// before, and by 3 |e| more if its jerk jumps. So the remaining error is below |e I*| (|I* - I| / 2 + 3 |e I*|) / I*.
// If |e I*| (|I* - I| + |e I*|) is at most I* times an eighth of a tick, it is below 3/8 of a tick; rounding adds 1/2.
// If the acceleration jumps from one segment to the next (the segment stream never does this) the intervals are
// discarded. If |I* - I| + |e I*| is a quarter of I* or more, the prediction is not usable. In these cases, in the
// first steps from a standstill, and where steps are further apart than an eighth of a segment, Newton's method finds
// the step with the slope (crossing.cpp). Otherwise there is no division.
//
// Crossings are counted, not computed: up_units_ moves by whole counts, and from segment to segment by the exact
// distance. A part of the segment contains a crossing if its end lies beyond the crossing. The end of a part in the
// middle of a segment is rounded. A crossing that this misses or adds is one that the motion touches within 3 units;
// the exact end of the segment determines what remains.
#include "splinefeed/s5_pulse_train/axis_crossings.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/s5_pulse_train/crossing.hpp"
#include "splinefeed/s5_pulse_train/step.hpp"

namespace splinefeed {

namespace {

constexpr std::uint32_t longest_interval = std::uint32_t{1} << 29;
constexpr std::int32_t longest_since = std::int32_t{1} << 30;

/// since + more, at most longest_since; 0 of a whole duration is 2^32.
std::int32_t longer(std::int32_t since, std::uint32_t more) noexcept {
    constexpr auto most = static_cast<std::uint32_t>(longest_since);
    const std::uint32_t sum = static_cast<std::uint32_t>(since) + more;
    return more == 0 || more >= most || sum >= most ? longest_since : static_cast<std::int32_t>(sum);
}

} // namespace

inline void AxisCrossings::pass(std::uint32_t u) noexcept {
    const std::uint32_t ahead = u - low_u_;
    const std::uint32_t interval = ahead + static_cast<std::uint32_t>(since_);
    interval_before_ = interval_;
    interval_ = ahead < longest_interval && interval < longest_interval ? static_cast<std::int32_t>(interval) : 0;
    low_u_ = u;
    since_ = 0;
    tick_ = static_cast<std::uint32_t>((static_cast<std::uint64_t>(u) * duration_ + (std::uint64_t{1} << 31)) >> 32);
}

inline void AxisCrossings::solve() noexcept {
    const std::int32_t change = interval_ - interval_before_;
    const std::int32_t interval = interval_ + change;
    const std::int32_t ahead = interval - since_;
    const std::uint32_t guess = low_u_ + static_cast<std::uint32_t>(ahead);
    const std::uint32_t room = end_u_ - low_u_;
    if (ahead <= 0 || static_cast<std::uint32_t>(ahead) >= room) {
        search(low_u_);
        return;
    }
    const std::int64_t missing = level_ - cubic_.at(guess);
    const auto missing_32 = static_cast<std::int32_t>(missing);
    if (missing != missing_32) { // two thirds of a count
        search(guess);
        return;
    }
    // missing / units_per_count * interval: 2^-30 and, by 0x55555556 / 2^32, 1/3.
    const auto product = static_cast<std::int32_t>(std::int64_t{missing_32} * interval >> 30);
    const auto correction = static_cast<std::int32_t>(std::int64_t{product} * 0x55555556 >> 32);
    const std::uint32_t u = guess + static_cast<std::uint32_t>(correction);
    if (u - low_u_ >= room) {
        search(guess);
        return;
    }
    const auto size = static_cast<std::uint32_t>(correction < 0 ? -correction : correction);
    const auto error_bound = static_cast<std::uint32_t>(change < 0 ? -change : change) + size;
    if (static_cast<std::int32_t>(error_bound) >= interval >> 2 ||
        static_cast<std::uint64_t>(size) * error_bound >
            static_cast<std::uint64_t>(static_cast<std::uint32_t>(interval)) * near_) {
        search(u);
        return;
    }
    pass(u);
}

void AxisCrossings::stand(std::int64_t units) noexcept {
    up_units_ = nearest_step(units) * units_per_count + units_per_count / 2 - units;
    since_ = longest_since;
    interval_ = interval_before_ = 0;
    way_ = 0;
    tick_ = none;
}

void AxisCrossings::begin(const FeedSegment& segment, unsigned axis) noexcept {
    SPLINEFEED_ASSERT(tick_ == none);
    SPLINEFEED_ASSERT(segment.duration_ticks > 0 && segment.duration_ticks < (1U << 26));
    since_ = longer(since_, 0U - low_u_);
    if (segment.duration_ticks != duration_) {
        duration_ = segment.duration_ticks;
        near_ = (std::uint32_t{1} << 29) / duration_;
        since_ = longest_since; // in another unit
        interval_ = interval_before_ = 0;
    }
    const std::int64_t bend = as_it_is_.second + 3 * as_it_is_.third; // half the acceleration at the previous end
    as_it_is_ = AxisCubic::of(segment, axis);
    if (as_it_is_.second != bend) {
        since_ = longest_since;
        interval_ = interval_before_ = 0;
    }
    up_units_ -= way_;
    way_ = segment.end[axis] - segment.start[axis];
    parts_ = MonotoneParts(as_it_is_, way_);
    part_ = 0;
    if (go_on()) {
        level_ -= units_per_count;
        go_to_next();
    }
}

void AxisCrossings::go_to_next() noexcept {
    level_ += units_per_count;
    if (level_ > end_) {
        up_units_ = up_ ? level_ : units_per_count + 1 - level_;
        if (!go_on()) {
            return;
        }
    }
    solve();
}

// Goes to the next part with a crossing, or to none.
bool AxisCrossings::go_on() noexcept {
    while (part_ < parts_.size()) {
        low_u_ = part_ == 0 ? 0U : parts_[part_ - 1U].end;
        enter(parts_[part_++]);
        if (level_ <= end_) {
            return true;
        }
    }
    // A crossing that rounding at a turn may have left open.
    tick_ = none;
    if (way_ >= up_units_ || way_ < up_units_ - units_per_count) {
        enter({0xffffffffU, way_, way_ >= up_units_});
        pass(0xffffffffU);
    }
    return false;
}

// A crossing downwards is passed where the position is less: one unit beyond it, in the negated part.
void AxisCrossings::enter(const MonotonePart& part) noexcept {
    if (part.rising != up_) {
        up_ = part.rising;
        since_ = longest_since;
        interval_ = interval_before_ = 0;
    }
    end_u_ = part.end;
    if (up_) {
        cubic_ = as_it_is_;
        level_ = up_units_;
        end_ = part.units;
    } else {
        cubic_ = {-as_it_is_.first, -as_it_is_.second, -as_it_is_.third};
        level_ = units_per_count + 1 - up_units_;
        end_ = -part.units;
    }
}

void AxisCrossings::search(std::uint32_t guess) noexcept {
    pass(find_crossing(cubic_, {level_, low_u_, end_u_, guess, near_}));
}

} // namespace splinefeed
