// SPDX-License-Identifier: MIT
// DdaLoader: feed segments to parts for TickDda, outside of the interrupt.
#pragma once

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"
#include "splinefeed/s5_pulse_train/axis_cubic.hpp"
#include "splinefeed/s5_pulse_train/tick_part.hpp"
#include "splinefeed/s5_pulse_train/unit_scale.hpp"

#include <array>
#include <cstdint>

namespace splinefeed {

/// Samples lie in the middle between two ticks: the count there is the one to have at the tick before, and no step is
/// more than half a tick from its crossing. A tick need not fit into a segment: the instant of the first sample is
/// carried over, in whole 1/8 us. Error of a position: below 2^-34 count, wherever it is; nothing is carried over but
/// whole counts.
class DdaLoader {
public:
    static constexpr std::uint32_t longest = 1024; ///< ticks in a part

    /// @param axes  1 to max_axes
    /// @param tick_ticks  the tick's duration in 1/8 us, even, 2 to 8000
    constexpr DdaLoader(int axes, std::uint32_t tick_ticks) noexcept
        : tick_ticks_(tick_ticks), sample_(tick_ticks / 2), axes_(static_cast<unsigned>(axes)) {
        SPLINEFEED_ASSERT(tick_ticks % 2 == 0 && tick_ticks > 0 && tick_ticks <= 8000);
    }

    /// @pre next() has said false; velocities below half a count a tick; AxisCubic's; duration from 2 ticks of 1/8 us
    /// on
    void take(const FeedSegment& segment) noexcept;
    /// The next part. False: the segment has no further sample. Cost: about twelve products of 64 bits an axis, and one
    /// wide division.
    bool next(TickPart& out) noexcept;

    /// Where the axes stand, as counts: at the end of the segment, and at its start.
    [[nodiscard]] const PerAxis<std::int32_t>& end_count() const noexcept { return end_count_; }
    [[nodiscard]] const PerAxis<std::int32_t>& start_count() const noexcept { return count_; }

private:
    void prepare(unsigned axis, std::uint64_t u, TickPart& out) const noexcept;

    PerAxis<AxisCubic> cubic_{};
    PerAxis<std::int32_t> count_{}; // at the segment's start
    PerAxis<std::int64_t> rest_{};  // from there to the start [units]
    PerAxis<std::int32_t> end_count_{};
    PerAxis<std::int64_t> end_rest_{};
    std::array<UnitScale, 3> scale_{}; // of the coefficients to differences
    std::uint32_t tick_ticks_;
    std::uint32_t sample_;       // instant of the next one, from the segment's start
    std::uint32_t duration_ = 0; // [1/8 us]
    unsigned axes_;
    bool started_ = false;
};

} // namespace splinefeed
