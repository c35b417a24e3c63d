// SPDX-License-Identifier: MIT
// path_rules: the PathRules of a machine.
#pragma once

#include "splinefeed/number/scalar.hpp"
#include "splinefeed/s1_blended_path/path_rules.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_timing.hpp"

namespace splinefeed {

namespace detail {

/// The acceleration across the path, v^2 kappa, that a machine allows whatever its axes do.
constexpr double bent_acceleration(const MachineSettings& machine) noexcept {
    auto least = largest<double>();
    if (machine.centripetal_mm_s2 > 0.0) {
        least = machine.centripetal_mm_s2;
    }
    if (machine.chord_error_mm > 0.0) {
        const double period_s = machine.sample_period_us * 1e-6;
        least = smaller(least, 8.0 * machine.chord_error_mm / (period_s * period_s));
    }
    return least;
}

} // namespace detail

/// The corners that a planner passes more slowly than a stop (bench/tolerance.py; corners of 1 to 170 degrees between
/// lines of 1 to 40 mm). Without a jerk limit a blend is faster, but for a centripetal limit C, or a chord error, that
/// is well below the acceleration A. The blend then loses where v^2 = C / kappa is far below the feed, and where
/// sin(phi/2) is above 1.5 C / A. Both times are those of A on the same way. (By integrating v^2 along corners of 10 to
/// 150 degrees at C, with feeds of 0.7 to 3 times the root of A and the way: 1.4 to 1.8.) With a jerk limit it loses at
/// turns below 105 degrees, where the blend allows less than (1 - 1.6 sin^2(phi/2)) A^2 / (2 J).
[[nodiscard]] constexpr SharpestBlend<double> sharpest_blend(const MachineSettings& machine) noexcept {
    double acceleration = machine.axis[0].max_acceleration_mm_s2;
    for (const unsigned k : indices(machine.axes)) {
        acceleration = smaller(acceleration, machine.axis[k].max_acceleration_mm_s2);
    }
    const double half_feed = machine.max_feed_mm_s / 2.0;
    const double jerk = axis_totals(machine).smoothest;
    if (!(jerk > 0.0)) {
        const double bent = detail::bent_acceleration(machine);
        return bent < acceleration
                   ? SharpestBlend<double>{bent / (half_feed * half_feed), 0.0, 1.5 * bent / acceleration}
                   : SharpestBlend<double>{};
    }
    const double slow = smaller(half_feed, acceleration * acceleration / (2.0 * jerk));
    return {acceleration / (slow * slow), 1.6, 0.0};
}

/// Half of the jumps of direction and curvature that a plan tolerates at a joint at any speed
/// (Refinement::direction_jump, JerkWindow); the other half is rounding's.
[[nodiscard]] constexpr SmoothJoint<double> smooth_joint(const MachineSettings& machine) noexcept {
    if (!(machine.max_feed_mm_s > 0.0)) {
        return {}; // of no machine yet
    }
    const MachineTiming timing(machine);
    const double most = SmoothJoint<double>{}.jump;
    return {smaller(most, 0.5 * timing.tolerated_turn() + 1e-9), 0.5 * timing.tolerated_bend()};
}

/// The kinks that a jerk-limited plan passes at any speed, with a part of its limits (detail::kink_share).
[[nodiscard]] constexpr PassedKink<double> passed_kink(const MachineSettings& machine) noexcept {
    PassedKink<double> kink;
    if (!(machine.max_feed_mm_s > 0.0) || !(axis_totals(machine).smoothest > 0.0)) {
        return kink;
    }
    const MachineTiming timing(machine);
    if (!(timing.smoothest > 0.0)) {
        return kink;
    }
    for (const unsigned k : indices(machine.axes)) {
        kink.turn_mm_s[k] = timing.kink_turn_mm_s(k);
        kink.acceleration_mm_s2[k] = timing.settings.axis[k].smaller_acceleration_mm_s2();
    }
    kink.fastest_mm_s = timing.path_mm_s;
    kink.bend_s = detail::jump_in_jerk * timing.segment_s;
    kink.sharpest = 0.5 * timing.sharpest_kink();
    return kink;
}

/// What a TolerancePath has to know of a machine. Only with a jerk limit do jumps of the curvature cost time. Without
/// one the joint tolerance is 0.625 of what is asked for: the samples leave the path by up to 0.35 um besides. So with
/// the usual micrometre the motion, too, keeps it. And chains of short lines get three quarters of a tolerance, because
/// the joints at their ends cost more time than they would gain with all of it.
/// @param joint_tolerance_mm  of exact paths, where they turn by less than a degree or the curvature jumps
[[nodiscard]] constexpr PathRules<double> path_rules(const MachineSettings& machine,
                                                     double joint_tolerance_mm = 0.001) noexcept {
    const bool jerk_limited = axis_totals(machine).smoothest > 0.0;
    PathRules<double> rules{jerk_limited ? joint_tolerance_mm : 0.625 * joint_tolerance_mm,
                            sharpest_blend(machine),
                            jerk_limited,
                            jerk_limited ? 4 : 3,
                            smooth_joint(machine),
                            passed_kink(machine)};
    for (const unsigned k : indices(machine.axes)) {
        rules.rotary[k] = machine.axis[k].rotary;
    }
    return rules;
}

} // namespace splinefeed
