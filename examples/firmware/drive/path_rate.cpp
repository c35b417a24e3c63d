// SPDX-License-Identifier: MIT
//
// With T the duration of a step and r0, r1 the rates at its ends the distance is (r0 + r1) T / 2. The law wants
// r1 <= sqrt(R1 / S) with R1 = R0 - (r0 + r1) T / 2, which is
//
//     r1 <= (sqrt(T^2 / 4 + 4 S (R0 - r0 T / 2)) - T / 2) / (2 S).
//
// On the curve, r0 = sqrt(R0 / S), this is r0 - T / (2 S): the law's slope, exactly.
#include "drive/path_rate.hpp"

#include "splinefeed/number/wide_root.hpp"

namespace firmware {

namespace {

constexpr std::uint64_t one_place = 1; // tick: nearer to the end of the ring is at the end, whatever is rounded

std::uint64_t root(std::uint64_t value) noexcept {
    return splinefeed::square_root(splinefeed::Wide{0, value});
}

std::uint64_t half_way(std::uint64_t rates, std::uint32_t ticks) noexcept {
    return (rates * ticks + PathRate::full) >> 31;
}

} // namespace

std::uint32_t PathRate::largest(const Ahead& ahead) const noexcept {
    if (!ahead.ends_moving || ahead.ring_ticks >= reserve_ticks_) {
        return full;
    }
    // sqrt(R / S) = sqrt(R S) / S; R S < 2^53
    return static_cast<std::uint32_t>((root(ahead.ring_ticks * reserve_ticks_ << 10) << 25) / reserve_ticks_);
}

void PathRate::pass_rest(const Ahead& ahead) noexcept {
    const std::uint32_t most = largest(ahead);
    rate_ = rate_ < most ? rate_ : most;
}

bool PathRate::stops_within(std::uint64_t ring_ticks) const noexcept {
    const std::uint64_t square = std::uint64_t{rate_} * rate_ >> 30;
    return square * reserve_ticks_ >> 30 <= ring_ticks;
}

/// The largest rate at the end of a step. @pre ring_ticks < 4 S + longest_step, so that nothing overflows
std::uint32_t PathRate::rate_on_curve(std::uint32_t before, std::uint32_t ticks,
                                      std::uint64_t ring_ticks) const noexcept {
    const std::uint64_t begun = half_way(before, ticks);
    if (ring_ticks <= begun) {
        return 0;
    }
    const std::uint64_t half = ticks / 2;
    const std::uint64_t square = half * half + 4 * std::uint64_t{reserve_ticks_} * (ring_ticks - begun); // below 2^57
    const std::uint64_t twice = root(square << 6) - (half << 3);                                         // 8 r1 2 S
    const std::uint64_t rate = (twice << 27) / (2 * std::uint64_t{reserve_ticks_});
    return rate < full ? static_cast<std::uint32_t>(rate) : full;
}

std::uint64_t PathRate::pass(std::uint32_t ticks, const Ahead& ahead) noexcept {
    const auto change = static_cast<std::uint32_t>((std::uint64_t{full} * ticks + reserve_ticks_) /
                                                   (2 * std::uint64_t{reserve_ticks_}));
    const std::uint32_t before = rate_;
    std::uint64_t way = 0;
    if (ahead.holds && before <= change) { // it stands within the step: r0^2 S
        rate_ = 0;
        way = (std::uint64_t{before} * before >> 30) * reserve_ticks_ >> 30;
    } else {
        rate_ = ahead.holds ? before - change : full - before > change ? before + change : full;
        if (ahead.ends_moving && ahead.ring_ticks < 4 * std::uint64_t{reserve_ticks_} + longest_step) {
            const std::uint32_t most = rate_on_curve(before, ticks, ahead.ring_ticks);
            rate_ = rate_ < most ? rate_ : most;
        }
        way = half_way(std::uint64_t{before} + rate_, ticks);
    }
    if (way + (ahead.holds ? 0 : one_place) < ahead.ring_ticks) {
        return way;
    }
    rate_ = ahead.ends_moving ? 0 : rate_;
    return ahead.ring_ticks;
}

} // namespace firmware
