// SPDX-License-Identifier: MIT
// RingMotion: a drive on its path: the segments that it holds, executed at the rate that their end allows.
#pragma once

#include "host_sim/drive/pvt_axis.hpp"
#include "host_sim/drive/pvt_ring.hpp"
#include "host_sim/drive/time_rate.hpp"

#include <functional>

namespace splinefeed::host {

/// A segment that was executed completely.
struct ExecutedSegment {
    std::uint32_t sequence = 0;
    hal::modbus::PvtSegment segment;
    double end_us = 0.0; ///< time of the drive
};

class RingMotion {
public:
    /// How it stands after some time.
    enum class Outcome {
        moves,
        complete, ///< at the end of the ring, a place to stand
        held,     ///< at rest on the path: at the end of the ring, or where a hold ended
        underflow ///< the ring ended with speed
    };

    RingMotion(int axes, std::uint16_t ring) : ring_(axes, ring), axes_(static_cast<std::size_t>(axes)) {}

    /// Called with every segment at its end.
    void observe(std::function<void(const ExecutedSegment&)> observer) { observer_ = std::move(observer); }
    /// An empty ring; `first` is to come next, and starts at this reference, at rest.
    void begin(std::uint32_t first, const PvtReference& reference) noexcept;
    [[nodiscard]] PvtRing& ring() noexcept { return ring_; }
    [[nodiscard]] const PvtRing& ring() const noexcept { return ring_; }
    [[nodiscard]] double rate() const noexcept { return rate_.rate(); }

    /// @pre stop_reserve_s > 0
    void set_stop_reserve(double stop_reserve_s) noexcept { rate_.set_stop_reserve(stop_reserve_s); }
    /// From rest at a place to stand, at any rate.
    void start() noexcept;
    /// The rate may rise (again) from where it is.
    void resume() noexcept { holds_ = false; }
    /// The rate falls to 0 from now on.
    void hold() noexcept { holds_ = true; }
    /// At rest, or another way than along the ring.
    void leave() noexcept;
    /// Treats the ring as ending before this segment; false, and nothing done, where it could not stop there.
    [[nodiscard]] bool end_before(std::uint32_t sequence) noexcept;

    /// Lets time pass from now on, and says where the axes are to be. Cost: the number of segments that end in it.
    [[nodiscard]] Outcome pass(std::uint64_t now_us, double duration_s, PvtReference& reference);

private:
    [[nodiscard]] TimeRate::Way way() const noexcept;
    void refer(PvtReference& reference) const noexcept;
    [[nodiscard]] Outcome finish_segment(double end_us, PvtReference& reference);
    [[nodiscard]] Outcome at_end(bool complete, const PvtReference& reference) const noexcept;

    PvtRing ring_;
    TimeRate rate_;
    std::size_t axes_;
    bool holds_ = false;
    std::function<void(const ExecutedSegment&)> observer_;
};

} // namespace splinefeed::host
