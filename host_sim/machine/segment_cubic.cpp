// SPDX-License-Identifier: MIT
//
// With D = end - start and the velocities m0, m1 in units per segment, the Hermite cubic is
//
//   start + a1 u + a2 u^2 + a3 u^3,   a1 = m0,  a2 = 3 D - 2 m0 - m1,  a3 = m0 + m1 - 2 D,
//
// and at u = j / n the numerator over n^3 is an integer below 2^67 * 2^30: exact in 128 bits.
#include "host_sim/machine/segment_cubic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace splinefeed::host {

namespace {

// round(numerator / denominator), ties upwards, as floor(x + 1/2); the quotient fits in 64 bits.
std::int64_t nearest_quotient(Wide128 numerator, std::int64_t denominator) noexcept {
    const Wide128 shifted =
        numerator + denominator / 2; // an odd denominator has no ties: the lost half does not matter
    if (shifted >= std::numeric_limits<std::int64_t>::min() && shifted <= std::numeric_limits<std::int64_t>::max()) {
        const auto narrow =
            static_cast<std::int64_t>(shifted); // the usual case; 64 bit division is several times faster
        return narrow / denominator - (narrow % denominator < 0 ? 1 : 0);
    }
    return static_cast<std::int64_t>(shifted / denominator - (shifted % denominator < 0 ? 1 : 0));
}

// Rounded to nearest; of 64 bits by an instruction, of more by a function.
double as_double(Wide128 value) noexcept {
    const auto narrow = static_cast<std::int64_t>(value);
    return narrow == value ? static_cast<double>(narrow) : static_cast<double>(value);
}

} // namespace

std::int64_t nearest_count(std::int64_t units) noexcept {
    std::int64_t count = units / units_per_count;
    std::int64_t rest = units % units_per_count;
    if (rest < 0) {
        rest += units_per_count;
        --count;
    }
    return count + (rest >= units_per_count / 2 ? 1 : 0);
}

SegmentCubic::SegmentCubic(const FeedSegment& segment, unsigned axis, double units_per_mm, double duration_s) noexcept
    : per_duration_(1.0 / duration_s), peak_u_(-1.0) {
    const Wide128 distance = static_cast<Wide128>(segment.end[axis]) - segment.start[axis];
    const Wide128 m0 = segment.start_velocity[axis];
    const Wide128 m1 = segment.end_velocity[axis];
    a1_ = m0;
    a2_ = 3 * distance - 2 * m0 - m1;
    a3_ = m0 + m1 - 2 * distance;
    const double mm_s_per_unit = per_duration_ / units_per_mm;
    b1_ = as_double(a1_) * mm_s_per_unit;
    b2_ = as_double(2 * a2_) * mm_s_per_unit;
    b3_ = as_double(3 * a3_) * mm_s_per_unit;
    const double u = -0.5 * b2_ / b3_;
    if (u > 0.0 && u < 1.0) { // false for the NaN or infinity of b3 = 0
        peak_u_ = u;
    }
}

std::int64_t SegmentCubic::travelled(int j, int n) const noexcept {
    if (j == 0 || j == n) {
        return j == 0 ? 0 : static_cast<std::int64_t>(a1_ + a2_ + a3_);
    }
    const std::int64_t square = std::int64_t{n} * n;
    return nearest_quotient(((a3_ * j + a2_ * n) * j + a1_ * square) * j, square * n);
}

// Between the zeros of velocity and acceleration both keep their signs, and |acceleration|, linear, is largest at an
// end.
Accelerations SegmentCubic::accelerations(double from, double to) const noexcept {
    std::array<double, 5> places{from, to}; // in order
    std::size_t count = 2;
    const auto add = [&](double u) {
        if (u > from && u < to) { // false for NaN
            std::size_t i = count++;
            for (; places[i - 1] > u; --i) {
                places[i] = places[i - 1];
            }
            places[i] = u;
        }
    };
    add(peak_u_);
    // b1 + b2 u + b3 u^2 = 0, without cancellation
    const double root = std::sqrt(b2_ * b2_ - 4.0 * b1_ * b3_);
    const double sum = -0.5 * (b2_ + std::copysign(root, b2_));
    add(sum / b3_);
    add(b1_ / sum);
    Accelerations largest;
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const double middle = 0.5 * (places[i] + places[i + 1]);
        double& most = velocity(middle) * acceleration(middle) < 0.0 ? largest.braking : largest.speeding;
        most = std::max({most, std::fabs(acceleration(places[i])), std::fabs(acceleration(places[i + 1]))});
    }
    return largest;
}

} // namespace splinefeed::host
