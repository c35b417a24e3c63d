// SPDX-License-Identifier: MIT
//
// With the reserve R the rate changes by 1 in 2 R. Rising from 0: m = t^2 / 4 R up to t = 2 R, then t - R. Falling from
// the rate r: m = r t - t^2 / 4 R up to t = 2 R r, where m = R r^2. Both are solved for t.
#include "splinefeed/hal/gpio/edge_clock.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::hal::gpio {

void EdgeClock::start(std::uint64_t at_ns, std::int64_t motion_ns) noexcept {
    mode_ = Mode::running;
    base_ns_ = at_ns;
    base_motion_ns_ = motion_ns;
    last_motion_ns_ = INT64_MIN;
}

void EdgeClock::stop(std::uint64_t at_ns) noexcept {
    const auto reserve = static_cast<double>(settings_.reserve_ns);
    const double risen = at_ns > base_ns_ ? static_cast<double>(at_ns - base_ns_) / (2.0 * reserve) : 0.0;
    rate_ = mode_ == Mode::rising ? std::min(risen, 1.0) : 1.0;
    base_motion_ns_ = motion_ns(at_ns);
    base_ns_ = at_ns;
    mode_ = Mode::falling;
}

void EdgeClock::resume(std::uint64_t at_ns) noexcept {
    base_motion_ns_ = motion_ns(at_ns);
    base_ns_ = at_ns;
    mode_ = Mode::rising;
}

double EdgeClock::fall_ns() const noexcept {
    return 2.0 * static_cast<double>(settings_.reserve_ns) * rate_;
}

double EdgeClock::fallen_ns() const noexcept {
    return static_cast<double>(settings_.reserve_ns) * rate_ * rate_;
}

bool EdgeClock::stands(std::uint64_t now_ns) const noexcept {
    return mode_ == Mode::falling && now_ns >= base_ns_ && static_cast<double>(now_ns - base_ns_) >= fall_ns();
}

std::int64_t EdgeClock::motion_ns(std::uint64_t now_ns) const noexcept {
    if (now_ns <= base_ns_) {
        return base_motion_ns_ - (mode_ == Mode::running ? static_cast<std::int64_t>(base_ns_ - now_ns) : 0);
    }
    const std::uint64_t passed = now_ns - base_ns_;
    const auto reserve = static_cast<double>(settings_.reserve_ns);
    const auto t = static_cast<double>(passed);
    switch (mode_) {
    case Mode::running: break;
    case Mode::rising:
        return base_motion_ns_ + (t < 2.0 * reserve ? std::llround(t * t / (4.0 * reserve))
                                                    : static_cast<std::int64_t>(passed - settings_.reserve_ns));
    case Mode::falling: {
        const double fall = std::min(t, fall_ns());
        return base_motion_ns_ + std::llround(rate_ * fall - fall * fall / (4.0 * reserve));
    }
    }
    return base_motion_ns_ + static_cast<std::int64_t>(passed);
}

std::uint64_t EdgeClock::planned_ns(std::int64_t motion_ns) const noexcept {
    const std::int64_t way = motion_ns - base_motion_ns_;
    if (mode_ == Mode::running) { // a direction may be set before the motion starts
        return base_ns_ + static_cast<std::uint64_t>(way);
    }
    if (way <= 0) {
        return base_ns_;
    }
    const auto reserve = static_cast<double>(settings_.reserve_ns);
    const auto m = static_cast<double>(way);
    if (mode_ == Mode::rising) {
        return base_ns_ + (m < reserve ? static_cast<std::uint64_t>(std::llround(2.0 * std::sqrt(reserve * m)))
                                       : static_cast<std::uint64_t>(way) + settings_.reserve_ns);
    }
    const double square = rate_ * rate_ - m / reserve;
    return square < 0.0
               ? never
               : base_ns_ + static_cast<std::uint64_t>(std::llround(2.0 * reserve * (rate_ - std::sqrt(square))));
}

std::uint64_t EdgeClock::due_ns(std::int64_t motion_ns) const noexcept {
    const std::uint64_t planned = planned_ns(motion_ns);
    if (last_motion_ns_ == INT64_MIN) {
        return planned;
    }
    const auto gap = static_cast<std::uint64_t>(std::max<std::int64_t>(motion_ns - last_motion_ns_, 0));
    return std::max(planned, last_ns_ + std::min(gap, settings_.guard_ns));
}

std::uint64_t EdgeClock::absorb_delay(std::int64_t motion_ns, std::uint64_t now_ns) noexcept {
    const std::uint64_t planned = planned_ns(motion_ns);
    if (planned == never || now_ns <= planned + settings_.tolerated_ns) {
        return 0;
    }
    base_ns_ += now_ns - planned;
    schedule_slip_ns_ += now_ns - planned;
    return now_ns - planned;
}

std::uint64_t EdgeClock::late_ns(std::int64_t motion_ns, std::uint64_t at_ns) const noexcept {
    const std::uint64_t planned = planned_ns(motion_ns);
    return at_ns > planned ? at_ns - planned : 0;
}

std::uint64_t EdgeClock::made(std::int64_t motion_ns, std::uint64_t at_ns) noexcept {
    const std::uint64_t late = late_ns(motion_ns, at_ns);
    last_ns_ = at_ns;
    last_motion_ns_ = motion_ns;
    if (late > settings_.tolerated_ns) {
        base_ns_ += late;
        schedule_slip_ns_ += late;
    }
    return late;
}

} // namespace splinefeed::hal::gpio
