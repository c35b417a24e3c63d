// SPDX-License-Identifier: MIT
//
// The velocity is a parabola with the Bezier points first, first + second, first + 2 second + 3 third: if none is
// negative, or none positive, it has no zero inside. Otherwise its vertex separates its zeros, and bisection finds
// them: 32 steps in integers are exact to 2^-32 of the duration, where the distance differs from that at the zero by
// less than the rounding of at(). There is no division.
#include "splinefeed/s5_pulse_train/monotone_parts.hpp"

namespace splinefeed {

namespace {

constexpr std::uint32_t whole = 0xffffffffU;

/// The instant between two at which the velocity changes its sign.
std::uint32_t zero_between(const AxisCubic& cubic, std::uint32_t low, std::uint32_t high, bool rising) noexcept {
    while (high - low > 1) {
        const std::uint32_t middle = low + (high - low) / 2;
        const std::int64_t slope = cubic.slope(middle);
        if (rising ? slope > 0 : slope < 0) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}

/// Where a line from a to b, of different signs, passes zero.
std::uint32_t zero_of_line(std::int64_t a, std::int64_t b) noexcept {
    std::uint32_t low = 0;
    for (std::uint32_t bit = 0x80000000U; bit != 0; bit >>= 1) {
        const std::int64_t value = a + times_q32(b - a, low + bit);
        low += (value < 0) == (a < 0) ? bit : 0U;
    }
    return low;
}

} // namespace

MonotoneParts::MonotoneParts(const AxisCubic& cubic, std::int64_t way) noexcept {
    const std::int64_t middle = cubic.first + cubic.second;
    const std::int64_t last = middle + cubic.second + 3 * cubic.third;
    const bool never_down = cubic.first >= 0 && middle >= 0 && last >= 0;
    if (never_down || (cubic.first <= 0 && middle <= 0 && last <= 0)) {
        part_[0] = {whole, way, never_down};
        size_ = 1;
    } else {
        cut(cubic, way, middle, last);
    }
}

void MonotoneParts::cut(const AxisCubic& cubic, std::int64_t way, std::int64_t middle, std::int64_t last) noexcept {
    const std::int64_t before = middle - cubic.first;
    const std::int64_t after = last - middle;
    const bool has_vertex = (before < 0) != (after < 0);
    const std::uint32_t vertex = has_vertex ? zero_of_line(before, after) : whole;
    const std::int64_t at_vertex = has_vertex ? cubic.slope(vertex) : last;
    // From a standstill the motion goes in the direction to which its velocity changes.
    bool rising = cubic.first > 0 || (cubic.first == 0 && (at_vertex > 0 || (at_vertex == 0 && last > 0)));
    std::uint32_t from = 0;
    const std::array<std::uint32_t, 2> places{vertex, whole};
    const std::array<std::int64_t, 2> slopes{at_vertex, last};
    for (unsigned i = has_vertex ? 0U : 1U; i < 2; ++i) {
        if (rising ? slopes[i] < 0 : slopes[i] > 0) {
            const std::uint32_t turn = zero_between(cubic, from, places[i], rising);
            part_[size_++] = {turn, cubic.at(turn), rising};
            rising = !rising;
        }
        from = places[i];
    }
    part_[size_++] = {whole, way, rising};
}

} // namespace splinefeed
