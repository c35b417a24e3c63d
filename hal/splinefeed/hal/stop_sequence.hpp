// SPDX-License-Identifier: MIT
// StopSequence: the one law by which all targets stop, and what may be said of it afterwards.
//
//                 request(), the same for all axes; it only grows:  hold < quick_stop < disable
//
//     moving --executed by the axis--> stopping --it says that it stands, for the settling time,--> confirmed
//       |                                  |       and no start is pending                              |
//       |  not confirmed within the bound of its request                        it says that it moves   |
//       +---------------+------------------+ <-----------------------------------------------------------+
//                       v
//          the next request, for this axis alone; behind the last one: unconfirmed
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace splinefeed::hal {

/// What an axis is asked for, in order of strength.
enum class StopRequest : std::uint8_t {
    none,
    hold,       ///< feed hold: all axes slow down together, on the path
    quick_stop, ///< each axis as hard as it can, off the path
    disable,    ///< power off
};

enum class StopState : std::uint8_t {
    moving,      ///< it has not executed the request, as far as is known
    stopping,    ///< it has, and does not stand yet
    confirmed,   ///< it said that it stands after it executed the request, and nothing can start it
    unconfirmed, ///< it was not heard, or does not stop: it may still move
};

/// "feed hold", "quick stop", ...
[[nodiscard]] const char* name(StopRequest request) noexcept;

/// What is known of an axis (or of a drive with several axes that stop as one). Instants are those of one clock.
struct StopFacts {
    std::uint64_t status_us = 0; ///< when it said what follows, at the earliest; 0: it never did
    bool standstill = false;     ///< it says that it stands
    /// It was told to start and has not, or such an order is under way: it may begin to move without being told again.
    bool start_pending = false;
    StopRequest executed = StopRequest::none; ///< the strongest request that it is known to have executed
    std::uint64_t executed_us = 0;            ///< when that was so, at the latest
    bool on_path = true;                      ///< where it stands all axes together are on the path
};

/// How long each request may take until it is confirmed, from when it was made: with the link's delays and retries, the
/// drive's ramp, and the settling time. [us]
struct StopTimes {
    std::uint64_t hold_us = 1'000'000;
    std::uint64_t quick_stop_us = 1'000'000;
    std::uint64_t disable_us = 500'000;
    std::uint64_t settle_us = 20'000;        ///< an axis says so for this long before it counts
    StopRequest last = StopRequest::disable; ///< the strongest that an axis is asked for unasked
};

/// What a port reports of an axis or a drive: `quick_stop, confirmed`, ...
struct StopReport {
    StopRequest request = StopRequest::none; ///< the one that is in force
    StopState state = StopState::moving;
    std::uint64_t status_us = 0; ///< when it was heard last; 0: never
    bool on_path = false;        ///< StopFacts::on_path

    /// It was held, on the path, and that is known.
    [[nodiscard]] bool held() const noexcept {
        return request == StopRequest::hold && state == StopState::confirmed && on_path;
    }
};

/// Pure: no time of its own, no I/O. It allocates when it is made, and never again.
/// Use: request() when a stop is wanted; then, again and again, update() with what is known, and for each axis send
/// to_send() if it is not none; until settled().
class StopSequence {
public:
    StopSequence(std::size_t axes, const StopTimes& times) : times_(times), axes_(axes) {}

    /// Forgets all requests: a new motion. @pre the axes may move
    void reset() noexcept;
    void set_times(const StopTimes& times) noexcept { times_ = times; }
    /// For all axes. One that is weaker than what an axis is asked for already does nothing there.
    void request(StopRequest request, std::uint64_t now_us) noexcept;
    /// Cost: linear in the axes. @pre facts.size() is the number of axes
    void update(std::uint64_t now_us, std::span<const StopFacts> facts) noexcept;

    [[nodiscard]] bool requested() const noexcept { return strongest_ != StopRequest::none; }
    /// The strongest that was asked for by request().
    [[nodiscard]] StopRequest strongest_request() const noexcept { return strongest_; }
    /// What the axis is to be told now; none: it has executed what it was asked for.
    [[nodiscard]] StopRequest to_send(std::size_t axis) const noexcept;
    [[nodiscard]] StopReport report(std::size_t axis) const noexcept;
    /// Every axis is confirmed or unconfirmed: waiting longer is of no use. False before a request.
    [[nodiscard]] bool settled() const noexcept;
    [[nodiscard]] bool all_confirmed() const noexcept;

private:
    struct Axis {
        StopReport report;
        std::uint64_t since_us = 0;            // the request in force was made
        std::uint64_t standstill_since_us = 0; // it stands since then, by what it says; 0: it does not
        bool executed = false;                 // the request in force
    };

    [[nodiscard]] std::uint64_t bound_us(StopRequest request) const noexcept;
    void assess(Axis& axis, const StopFacts& facts) const noexcept;
    void escalate(Axis& axis, std::uint64_t now_us) const noexcept;

    StopTimes times_;
    std::vector<Axis> axes_;
    StopRequest strongest_ = StopRequest::none;
};

} // namespace splinefeed::hal
