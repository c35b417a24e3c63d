// SPDX-License-Identifier: MIT
// MotionClock: the time of a motion against ours: it runs, slows down to stand for all axes alike, and goes on.
#pragma once

#include <cstdint>

namespace splinefeed::hal::modbus {

/// The motion's time runs at full rate from `start` on. From a `stop` on its rate falls to 0, from a `resume` on it
/// rises to 1, both by 1 within twice the reserve. All axes that follow it stay on the path, however they are told.
/// Instants are those of CLOCK_MONOTONIC.
class MotionClock {
public:
    /// @param reserve_us  not 0
    explicit MotionClock(std::uint64_t reserve_us) noexcept : reserve_us_(reserve_us) {}

    /// At rest at its beginning.
    void start(std::uint64_t at_us) noexcept { start_us_ = at_us; }
    void stop(std::uint64_t at_us) noexcept {
        stop_us_ = at_us > start_us_ ? at_us : start_us_;
        stopping_ = true;
    }
    /// @pre stands(at_us)
    void resume(std::uint64_t at_us) noexcept {
        base_us_ = time_us(at_us);
        start_us_ = at_us;
        rises_ = true;
        stopping_ = false;
    }
    [[nodiscard]] bool stopping() const noexcept { return stopping_; }
    [[nodiscard]] bool stands(std::uint64_t now_us) const noexcept { return stopping_ && now_us >= standing_from_us(); }

    /// When it stands at the earliest. @pre stopping()
    [[nodiscard]] std::uint64_t standing_from_us() const noexcept { return stop_us_ + fall_us(); }
    /// The motion's time at that instant; 0 before its start.
    [[nodiscard]] std::uint64_t time_us(std::uint64_t now_us) const noexcept {
        if (now_us <= start_us_) {
            return base_us_;
        }
        if (!stopping_ || now_us <= stop_us_) {
            return base_us_ + risen_us(now_us - start_us_);
        }
        // From the rate r = f / 2 S on, over f: r t - t^2 / 4 S
        const std::uint64_t fall = fall_us();
        const std::uint64_t t = now_us - stop_us_ < fall ? now_us - stop_us_ : fall;
        return base_us_ + risen_us(stop_us_ - start_us_) + (2 * fall * t - t * t) / (4 * reserve_us_);
    }

private:
    [[nodiscard]] std::uint64_t risen_us(std::uint64_t t) const noexcept {
        return !rises_ ? t : t < 2 * reserve_us_ ? t * t / (4 * reserve_us_) : t - reserve_us_;
    }
    /// How long it takes from the rate at its stop.
    [[nodiscard]] std::uint64_t fall_us() const noexcept {
        const std::uint64_t ran = stop_us_ - start_us_;
        return rises_ && ran < 2 * reserve_us_ ? ran : 2 * reserve_us_;
    }

    std::uint64_t reserve_us_;
    std::uint64_t base_us_ = 0;           // its time at start_us_
    std::uint64_t start_us_ = UINT64_MAX; // not yet
    std::uint64_t stop_us_ = 0;
    bool rises_ = false; // from rate 0 at start_us_
    bool stopping_ = false;
};

} // namespace splinefeed::hal::modbus
