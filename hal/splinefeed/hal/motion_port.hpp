// SPDX-License-Identifier: MIT
// MotionPort: interface of everything that executes feed segments, from the connection to the end: drives, step lines,
// the simulated machine. Its calls are at the rate of segments.
#pragma once

#include "splinefeed/base/status.hpp"
#include "splinefeed/hal/port_failure.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"

namespace splinefeed::hal {

enum class PortPhase : std::uint8_t {
    idle,    ///< nothing queued, all axes at rest
    running, ///< executing segments
    halted,  ///< stopped by halt() or quick_stop(); queued segments are not executed
    fault,   ///< stopped by the port itself: failure()
};

/// What open() and prepare() do, beside getting ready.
struct PortOrders {
    bool reset = false; ///< what has stopped the machine is over: faults of drives are reset, and limits may be left
    bool home = false;  ///< prepare(): axes find their references,
    std::uint32_t home_axes = UINT32_MAX; ///< these, by bits; a drive homes all of its own; the others stay placed
    bool stays = false;                   ///< and stay there, on step lines; else they go to where the motion begins
    /// Axes that are known to stand where the motion begins, by bits; on step lines the others may.
    std::uint32_t placed = UINT32_MAX;
};

/// What a port reports when it is polled.
struct PortState {
    PortPhase phase = PortPhase::idle;
    std::uint64_t executed = 0; ///< segments that were executed completely
};

/// Use: open(), then prepare(first). For each segment: while (room() == 0) poll(); submit(segment). Then complete(),
/// and poll() until the phase is not `running`. Behind renew() another motion follows; at last power_off(), if the
/// drives shall not stay on, and close(). What a port does not need does nothing.
class MotionPort {
public:
    MotionPort(const MotionPort&) = delete;
    MotionPort& operator=(const MotionPort&) = delete;

    /// From now on.
    void order(const PortOrders& orders) noexcept { orders_ = orders; }
    [[nodiscard]] const PortOrders& orders() const noexcept { return orders_; }
    /// Connects to the drives and checks them. Nothing moves.
    [[nodiscard]] virtual PortFailure open() { return {}; }
    /// Makes the drives ready for a motion that begins where this segment does. It may take minutes (homing). After a
    /// failure nothing moves any more, or failure() and the port's reports say which drive has not confirmed it.
    [[nodiscard]] virtual PortFailure prepare(const FeedSegment& /*first*/) { return {}; }
    /// Behind a motion that is over, idle or halted: the drives stay ready for another one, which begins where this
    /// segment does. There the axes stand.
    [[nodiscard]] virtual PortFailure renew(const FeedSegment& first) { return prepare(first); }
    /// Number of segments that submit() accepts now.
    [[nodiscard]] virtual int room() const noexcept = 0;
    /// Queues one segment. Returns false if the port is halted or in fault; the segment is then dropped. @pre room() >
    /// 0
    [[nodiscard]] virtual bool submit(const FeedSegment& segment) noexcept = 0;
    /// Declares that no more segments will come. If the last one ends in motion, all axes stop on the path.
    virtual void complete() noexcept {}
    /// Does the port's periodic work and returns its state. On a real machine call it at least once per segment
    /// duration.
    virtual PortState poll() noexcept = 0;
    /// Stops the motion on the path, and drops queued segments. Best effort; never fails.
    virtual void halt() noexcept = 0;
    /// Stops every axis as hard as the port can, if need be off the path. Takes precedence over halt(), and ends like
    /// it.
    virtual void quick_stop() noexcept { halt(); }
    /// Switches the drives off, and waits until they have confirmed it or their time is over. @pre the axes stand
    virtual void power_off() noexcept {}
    /// Stops axes that move, and ends the port's threads. The drives stay on.
    virtual void close() noexcept {}
    /// Why open() or prepare() did not succeed, why the port is in fault, or why it refused a segment. Allocates.
    [[nodiscard]] virtual PortFailure failure() const = 0;

protected:
    MotionPort() = default;
    // Not public: that would pull operator delete into firmware.
    ~MotionPort() = default;

private:
    PortOrders orders_;
};

} // namespace splinefeed::hal
