// SPDX-License-Identifier: MIT
// PathMotion: the motion of all axes along the segments of the queue, a piece of time after another.
#pragma once

#include "drive/drive_settings.hpp"
#include "drive/path_rate.hpp"

#include "splinefeed/hal/modbus/pvt_drive/segment_queue.hpp"
#include "splinefeed/s5_pulse_train/axis_cubic.hpp"

namespace firmware {

using splinefeed::hal::modbus::SegmentQueue;

/// Where the axes are at the end of a slot: positions in units of a feed segment, velocities in units per slot.
struct AxisPlaces {
    PerAxis<std::int64_t> position{};
    PerAxis<std::int64_t> velocity{};
};

class PathMotion {
public:
    enum class Outcome : std::uint8_t {
        moves,
        complete, ///< at the end of the queue, where the motion is complete
        held,     ///< at standstill on the path
        too_fast  ///< a segment that no board can follow: it was not begun
    };

    explicit PathMotion(SegmentQueue& queue) noexcept : queue_(queue) {}

    /// Makes the queue empty; `first` is the next segment and starts at this position, at standstill.
    void begin(std::uint32_t first, const PerAxis<std::int64_t>& position) noexcept;
    void set_stop_reserve(std::uint32_t stop_reserve_ms) noexcept { rate_.set_stop_reserve(stop_reserve_ms); }
    /// Starts from standstill at a place where the motion is complete, at any rate.
    void start() noexcept;
    /// The rate may rise again.
    void resume() noexcept { holds_ = false; }
    /// The rate falls to 0 from now on.
    void hold() noexcept { holds_ = true; }
    /// The drive stands, or moves in another way than along the queue.
    void leave() noexcept;
    /// Treats the queue as ending before this segment. false, and nothing is changed: the motion could not stop there.
    [[nodiscard]] bool end_before(std::uint32_t sequence) noexcept;

    /// Lets time pass [1/8 us], at most that of a slot, and writes where the axes are then.
    [[nodiscard]] Outcome pass(std::uint32_t ticks, AxisPlaces& out) noexcept;
    /// After too_fast: the axis.
    [[nodiscard]] unsigned fast_axis() const noexcept { return fast_axis_; }

private:
    [[nodiscard]] PathRate::Ahead ahead() const noexcept;
    [[nodiscard]] bool load() noexcept;
    [[nodiscard]] std::uint32_t segment_left() const noexcept { return queue_.front().duration_ticks - passed_; }
    void finish_segment() noexcept;
    [[nodiscard]] std::uint32_t stop_at_rest(std::uint32_t ticks, std::uint32_t before, std::uint64_t way,
                                             std::uint64_t distance) noexcept;
    void refer(AxisPlaces& out) const noexcept;

    SegmentQueue& queue_;
    PathRate rate_;
    PerAxis<splinefeed::AxisCubic> cubic_{}; // of the front, if it is loaded
    PerAxis<std::int64_t> start_{};          // where the front starts
    PerAxis<std::int64_t> start_velocity_{}; // there, in units per start_ticks_
    std::uint32_t start_ticks_ = 1;
    std::uint32_t passed_ = 0; // of the front
    unsigned fast_axis_ = 0;
    bool loaded_ = false;
    bool holds_ = false;
};

} // namespace firmware
