// SPDX-License-Identifier: MIT
// LinearLength: the length of an emitted motion along its linear axes.
#pragma once

#include "splinefeed/s3_feed_plan/limits/machine_settings.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"

namespace splinefeed::host {

/// Millimetres and degrees have no sum: where the machine has linear axes, only these count. Simpson's rule in each
/// segment: exact on straight lines.
class LinearLength {
public:
    explicit LinearLength(const MachineSettings& machine);

    void add(const FeedSegment& segment) { mm_ += of(segment); }
    [[nodiscard]] double of(const FeedSegment& segment) const;
    /// [mm]; of a machine without linear axes [degrees]
    [[nodiscard]] double mm() const noexcept { return mm_; }
    /// Whether there are axes that do not count.
    [[nodiscard]] bool is_part() const noexcept { return is_part_; }

private:
    int axes_;
    PerAxis<double> mm_per_unit_{}; // 0: the axis does not count
    bool is_part_ = false;
    double mm_ = 0.0;
};

} // namespace splinefeed::host
