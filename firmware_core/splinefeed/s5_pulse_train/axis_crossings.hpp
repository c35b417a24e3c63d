// SPDX-License-Identifier: MIT
// AxisCrossings: computes the steps of one axis, one at a time.
#pragma once

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/s5_pulse_train/axis_cubic.hpp"
#include "splinefeed/s5_pulse_train/monotone_parts.hpp"

#include <cstdint>

namespace splinefeed {

/// A step is due where the planned position crosses the middle between two counts. Each instant is within a tick of the
/// crossing, for the planned position or one that differs from it by 2^-29 count (which matters below 0.02 counts/s
/// only). The number of steps is exact. Memory: constant, about 200 bytes. Cost of a step: see
/// docs/explanation/pulse_train.md.
class AxisCrossings {
public:
    static constexpr std::uint32_t none = 0xffffffffU;

    /// Sets the position before the first segment [units].
    void stand(std::int64_t units) noexcept;
    /// Begins the next segment, which starts where the last one ended, and computes its first step.
    /// @pre tick() == none; 0 < duration < 2^26 ticks; the range of AxisCubic
    void begin(const FeedSegment& segment, unsigned axis) noexcept;

    /// Instant of the next step, from the segment's start, at most its duration; none: the segment has no more steps.
    [[nodiscard]] std::uint32_t tick() const noexcept { return tick_; }
    [[nodiscard]] bool up() const noexcept { return up_; }
    /// Goes to the step after this one. @pre tick() != none
    void advance() noexcept {
        SPLINEFEED_ASSERT(tick_ != none);
        go_to_next();
    }

private:
    void go_to_next() noexcept;
    void enter(const MonotonePart& part) noexcept;
    bool go_on() noexcept;
    [[gnu::always_inline]] void solve() noexcept;
    void search(std::uint32_t guess) noexcept;
    [[gnu::always_inline]] void pass(std::uint32_t u) noexcept;

    AxisCubic cubic_{};         // negated where the part falls, so that it always rises
    std::int64_t level_ = 0;    // position of the next crossing [units from the segment's start], negated in the same
                                // way
    std::int64_t end_ = 0;      // position at the end of the part
    std::uint32_t end_u_ = 0;   // instant of the end of the part
    std::uint32_t low_u_ = 0;   // instant of the part's last step; its beginning if there is none yet
    std::int32_t since_ = 0;    // time from the last step to low_u_, at most longest_since
    std::int32_t interval_ = 0; // between the last two steps [u]; 0: not usable
    std::int32_t interval_before_ = 0;
    std::uint32_t near_ = 0;     // an eighth of a tick [u]
    std::uint32_t duration_ = 0; // [ticks]
    std::uint32_t tick_ = none;
    bool up_ = false;

    std::uint8_t part_ = 0;     // index of the next part
    std::int64_t up_units_ = 0; // position of the next crossing upwards, from the segment's start; one count less: the
                                // next one downwards
    std::int64_t way_ = 0;      // distance in this segment [units]
    AxisCubic as_it_is_{};
    MonotoneParts parts_{};
};

} // namespace splinefeed
