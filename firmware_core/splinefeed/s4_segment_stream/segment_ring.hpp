// SPDX-License-Identifier: MIT
// SegmentRing: a queue of feed segments from the thread that plans to the thread that moves, or from a main loop to an
// interrupt.
#pragma once

#include "splinefeed/base/spsc_ring.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"

namespace splinefeed {

using SegmentRing = SpscRing<FeedSegment>;

} // namespace splinefeed
