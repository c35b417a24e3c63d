// SPDX-License-Identifier: MIT
// A hash over every integer of every feed segment: equal where the motion is equal to the last bit.
#pragma once

#include "integer_hash.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <span>

class SegmentHash : public IntegerHash {
public:
    using IntegerHash::add;
    [[gnu::noinline]] void add(const splinefeed::FeedSegment& item) {
        add(item.index);
        add(item.duration_ticks);
        add(item.waypoint);
        for (const auto* values : {&item.start, &item.end, &item.start_velocity, &item.end_velocity}) {
            for (const std::int64_t value : std::span<const std::int64_t, axes>(values->data(), axes)) {
                add(static_cast<std::uint64_t>(value));
            }
        }
    }

private:
    static constexpr unsigned axes = 3; ///< of the proofs' machines, whatever the capacity is
};
