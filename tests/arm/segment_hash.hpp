// SPDX-License-Identifier: MIT
// A hash over every integer of every feed segment: equal where the motion is equal to the last bit.
#pragma once

#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <cstdint>
#include <span>

/// FNV-1a, 64 bits, over the bytes of integers in little-endian order.
class SegmentHash {
public:
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
    [[nodiscard]] std::uint64_t value() const { return state_; }

private:
    static constexpr unsigned axes = 3; ///< of the proofs' machines, whatever the capacity is

    void add(std::uint64_t value) {
        for (int i = 0; i < 8; ++i) {
            state_ = (state_ ^ (value & 0xffU)) * 0x100000001b3U;
            value >>= 8;
        }
    }

    std::uint64_t state_ = 0xcbf29ce484222325U;
};
