// SPDX-License-Identifier: MIT
//
// With D = end - start and the velocities m0, m1 in units per segment, a segment is
//
//   start + a1 u + a2 u^2 + a3 u^3,   a1 = m0,  a2 = 3 D - 2 m0 - m1,  a3 = m0 + m1 - 2 D,   u = 0 to 1.
#include "python/native/samples.hpp"

#include "splinefeed/base/units.hpp"

#include <array>
#include <cmath>

namespace splinefeed::python {

namespace {

/// Coefficients in mm of one axis, for u = 0 to 1.
struct Cubic {
    double start = 0.0;
    std::array<double, 3> a{}; // of u, u^2, u^3
};

Cubic cubic_of(const FeedSegment& segment, unsigned axis, double mm_per_unit) {
    const auto distance = static_cast<double>(segment.end[axis] - segment.start[axis]);
    const auto m0 = static_cast<double>(segment.start_velocity[axis]);
    const auto m1 = static_cast<double>(segment.end_velocity[axis]);
    return {
        static_cast<double>(segment.start[axis]) * mm_per_unit,
        {m0 * mm_per_unit, (3.0 * distance - 2.0 * m0 - m1) * mm_per_unit, (m0 + m1 - 2.0 * distance) * mm_per_unit}};
}

/// A time in ticks; what misses a whole tick by the rounding of seconds is that tick.
double ticks_of(double seconds) {
    constexpr double rounding = 1e-15; // of the time, relative
    const double ticks = seconds * (ticks_per_us * 1e6);
    const double whole = std::nearbyint(ticks);
    return std::fabs(ticks - whole) <= rounding * ticks ? whole : ticks;
}

} // namespace

void sample_motion(const host::KeptMotion& motion, std::span<const double> mm_per_unit, std::span<const double> times,
                   const SampleRows& out) {
    const std::size_t axes = mm_per_unit.size();
    const double segment_ticks = motion.segment_ticks();
    const double per_s = ticks_per_us * 1e6 / segment_ticks;
    const auto last = static_cast<double>(motion.size() - 1);
    PerAxis<Cubic> cubics{};
    FeedSegment segment;
    std::size_t at = motion.size(); // none
    for (std::size_t row = 0; row < times.size(); ++row) {
        const double place = ticks_of(times[row]) / segment_ticks;
        const double begin = std::fmin(std::floor(place), last);
        if (const auto now = static_cast<std::size_t>(begin); now != at) {
            at = now;
            segment = motion.segment(now);
            for (unsigned k = 0; k < axes; ++k) {
                cubics[k] = cubic_of(segment, k, mm_per_unit[k]);
            }
        }
        const double u = place - begin;
        const bool moves = u < 1.0;
        for (unsigned k = 0; k < axes; ++k) {
            const auto& [start, a] = cubics[k];
            const std::size_t i = row * axes + k;
            out.position[i] = moves ? start + u * (a[0] + u * (a[1] + u * a[2]))
                                    : static_cast<double>(segment.end[k]) * mm_per_unit[k];
            out.velocity[i] = moves ? (a[0] + u * (2.0 * a[1] + u * 3.0 * a[2])) * per_s : 0.0;
            out.acceleration[i] = moves ? (2.0 * a[1] + 6.0 * u * a[2]) * (per_s * per_s) : 0.0;
            out.jerk[i] = moves ? 6.0 * a[2] * (per_s * per_s * per_s) : 0.0;
        }
    }
}

} // namespace splinefeed::python
