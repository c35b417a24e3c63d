// SPDX-License-Identifier: MIT
//
// With the reserve S the rate changes by 1 in 2 S. Rising from 0: m = t^2 / 4 S up to t = 2 S, then t - S. Falling for
// f from the rate r = f / 2 S: m = r t - t^2 / 4 S up to t = f, where m = S r^2. A stop may have an S of its own: f is
// then what it takes from the rate that has risen. instant() solves both for t. time() uses integers, so it is exact
// for instants of any size; f^2 <= 4 S^2 fits 64 bits.
#include "splinefeed/hal/rt/motion_clock.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::hal {

void MotionClock::start(std::uint64_t at) noexcept {
    base_ = 0;
    start_ = at;
    rises_ = false;
    stopping_ = false;
}

void MotionClock::stop(std::uint64_t at, std::uint64_t reserve) noexcept {
    stop_reserve_ = reserve;
    stop_ = std::max(at, start_);
    stopping_ = true;
}

void MotionClock::resume(std::uint64_t at) noexcept {
    base_ = time(at);
    start_ = at;
    rises_ = true;
    stopping_ = false;
}

void MotionClock::delay(std::uint64_t by) noexcept {
    start_ += by;
    stop_ += by;
}

std::uint64_t MotionClock::risen(std::uint64_t passed) const noexcept {
    return !rises_ ? passed : passed < 2 * reserve_ ? passed * passed / (4 * reserve_) : passed - reserve_;
}

/// Duration of the slow-down, from the rate at stop_.
std::uint64_t MotionClock::fall() const noexcept {
    const bool whole = !rises_ || stop_ - start_ >= 2 * reserve_;
    return whole ? 2 * stop_reserve_ : (stop_ - start_) * stop_reserve_ / reserve_;
}

std::uint64_t MotionClock::time(std::uint64_t now) const noexcept {
    if (now <= start_) {
        return base_;
    }
    if (!stopping_ || now <= stop_) {
        return base_ + risen(now - start_);
    }
    const std::uint64_t falls = fall();
    const std::uint64_t t = std::min(now - stop_, falls);
    return base_ + risen(stop_ - start_) + (2 * falls * t - t * t) / (4 * stop_reserve_);
}

std::uint64_t MotionClock::instant(std::int64_t time) const noexcept {
    const std::uint64_t from = stopping_ ? stop_ : start_;
    const std::int64_t way = time - static_cast<std::int64_t>(this->time(from));
    if (!stopping_ && !rises_) {
        return from + static_cast<std::uint64_t>(way); // also for negative times
    }
    if (way <= 0) {
        return from;
    }
    const auto m = static_cast<double>(way);
    if (stopping_) {
        const auto reserve = static_cast<double>(stop_reserve_);
        const double rate = static_cast<double>(fall()) / (2.0 * reserve);
        const double square = rate * rate - m / reserve;
        return square < 0.0
                   ? never
                   : from + static_cast<std::uint64_t>(std::llround(2.0 * reserve * (rate - std::sqrt(square))));
    }
    const auto reserve = static_cast<double>(reserve_);
    return from + (m < reserve ? static_cast<std::uint64_t>(std::llround(2.0 * std::sqrt(reserve * m)))
                               : static_cast<std::uint64_t>(way) + reserve_);
}

} // namespace splinefeed::hal
