// SPDX-License-Identifier: MIT
// MotionPort: interface of everything that executes feed segments: drives, step lines, the simulated machine. The
// virtual calls are at the rate of segments.
#pragma once

#include "splinefeed/base/status.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"

namespace splinefeed::hal {

enum class PortPhase : std::uint8_t {
    idle,    ///< nothing queued, all axes at rest
    running, ///< executing segments
    halted,  ///< stopped by halt(); queued segments are not executed
    fault,   ///< stopped by the port itself; the port reports the cause
};

/// What a port reports when it is polled.
struct PortState {
    PortPhase phase = PortPhase::idle;
    std::uint64_t executed = 0; ///< segments that were executed completely
};

/// Use: while (trajectory.next(segment)) { while (port.room() == 0) port.poll(); port.submit(segment); }
class MotionPort {
public:
    /// Number of segments that submit() accepts now.
    [[nodiscard]] int room() const noexcept { return do_room(); }
    /// Queues one segment. Returns false if the port is halted or in fault; the segment is then dropped. @pre room() >
    /// 0
    [[nodiscard]] bool submit(const FeedSegment& segment) noexcept { return do_submit(segment); }
    /// Does the port's periodic work and returns its state. On a real machine call it at least once per segment
    /// duration.
    PortState poll() noexcept { return do_poll(); }
    /// Stops the motion as fast as the port can and drops queued segments. Best effort; never fails.
    void halt() noexcept { do_halt(); }

protected:
    MotionPort() = default;
    MotionPort(const MotionPort&) = default;
    MotionPort(MotionPort&&) = default;
    MotionPort& operator=(const MotionPort&) = default;
    MotionPort& operator=(MotionPort&&) = default;
    // Not public and virtual: a public virtual destructor pulls operator delete into firmware.
    ~MotionPort() = default;

private:
    [[nodiscard]] virtual int do_room() const noexcept = 0;
    [[nodiscard]] virtual bool do_submit(const FeedSegment& segment) noexcept = 0;
    virtual PortState do_poll() noexcept = 0;
    virtual void do_halt() noexcept = 0;
};

} // namespace splinefeed::hal
