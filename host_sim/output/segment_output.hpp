// SPDX-License-Identifier: MIT
// SegmentOutput: an output that is made of the feed segments of a run, as they are planned.
#pragma once

#include "splinefeed/s4_segment_stream/feed_segment.hpp"

namespace splinefeed::host {

/// Every method throws OutputError.
class SegmentOutput {
public:
    SegmentOutput() = default;
    SegmentOutput(const SegmentOutput&) = delete;
    SegmentOutput& operator=(const SegmentOutput&) = delete;
    virtual ~SegmentOutput() = default;

    virtual void segment(const FeedSegment& segment) = 0;
    /// What is left at the end of all motion. Once.
    virtual void finish() {}
};

} // namespace splinefeed::host
