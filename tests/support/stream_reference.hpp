// SPDX-License-Identifier: MIT
//
// What a drive sees: every feed segment as a cubic in time, checked in integers or in long double from integers.
//
// With T the duration, p0, p1 the positions and v0, v1 the velocities [units per segment] at its ends, the acceleration
// is linear from 6 (p1 - p0) - 4 v0 - 2 v1 to 6 (p0 - p1) + 2 v0 + 4 v1 [units per segment squared]: its extremes are
// at the ends. The velocity is a parabola with its vertex where the acceleration vanishes.
#pragma once

#include "programs.hpp"

namespace splinefeed_test {

__extension__ using Int128 = __int128;

struct AxisMotion {
    Int128 p0, p1, v0, v1, a0, a1; // units, units per segment, units per segment squared
};

inline AxisMotion motion_of(const FeedSegment& s, unsigned k) {
    AxisMotion m{s.start[k], s.end[k], s.start_velocity[k], s.end_velocity[k], 0, 0};
    m.a0 = 6 * (m.p1 - m.p0) - 4 * m.v0 - 2 * m.v1;
    m.a1 = 6 * (m.p0 - m.p1) + 2 * m.v0 + 4 * m.v1;
    return m;
}

/// Largest |velocity| in the segment [units per segment].
inline Real fastest(const AxisMotion& m) {
    Real v = std::max(std::fabs(static_cast<Real>(m.v0)), std::fabs(static_cast<Real>(m.v1)));
    if ((m.a0 > 0 && m.a1 < 0) || (m.a0 < 0 && m.a1 > 0)) {
        const auto a0 = static_cast<Real>(m.a0);
        v = std::max(v, std::fabs(static_cast<Real>(m.v0) + a0 * a0 / (2.0L * static_cast<Real>(m.a0 - m.a1))));
    }
    return v;
}

inline Real units_per_mm(const AxisSettings& axis) {
    return static_cast<Real>(units_per_count) * static_cast<Real>(axis.steps_per_mm);
}

/// Rounding of a control point in mm: a position to 2^-41, steps_per_mm times it to 3 units (half of a multiple of 6).
inline Real sample_rounding(const AxisSettings& axis) {
    return 0x1p-41L + 3.0L / units_per_mm(axis);
}

/// Parts of the limits that are used, 1 being all of one. Acceleration is compared as it is; velocity and feed first
/// give up what the rounding of two control points, e, makes of a first difference: 2 e / T.
struct Used {
    Real velocity = 0.0L;
    Real acceleration = 0.0L;
    Real feed = 0.0L;
    Real jerk = 0.0L; ///< of axes that have a limit
};

/// The part of its limit that an axis uses where braking has one of its own, at 33 places of the segment: |a| against
/// the limit that the sign of the velocity there says. `scale`: units per segment squared in a mm/s^2.
inline Real braked(const AxisMotion& m, Real scale, const AxisSettings& axis) {
    const auto v0 = static_cast<Real>(m.v0);
    const auto a0 = static_cast<Real>(m.a0);
    const auto change = static_cast<Real>(m.a1 - m.a0);
    Real used = 0.0L;
    for (int i = 0; i <= 32; ++i) {
        const Real u = static_cast<Real>(i) / 32.0L;
        const Real v = v0 + u * (a0 + u * change / 2.0L);
        const Real a = a0 + u * change;
        const double limit = a * v < 0.0L ? axis.braking_mm_s2() : axis.max_acceleration_mm_s2;
        used = std::max(used, std::fabs(a) / (scale * real(limit)));
    }
    return used;
}

/// Checks that the segments chain exactly in position, velocity and acceleration from rest to rest, and measures them.
/// Returns what breaks first, empty if nothing.
inline const char* check_stream(const std::vector<FeedSegment>& segments, const MachineSettings& machine, Used& used) {
    const auto axes = static_cast<unsigned>(machine.axes);
    if (segments.empty()) {
        return "no segments";
    }
    const Real duration = static_cast<Real>(segments[0].duration_ticks) / (ticks_per_us * 1e6L);
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const FeedSegment& s = segments[i];
        if (s.index != i || s.duration_ticks != segments[0].duration_ticks) {
            return "index or duration";
        }
        if (i > 0 && s.waypoint < segments[i - 1].waypoint) {
            return "waypoint goes back";
        }
        std::array<Real, 2> feed_sq{}; // of linear and of rotary axes
        Real feed_noise = 0.0L;
        bool stands = true; // the linear axes
        for (unsigned k = 0; k < axes; ++k) {
            const AxisSettings& axis = machine.axis[k];
            const AxisMotion m = motion_of(s, k);
            if (i == 0 && (m.v0 != 0 || m.a0 != 0)) {
                return "does not start at rest";
            }
            if (i + 1 == segments.size() && (m.v1 != 0 || m.a1 != 0)) {
                return "does not end at rest";
            }
            if (i > 0) {
                const AxisMotion before = motion_of(segments[i - 1], k);
                if (before.p1 != m.p0 || before.v1 != m.v0 || before.a1 != m.a0) {
                    return "chain broken";
                }
            }
            const Real scale = units_per_mm(axis) * duration;
            const Real noise = 2.0L * sample_rounding(axis) / duration;
            const Real a = std::fabs(static_cast<Real>(std::max(m.a0 < 0 ? -m.a0 : m.a0, m.a1 < 0 ? -m.a1 : m.a1)));
            if (axis.braking_mm_s2() != axis.max_acceleration_mm_s2) {
                used.acceleration = std::max(used.acceleration, braked(m, scale * duration, axis));
            } else {
                used.acceleration = std::max(used.acceleration,
                                             a / (scale * duration * static_cast<Real>(axis.max_acceleration_mm_s2)));
            }
            used.velocity = std::max(used.velocity, (fastest(m) / scale - noise) / real(axis.max_velocity_mm_s));
            if (axis.max_jerk_mm_s3 > 0.0) {
                const Real jerk = std::fabs(static_cast<Real>(m.a1 - m.a0)) / (scale * duration * duration);
                const Real rounding = 8.0L * sample_rounding(axis) / (duration * duration * duration);
                used.jerk = std::max(used.jerk, (jerk - rounding) / real(axis.max_jerk_mm_s3));
            }
            const Real v = static_cast<Real>(m.v0) / scale;
            feed_sq[axis.rotary ? 1 : 0] += v * v;
            stands = stands && (axis.rotary || (m.p0 == m.p1 && m.v0 == 0 && m.v1 == 0));
            feed_noise += noise * noise;
        }
        used.feed = std::max(used.feed, (std::sqrt(feed_sq[stands ? 1 : 0]) - std::sqrt(feed_noise)) /
                                            real(machine.max_feed_mm_s));
    }
    return "";
}

/// Position that the stream must reach: the target rounded to a multiple of 6 units, through Q32.32 steps per mm.
inline std::int64_t target_units(double mm, const AxisSettings& axis) {
    const auto steps = static_cast<std::uint64_t>(axis.steps_per_mm * 4294967296.0);
    const Int128 product = static_cast<Int128>(position_from_mm(mm).raw) * static_cast<Int128>(steps);
    const Int128 size = ((product < 0 ? -product : product) + (Int128{1} << 42)) >> 43;
    return static_cast<std::int64_t>(6 * (product < 0 ? -size : size));
}

} // namespace splinefeed_test
