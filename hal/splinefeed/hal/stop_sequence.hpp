// SPDX-License-Identifier: MIT
// StopSequence: the state machine by which all targets stop their axes, and by which they report the result.
//
//                 request(), of all axes or one; it only becomes stronger:  hold < quick_stop < disable
//
//     moving --executed by the axis--> stopping --it reports standstill, for the settling time,--> confirmed
//       |                                  |                                                            |
//       |  not confirmed within the bound of its request                        it reports motion         |
//       |  (the longer one, while it brakes)                                                              |
//       +---------------+------------------+ <-----------------------------------------------------------+
//                       v
//          the next request, for this axis alone; behind the last one: unconfirmed
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace splinefeed::hal {

/// Kinds of stop, weakest first.
enum class StopRequest : std::uint8_t {
    none,
    hold,       ///< feed hold: all axes slow down together, on the path
    quick_stop, ///< each axis brakes as hard as it can and leaves the path
    disable,    ///< power off
};

enum class StopState : std::uint8_t {
    moving,      ///< the axis is not known to have executed the request
    stopping,    ///< it has executed the request and still moves
    confirmed,   ///< after executing the request it reported standstill
    unconfirmed, ///< it did not answer, or did not stop: it may still move
};

/// "feed hold", "quick stop", ...
[[nodiscard]] const char* name(StopRequest request) noexcept;

/// What is known of an axis, or of a drive whose axes stop together. All instants are of one clock. [us]
struct StopFacts {
    std::uint64_t status_us = 0; ///< earliest instant at which the reported state was true; 0: no report yet
    bool standstill = false;     ///< it reports standstill
    bool braking = false;        ///< it reports that it brakes, and its speed falls: it needs its own time
    StopRequest executed = StopRequest::none; ///< strongest request that it is known to have executed
    std::uint64_t executed_us = 0;            ///< latest instant at which it executed that request
    bool on_path = true;                      ///< the axes stand together at a point of the path
};

/// Longest time from a request to its confirmation. It includes delays and retries of the link, the drive's ramp and
/// the settling time. [us]
struct StopTimes {
    std::uint64_t hold_us = 1'000'000;
    std::uint64_t quick_stop_us = 1'000'000;
    std::uint64_t disable_us = 500'000;
    /// Longest time for an axis that has executed its request and brakes. With a slow ramp the next request is no help.
    std::uint64_t braking_us = 0;
    /// An axis must report standstill for this long, in at least StopSequence::least_statuses statuses.
    std::uint64_t settle_us = 20'000;
    StopRequest last = StopRequest::disable; ///< strongest request that escalation may reach

    /// Of a stop that begins with a hold, where no axis brakes: then its end is known. [us]
    [[nodiscard]] std::uint64_t longest_us() const noexcept { return hold_us + quick_stop_us + disable_us; }
};

/// What a port reports of an axis or a drive: `quick_stop, confirmed`, ...
struct StopReport {
    StopRequest request = StopRequest::none; ///< the request in force
    StopState state = StopState::moving;
    std::uint64_t status_us = 0; ///< instant of the last status; 0: none yet
    bool on_path = false;        ///< StopFacts::on_path

    /// The axis was held on the path, and it confirmed that.
    [[nodiscard]] bool held() const noexcept {
        return request == StopRequest::hold && state == StopState::confirmed && on_path;
    }
};

/// Has no clock and no I/O. Allocates in its constructor only.
/// Use: call request() to stop. Then, until settled(), call update() periodically with the known facts, and send
/// to_send() to each axis for which it is not none.
class StopSequence {
public:
    /// Between two statuses a shaft may have been pushed away and come back; that it is back in three is no accident.
    static constexpr unsigned least_statuses = 3;

    StopSequence(std::size_t axes, const StopTimes& times) : times_(times), axes_(axes) {}

    /// Clears all requests before a new motion. @pre the axes may move
    void reset() noexcept;
    void set_times(const StopTimes& times) noexcept { times_ = times; }
    /// Requests a stop of all axes. Has no effect on an axis with an equal or stronger request.
    void request(StopRequest request, std::uint64_t now_us) noexcept;
    /// The same of one axis: for one that moves by itself (homing) a hold is not enough.
    void request(std::size_t axis, StopRequest request, std::uint64_t now_us) noexcept;
    /// Returns whether an axis got its next request. Cost: linear in the axes. @pre facts.size() is the number of axes
    bool update(std::uint64_t now_us, std::span<const StopFacts> facts) noexcept;

    [[nodiscard]] bool requested() const noexcept { return strongest_ != StopRequest::none; }
    /// The request to send to the axis now; none: it has executed its request.
    [[nodiscard]] StopRequest to_send(std::size_t axis) const noexcept;
    [[nodiscard]] StopReport report(std::size_t axis) const noexcept;
    /// True when every axis is confirmed or unconfirmed: waiting longer changes nothing. False before a request.
    [[nodiscard]] bool settled() const noexcept;
    /// The first axis whose stop is not confirmed; the last one if all are.
    [[nodiscard]] std::size_t unconfirmed() const noexcept;

private:
    struct Axis {
        StopReport report;
        std::uint64_t since_us = 0;            // instant of the request in force
        std::uint64_t standstill_since_us = 0; // first status that reports standstill; 0: it moves
        std::uint64_t status_us = 0;           // the last one that was counted
        unsigned statuses = 0;                 // that report standstill, in a row
        bool executed = false;                 // it has executed the request in force
    };

    [[nodiscard]] std::uint64_t bound_us(StopRequest request) const noexcept;
    void assess(Axis& axis, const StopFacts& facts) const noexcept;
    bool escalate(Axis& axis, const StopFacts& facts, std::uint64_t now_us) const noexcept;

    StopTimes times_;
    std::vector<Axis> axes_;
    StopRequest strongest_ = StopRequest::none;
};

} // namespace splinefeed::hal
