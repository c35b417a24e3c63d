// SPDX-License-Identifier: MIT
// MachineTiming: what the limits, and the rules of a path, both derive of a machine's numbers.
#pragma once

#include "splinefeed/number/scalar.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_settings.hpp"

namespace splinefeed {

namespace detail {

/// The same part for joints whose change of direction is tolerated (Refinement::direction_jump).
inline constexpr double corner_share = 2e-5;

/// The largest jerk that the emitted motion can have, whatever is planned. In a segment it goes at most from one
/// acceleration to the opposite one (feed_derivation.md, step 7 of the proof). A jerk limit above it does not bind.
constexpr double sampled_jerk(const AxisSettings& axis, double segment_s) noexcept {
    const double jerk = (axis.max_acceleration_mm_s2 + axis.braking_mm_s2()) / segment_s;
    return jerk < 1073741824.0 ? jerk : 1073741824.0; // above every limit, and in the range of a Fixed
}

/// The jerk limit of an axis, or the largest jerk that it can have where no limit binds.
constexpr double planned_jerk(const AxisSettings& axis, double segment_s) noexcept {
    const double most = sampled_jerk(axis, segment_s);
    return axis.max_jerk_mm_s3 > 0.0 && axis.max_jerk_mm_s3 < most ? axis.max_jerk_mm_s3 : most;
}

/// The part of a jerk limit that planning leaves for jumps of the curvature.
inline constexpr double jerk_reserve = 5e-4;

/// The part of the limits that a plan leaves beside a kink, at most. A kink that needs more at the speed of the path is
/// passed more slowly, or is a stop.
inline constexpr double kink_share = 0.15;

/// The smallest jerk limit that binds; 0: none does.
constexpr double smallest_binding_jerk(const MachineSettings& settings, double segment_s) noexcept {
    double smallest = 0.0;
    for (const unsigned k : indices(settings.axes)) {
        const double jerk = settings.axis[k].max_jerk_mm_s3;
        const bool binds = jerk > 0.0 && jerk < sampled_jerk(settings.axis[k], segment_s);
        smallest = binds && !(smallest > 0.0 && smallest < jerk) ? jerk : smallest;
    }
    return smallest;
}

/// Feed segments per sample period (1, 2, 4 or 8) that keep the smoothing of the path, T^2 |A| / 6, below 0.35 um.
constexpr int segments_per_sample(double period_s, double acceleration_sq) noexcept {
    int n = 1;
    while (n < 8) {
        const double t2 = period_s * period_s / (n * n);
        if (t2 * t2 * acceleration_sq <= 36.0 * 0.35e-3 * 0.35e-3) { // squared, to avoid the root
            break;
        }
        n *= 2;
    }
    return n;
}

/// Speed of a path along which the linear axes keep the feed and each rotary axis its velocity. At most the value whose
/// square, times the numbers of a shape, fits in Fixed.
constexpr double fastest_path(double feed, double turning_sq) noexcept {
    return root_up_to(10000.0, feed * feed + turning_sq);
}

/// A third difference over T^3 has so much of a jump of the acceleration over T, at most.
inline constexpr double jump_in_jerk = 0.75;

} // namespace detail

/// A plain aggregate. @pre the numbers are in their ranges
struct MachineTiming {
    MachineSettings settings; ///< as stated, with accelerations that the jerk limits let an axis reach
    AxisTotals totals;
    bool mixed = false;     ///< some axes are rotary and some are not
    double path_mm_s = 0.0; ///< upper limit of the speed along the path
    double period_s = 0.0;  ///< of a sample,
    int segments = 1;       ///< of so many feed segments,
    double segment_s = 0.0; ///< each of this
    double smoothest = 0.0; ///< smallest jerk limit that binds; 0: none does

    constexpr explicit MachineTiming(const MachineSettings& stated) noexcept
        : settings(within_jerk(stated)), totals(axis_totals(settings)),
          mixed(totals.rotary > 0 && totals.rotary < settings.axes),
          path_mm_s(mixed ? detail::fastest_path(settings.max_feed_mm_s, totals.turning_sq) : settings.max_feed_mm_s),
          period_s(settings.sample_period_us * 1e-6),
          segments(settings.segments_per_sample > 0 ? settings.segments_per_sample
                                                    : detail::segments_per_sample(period_s, totals.acceleration_sq)),
          segment_s(period_s / segments), smoothest(detail::smallest_binding_jerk(settings, segment_s)) {}

    /// A jump of direction d at a joint needs the acceleration v d / T: so large a one is tolerated at any speed.
    [[nodiscard]] constexpr double tolerated_turn() const noexcept {
        return detail::corner_share * totals.softest * segment_s / path_mm_s;
    }
    /// A jump d of an axis's direction at a joint needs the jerk v d / T^2: for kink_share of its limit this is v d.
    [[nodiscard]] constexpr double kink_turn_mm_s(unsigned axis) const noexcept {
        return detail::kink_share * segment_s * segment_s * detail::planned_jerk(settings.axis[axis], segment_s);
    }
    /// The largest kink that is not a stop in any case. Its speed is 1/16 of the largest one, or higher.
    [[nodiscard]] constexpr double sharpest_kink() const noexcept {
        double turn = kink_turn_mm_s(0);
        for (const unsigned k : indices(settings.axes)) {
            turn = smaller(turn, kink_turn_mm_s(k));
        }
        return smoothest > 0.0 ? larger(tolerated_turn(), 16.0 * turn / path_mm_s) : tolerated_turn();
    }
    /// The same of the curvature, for the reserve of the jerk. [1/mm]
    [[nodiscard]] constexpr double tolerated_bend() const noexcept {
        double jerk = 1e9;
        for (const unsigned k : indices(settings.axes)) { // also of an axis without a limit of its own
            const double planned = detail::planned_jerk(settings.axis[k], segment_s);
            jerk = planned < jerk ? planned : jerk;
        }
        return detail::jerk_reserve * jerk * segment_s / (detail::jump_in_jerk * path_mm_s * path_mm_s);
    }
};

} // namespace splinefeed
