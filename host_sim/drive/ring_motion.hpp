// SPDX-License-Identifier: MIT
// RingMotion: the motion of a drive on its path: it executes the segments of its ring at the rate that the end of the
// ring allows. TimeRate: that rate, sigma of docs/reference/pvt_map.md: it falls to 0 at the end of the ring.
#pragma once

#include "host_sim/drive/pvt_axis.hpp"
#include "host_sim/drive/pvt_ring.hpp"

#include <functional>

namespace splinefeed::host {

/// Everything is in closed form: except for rounding, the result does not depend on how time is divided into calls.
class TimeRate {
public:
    /// The motion that lies ahead, and the request.
    struct Way {
        double ring_s = 0.0;      ///< R: time to the end of the ring at full rate
        double segment_s = 0.0;   ///< time to the end of the segment, at most ring_s
        bool ends_moving = false; ///< no segment in the ring ends with standstill of all axes: the end of the ring
                                  ///< limits the rate
        bool holds = false;       ///< the rate has to fall to 0, wherever that is
    };
    struct Passed {
        double time_s = 0.0;
        double way_s = 0.0;  ///< in the segments' own time
        bool at_end = false; ///< the end of the segment was reached: way_s is its segment_s
    };

    /// @pre stop_reserve_s > 0
    void set_stop_reserve(double stop_reserve_s) noexcept { reserve_s_ = stop_reserve_s; }
    /// At standstill of all axes any rate is right: takes the largest that the ring allows.
    void start(const Way& way) noexcept;
    /// Called where a segment ends with standstill of all axes: lowers the rate if the rest of the ring needs it.
    void pass_rest(const Way& way) noexcept;
    /// Whether the rate can fall to 0 within that distance.
    [[nodiscard]] bool stops_within(double way_s) const noexcept {
        return rate_ * rate_ * reserve_s_ <= way_s * (1.0 + 1e-9);
    }
    void stop() noexcept { rate_ = 0.0; }
    /// Lets time pass, up to the end of the segment, or to the standstill of a hold. @pre time_s >= 0
    [[nodiscard]] Passed pass(double time_s, const Way& way) noexcept;

    [[nodiscard]] double rate() const noexcept { return rate_; }

private:
    struct Phase {
        double slope = 0.0; // slope of the rate [1/s]
        double time_s = 0.0;
        double end_rate = 0.0;
    };
    [[nodiscard]] Phase phase(const Way& way) noexcept;
    [[nodiscard]] double largest(const Way& way) const noexcept;

    double reserve_s_ = 0.1;
    double rate_ = 0.0;
};

/// A segment that was executed completely.
struct ExecutedSegment {
    std::uint32_t sequence = 0;
    hal::modbus::PvtSegment segment;
    double end_us = 0.0; ///< in the time of the drive
};

class RingMotion {
public:
    /// The state after some time.
    enum class Outcome {
        moves,
        complete, ///< at the end of the ring, where the motion is complete
        held,     ///< at standstill on the path: at the end of the ring, or where a hold ended
        underflow ///< the ring ended while the axes were moving
    };

    RingMotion(int axes, std::uint16_t ring) : ring_(axes, ring), axes_(static_cast<std::size_t>(axes)) {}

    /// Sets a function that is called at the end of every segment.
    void observe(std::function<void(const ExecutedSegment&)> observer) { observer_ = std::move(observer); }
    /// Makes the ring empty; `first` is the next segment and starts at this reference, at standstill.
    void begin(std::uint32_t first, const PvtReference& reference) noexcept;
    [[nodiscard]] PvtRing& ring() noexcept { return ring_; }
    [[nodiscard]] const PvtRing& ring() const noexcept { return ring_; }
    [[nodiscard]] double rate() const noexcept { return rate_.rate(); }

    /// @pre stop_reserve_s > 0
    void set_stop_reserve(double stop_reserve_s) noexcept { rate_.set_stop_reserve(stop_reserve_s); }
    /// Starts from standstill at a place where the motion is complete, at any rate.
    void start() noexcept;
    /// The rate may rise again from its present value.
    void resume() noexcept { holds_ = false; }
    /// The rate falls to 0 from now on.
    void hold() noexcept { holds_ = true; }
    /// The drive stands, or moves in another way than along the ring.
    void leave() noexcept;
    /// Treats the ring as ending before this segment. Returns false, and changes nothing, if the motion could not stop
    /// there.
    [[nodiscard]] bool end_before(std::uint32_t sequence) noexcept;

    /// Lets time pass from now on, and writes the new reference. Cost: the number of segments that end in this time.
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
