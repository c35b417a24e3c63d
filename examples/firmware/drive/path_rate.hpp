// SPDX-License-Identifier: MIT
// PathRate: the rate at which a ring of segments is executed, sigma of docs/reference/pvt_map.md, in integers.
#pragma once

#include "splinefeed/s5_pulse_train/axis_cubic.hpp"

#include <cstdint>

namespace firmware {

/// Time is in ticks of 1/8 us. The rate is linear in time within a step; at the ends of steps it is on the law's curve
/// to within rounding, whatever their durations.
class PathRate {
public:
    static constexpr std::uint32_t full = 1U << 30;
    static constexpr std::uint32_t longest_step = 80'000; ///< ticks: 10 ms

    struct Ahead {
        std::uint64_t ring_ticks = 0; ///< R: time to the end of the ring at full rate
        bool ends_moving = false;     ///< no segment in the ring has the rest mark: its end limits the rate
        bool holds = false;           ///< the rate has to fall to 0, wherever that is
    };

    /// @pre 1 <= stop_reserve_ms <= 10000
    void set_stop_reserve(std::uint32_t stop_reserve_ms) noexcept { reserve_ticks_ = stop_reserve_ms * 8000; }
    /// At standstill of all axes any rate is right: takes the largest that the ring allows.
    void start(const Ahead& ahead) noexcept { rate_ = largest(ahead); }
    /// Where a segment ends at standstill: lowers the rate if the rest of the ring needs it.
    void pass_rest(const Ahead& ahead) noexcept;
    /// Within a step that a standstill interrupts: the rate there.
    void set_rate(std::uint32_t rate) noexcept { rate_ = rate; }
    void stop() noexcept { rate_ = 0; }
    /// Whether the rate can fall to 0 within that distance.
    [[nodiscard]] bool stops_within(std::uint64_t ring_ticks) const noexcept;

    /// Lets time pass. Returns the distance in ticks of the segments' own time, at most ahead.ring_ticks.
    /// @pre ticks <= longest_step
    [[nodiscard]] std::uint64_t pass(std::uint32_t ticks, const Ahead& ahead) noexcept;

    [[nodiscard]] std::uint32_t rate() const noexcept { return rate_; }
    /// A velocity at this rate.
    [[nodiscard]] static constexpr std::int64_t part(std::int64_t velocity, std::uint32_t rate) noexcept {
        return rate == full ? velocity : splinefeed::times_q32(velocity, rate << 2);
    }

private:
    [[nodiscard]] std::uint32_t largest(const Ahead& ahead) const noexcept;
    [[nodiscard]] std::uint32_t rate_on_curve(std::uint32_t before, std::uint32_t ticks,
                                              std::uint64_t ring_ticks) const noexcept;

    std::uint32_t reserve_ticks_ = 800'000; // S
    std::uint32_t rate_ = 0;
};

} // namespace firmware
