// SPDX-License-Identifier: MIT
// DdaLoader: turns feed segments into parts for TickDda or SampleDda, outside the interrupt.
#pragma once

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"
#include "splinefeed/s5_pulse_train/axis_cubic.hpp"
#include "splinefeed/s5_pulse_train/sample_dda.hpp"
#include "splinefeed/s5_pulse_train/tick_part.hpp"
#include "splinefeed/s5_pulse_train/unit_scale.hpp"

#include <array>
#include <cstdint>

namespace splinefeed {

/// For TickDda it samples the position in the middle between two ticks. The count at a sample is the one to reach at
/// the tick before, so no step is more than half a tick from its crossing. For SampleDda it samples at the ticks. A
/// segment need not be a whole number of ticks: the instant of the next sample is carried over, in whole 1/8 us. Error
/// of a position: below 2^-34 count everywhere; only whole counts are carried over.
class DdaLoader {
public:
    static constexpr std::uint32_t longest = 1024; ///< largest number of ticks in a part

    enum class Samples : std::uint8_t { at_middles, at_ticks };

    /// @param axes  1 to max_axes
    /// @param tick_ticks  duration of the tick in 1/8 us, even, 2 to 8000
    constexpr DdaLoader(int axes, std::uint32_t tick_ticks, Samples samples = Samples::at_middles) noexcept
        : tick_ticks_(tick_ticks), sample_(samples == Samples::at_ticks ? 0 : tick_ticks / 2),
          axes_(static_cast<unsigned>(axes)),
          count_shift_(samples == Samples::at_ticks ? LineSteps::count_shift : DifferenceTable::count_shift) {
        SPLINEFEED_ASSERT(tick_ticks % 2 == 0 && tick_ticks > 0 && tick_ticks <= 8000);
    }

    /// @pre next() has returned false; velocities are below half a count per tick, of SampleDda below 7; the range of
    /// AxisCubic; the duration is at least 2 ticks of 1/8 us
    void take(const FeedSegment& segment) noexcept;
    /// Writes the next part. false: the segment has no further sample. Cost: about twelve products of 64 bits per axis,
    /// and one wide division.
    bool next(TickPart& out) noexcept;

    /// The positions of the axes, in counts: at the end of the segment, and at its start.
    [[nodiscard]] const PerAxis<std::int32_t>& end_count() const noexcept { return end_count_; }
    [[nodiscard]] const PerAxis<std::int32_t>& start_count() const noexcept { return count_; }

private:
    void prepare(unsigned axis, std::uint64_t u, TickPart& out) const noexcept;

    PerAxis<AxisCubic> cubic_{};
    PerAxis<std::int32_t> count_{}; // at the segment's start
    PerAxis<std::int64_t> rest_{};  // distance from that count to the start [units]
    PerAxis<std::int32_t> end_count_{};
    PerAxis<std::int64_t> end_rest_{};
    std::array<UnitScale, 3> scale_{}; // of the coefficients to differences
    std::uint32_t tick_ticks_;
    std::uint32_t sample_;       // instant of the next sample, from the segment's start
    std::uint32_t duration_ = 0; // [1/8 us]
    unsigned axes_;
    int count_shift_; // of the positions
    bool started_ = false;
};

} // namespace splinefeed
