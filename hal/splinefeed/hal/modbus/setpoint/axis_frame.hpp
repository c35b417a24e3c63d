// SPDX-License-Identifier: MIT
// AxisFrame: positions of a machine's axis as its drive counts them: from where the drive stands, either way round.
#pragma once

#include "splinefeed/hal/modbus/profile/drive_profile.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <optional>

namespace splinefeed::hal::modbus {

/// In units of a feed segment. Nothing overflows: what 2^31 counts, or the register of the drive's target position, do
/// not hold is told.
class AxisFrame {
public:
    /// What to tell of it.
    static constexpr const char* out_of_range =
        "the program goes beyond what the register of its target position holds, or beyond 2147483647 counts; find its "
        "reference nearer to the program, lower steps_per_mm, or look at width and clamp in its profile";

    /// @param inverted  the drive counts down where the axis goes up
    /// @param target  register of the drive's target position, which must outlive it; nullptr: any position
    explicit AxisFrame(bool inverted = false, const RegisterField* target = nullptr) noexcept
        : inverted_(inverted), target_(target) {}

    /// The drive stands there [1/65536 count] where the axis is at `start`. False: out of range, and it is as before.
    [[nodiscard]] bool align(std::int64_t stands_q16, std::int64_t start) noexcept;
    /// A position of the axis as the drive's; nothing: out of range.
    [[nodiscard]] std::optional<std::int64_t> position(std::int64_t of_axis) const noexcept;
    [[nodiscard]] std::int64_t velocity(std::int64_t of_axis) const noexcept { return inverted_ ? -of_axis : of_axis; }
    /// That axis of a segment as the drive's. False: out of range, and nothing was changed.
    [[nodiscard]] bool apply(FeedSegment& segment, std::size_t axis) const noexcept;
    /// Of the axis, where the drive is. [counts]
    [[nodiscard]] double axis_counts(std::int64_t drive_q16) const noexcept;

private:
    bool inverted_;
    const RegisterField* target_;
    std::int64_t offset_ = 0; // the drive's position less the axis's, as the drive counts
};

} // namespace splinefeed::hal::modbus
