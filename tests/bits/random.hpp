// SPDX-License-Identifier: MIT
// Random numbers that are the same on every target, and a path made of them.
#pragma once

#include "splinefeed/s1_curve/waypoint.hpp"

#include <cstdint>

namespace bits {

/// xorshift64*, Vigna.
class Random {
public:
    explicit constexpr Random(std::uint64_t seed) noexcept : state_(seed * 0x9e3779b97f4a7c15U + 1U) {}

    /// 0 to range - 1.
    std::int32_t below(std::int32_t range) noexcept {
        state_ ^= state_ >> 12;
        state_ ^= state_ << 25;
        state_ ^= state_ >> 27;
        const std::uint64_t mixed = (state_ * 0x2545f4914f6cdd1dU) >> 33;
        return static_cast<std::int32_t>(mixed % static_cast<std::uint64_t>(range));
    }

private:
    std::uint64_t state_;
};

/// Waypoints that wander: moves of 0.1 um to 20 mm, bends and reversals, with and without a feed of their own.
template <splinefeed::Scalar S>
class Wandering {
public:
    Wandering(std::uint64_t seed, int points) noexcept : random_(seed), left_(points) {}

    [[nodiscard]] bool empty() const noexcept { return left_ == 0; }
    splinefeed::Waypoint<S> next() noexcept {
        splinefeed::Waypoint<S> out;
        const std::int32_t size = random_.below(4) == 0 ? 1 << random_.below(12) : 20000;
        for (unsigned k = 0; k < 3; ++k) {
            const std::int32_t step = k == 2 ? size / 8 : size;
            // Mostly onwards, so that not every waypoint is a corner.
            at_um_[k] += random_.below(step + 1) - (random_.below(3) == 0 ? step : step / 8);
            out.position[k] = splinefeed::position_from_um(at_um_[k]);
        }
        if (random_.below(3) == 0) {
            out.feed_mm_s = splinefeed::from_integer<S>(1 + random_.below(90));
        }
        if (random_.below(8) == 0) {
            out.max_feed_mm_s = splinefeed::from_integer<S>(5 + random_.below(60));
        }
        --left_;
        return out;
    }

private:
    Random random_;
    int left_;
    std::int64_t at_um_[3] = {};
};

} // namespace bits
