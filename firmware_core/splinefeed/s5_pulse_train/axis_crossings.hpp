// SPDX-License-Identifier: MIT
// AxisCrossings: the steps of one axis, one solved at a time.
#pragma once

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/s5_pulse_train/axis_cubic.hpp"
#include "splinefeed/s5_pulse_train/monotone_parts.hpp"

#include <cstdint>

namespace splinefeed {

/// Each instant is within a tick of the crossing: of the plan's, or of a plan that lies 2^-29 count beside it (which
/// matters below 0.02 counts/s only). The number of steps is exact. Memory: constant, about 200 bytes. Cost of a step:
/// see docs/explanation/pulse_train.md.
class AxisCrossings {
public:
    static constexpr std::uint32_t none = 0xffffffffU;

    /// Where the axis stands before the first segment [units].
    void stand(std::int64_t units) noexcept;
    /// The next segment, which starts where the last one ended, and its first step.
    /// @pre tick() == none; 0 < duration < 2^26 ticks; AxisCubic's
    void begin(const FeedSegment& segment, unsigned axis) noexcept;

    /// Instant of the next step, from the segment's start, at most its duration; none: the segment has no more.
    [[nodiscard]] std::uint32_t tick() const noexcept { return tick_; }
    [[nodiscard]] bool up() const noexcept { return up_; }
    /// Passes the step, and finds the next one. @pre tick() != none
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

    AxisCubic cubic_{};         // where the part falls, turned round: it always rises
    std::int64_t level_ = 0;    // of the next crossing [units from the segment's start], turned round as well
    std::int64_t end_ = 0;      // of the part
    std::uint32_t end_u_ = 0;   // of the part
    std::uint32_t low_u_ = 0;   // of its last step, or where there is none yet of its beginning
    std::int32_t since_ = 0;    // from the last step to low_u_, at most longest_since
    std::int32_t interval_ = 0; // between the two steps before [u]; 0: they say nothing
    std::int32_t interval_before_ = 0;
    std::uint32_t near_ = 0;     // an eighth of a tick [u]
    std::uint32_t duration_ = 0; // [ticks]
    std::uint32_t tick_ = none;
    bool up_ = false;

    std::uint8_t part_ = 0;     // the next one
    std::int64_t up_units_ = 0; // of the next crossing upwards, from the segment's start; one count lower: downwards
    std::int64_t way_ = 0;      // in this segment [units]
    AxisCubic as_it_is_{};
    MonotoneParts parts_{};
};

} // namespace splinefeed
