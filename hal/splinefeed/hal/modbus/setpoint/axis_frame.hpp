// SPDX-License-Identifier: MIT
// AxisFrame: converts positions of a machine axis to positions of its drive, by an offset and a direction.
#pragma once

#include "splinefeed/hal/modbus/profile/drive_profile.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <optional>

namespace splinefeed::hal::modbus {

/// Positions are in units of a feed segment. Nothing overflows: positions beyond 2^31 counts, or beyond the register of
/// the drive's target position, are reported as out of range.
class AxisFrame {
public:
    /// Message for a position out of range.
    static constexpr const char* out_of_range =
        "the program exceeds the range of its target position register, or 2147483647 counts; move its reference "
        "nearer to the program, lower steps_per_mm, or check width and clamp in its profile";

    /// @param inverted  the drive counts in the opposite direction
    /// @param target  register of the drive's target position, must outlive the frame; nullptr: no limit by a register
    explicit AxisFrame(bool inverted = false, const RegisterField* target = nullptr) noexcept
        : inverted_(inverted), target_(target) {}

    /// Defines that the drive's position `stands_q16` [1/65536 count] is `start` of the axis. Returns false, without a
    /// change, if out of range.
    [[nodiscard]] bool align(std::int64_t stands_q16, std::int64_t start) noexcept;
    /// Whether align() has succeeded: positions mean something.
    [[nodiscard]] bool aligned() const noexcept { return aligned_; }
    /// Converts a position of the axis to the drive's; empty: out of range.
    [[nodiscard]] std::optional<std::int64_t> position(std::int64_t of_axis) const noexcept;
    [[nodiscard]] std::int64_t velocity(std::int64_t of_axis) const noexcept { return inverted_ ? -of_axis : of_axis; }
    /// Converts one axis of a segment to the drive's positions. Returns false, without a change, if out of range.
    [[nodiscard]] bool apply(FeedSegment& segment, std::size_t axis) const noexcept;
    /// Converts a position of the drive to the axis's. [counts]
    [[nodiscard]] double axis_counts(std::int64_t drive_q16) const noexcept;

private:
    bool inverted_;
    const RegisterField* target_;
    bool aligned_ = false;
    std::int64_t offset_ = 0; // drive's position minus the axis's, in the drive's direction
};

} // namespace splinefeed::hal::modbus
