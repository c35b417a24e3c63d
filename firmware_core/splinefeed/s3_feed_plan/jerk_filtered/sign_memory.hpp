// SPDX-License-Identifier: MIT
// SignMemory: in which direction a motion accelerated last, and how long ago.
#pragma once

#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

enum class AccelerationSign : std::int8_t { braking, none, accelerating };

/// A motion that is averaged over a time may change the sign of its acceleration only after that time at constant
/// speed.
template <Scalar S>
class SignMemory {
public:
    /// Records that v^2 went from one value to the other in this number of ticks.
    void pass(S from_sq, S to_sq, S ticks) noexcept {
        if (!changes(from_sq, to_sq)) {
            since_ = smaller(since_ + smaller(ticks, from_integer<S>(long_ago)), from_integer<S>(long_ago));
        } else {
            last_ = to_sq > from_sq ? AccelerationSign::accelerating : AccelerationSign::braking;
            since_ = S{};
        }
    }
    /// The sign of the last acceleration; none: it has not accelerated since standstill.
    [[nodiscard]] AccelerationSign last() const noexcept { return last_; }
    /// Ticks at constant speed that are still missing before the sign may change.
    /// @param ticks  length of the average
    [[nodiscard]] S left(std::int32_t ticks) const noexcept { return from_integer<S>(ticks) - since_; }
    /// Whether the speed was constant for long enough to change the sign.
    [[nodiscard]] bool rested(std::int32_t ticks) const noexcept {
        constexpr double same = 0x1p-14; // of a tick
        return !(since_ < from_integer<S>(ticks) - literal<S>(same));
    }

private:
    static constexpr std::int32_t long_ago = 1 << 20; // ticks; longer than any average

    /// Whether the speeds differ by more than rounding.
    static bool changes(S from_sq, S to_sq) noexcept {
        const S least = std::same_as<S, Fixed> ? literal<S>(0x1p-30) : from_sq * literal<S>(0x1p-44);
        return absolute(to_sq - from_sq) > least;
    }

    S since_{};
    AccelerationSign last_ = AccelerationSign::none;
};

} // namespace splinefeed
