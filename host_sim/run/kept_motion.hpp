// SPDX-License-Identifier: MIT
// KeptMotion: the segments of a motion in memory, with where each comes from and what bound it.
#pragma once

#include "host_sim/analysis/limit_kind.hpp"

#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace splinefeed::host {

/// A segment begins as the one before ends and takes as long: of each only the end is kept, 12 bytes and 16 for each
/// axis. They grow where they are, without a copy. So keeping a motion costs little beside planning it.
class KeptMotion {
public:
    /// What a record begins with. Behind it, of all axes: end, end velocity, as FeedSegment has them.
    struct Head {
        std::uint32_t waypoint;
        std::uint32_t row;  ///< from 1: the line of a program in G-code, else the waypoint or element; 0: unknown
        std::uint8_t limit; ///< BindingLimit::code()
        std::array<std::uint8_t, 3> zero{}; ///< no padding: motions with equal segments have equal bytes
    };

    explicit KeptMotion(int axes) noexcept
        : axes_(static_cast<unsigned>(axes)), record_(sizeof(Head) + 2 * sizeof(std::int64_t) * axes_) {}

    /// Throws std::bad_alloc, and std::logic_error where the segment is none of the same motion.
    void add(const FeedSegment& segment, std::uint64_t row, BindingLimit limit);

    [[nodiscard]] int axes() const noexcept { return static_cast<int>(axes_); }
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    /// Duration of each segment. @pre there is one
    [[nodiscard]] std::uint32_t segment_ticks() const noexcept { return first_.duration_ticks; }
    [[nodiscard]] std::size_t record_bytes() const noexcept { return record_; }
    [[nodiscard]] const std::byte* data() const noexcept { return bytes_.get(); }
    /// @pre i < size()
    [[nodiscard]] FeedSegment segment(std::size_t i) const noexcept;

private:
    struct Free {
        void operator()(std::byte* bytes) const noexcept;
    };

    void grow();
    void read_end(std::size_t i, PerAxis<std::int64_t>& end, PerAxis<std::int64_t>& velocity) const noexcept;

    unsigned axes_;
    std::size_t record_; // its bytes
    std::size_t size_ = 0;
    std::size_t room_ = 0;
    std::unique_ptr<std::byte, Free> bytes_;
    FeedSegment first_;
    FeedSegment last_;
};

} // namespace splinefeed::host
