// SPDX-License-Identifier: MIT
// PathRules: what a path within a tolerance has to know of the machine that travels it.
#pragma once

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/number/scalar.hpp"

namespace splinefeed {

/// Corners that are stops because a plan would take longer for their blend. Their blend bends more than
/// curvature_1_mm / (1 - fading sin^2(phi/2))^2, with the angle phi between the moves. Where the root is below 1/4,
/// none is; nor is one where sin(phi/2) is below half_sine. Above half_sine two lines are no chain either.
template <Scalar S>
struct SharpestBlend {
    S curvature_1_mm{}; ///< 0: no corner is a stop for that
    S fading{};         ///< 0: the same for all angles
    S half_sine{};
};

/// Joints that a plan passes at any speed: nothing is rounded there.
template <Scalar S>
struct SmoothJoint {
    S jump = literal<S>(std::same_as<S, float> ? 1e-6 : 4e-7); ///< of the unit tangent, at most
    S bend_1_mm{};                                             ///< of the curvature, at most
};

/// Kinks that stay: a plan keeps something of its limits beside them. The default: none.
template <Scalar S>
struct PassedKink {
    PerAxis<S> turn_mm_s{};          ///< speed times the jump of an axis's direction, at most
    PerAxis<S> acceleration_mm_s2{}; ///< a bent path is travelled within these,
    S fastest_mm_s{};                ///< and this, at most
    S bend_s{};   ///< a jump of the curvature counts as one of the direction, times this and the speed
    S sharpest{}; ///< jump of the direction, at most
};

/// path_rules() makes them of a machine's numbers.
template <Scalar S>
struct PathRules {
    S joint_tolerance_mm{}; ///< of exact paths, where they turn by less than a degree or only their curvature jumps; 0:
                            ///< such joints stay
    SharpestBlend<S> sharpest{};  ///< corners that are stops
    bool rounds_curvature = true; ///< false: joints where only the curvature jumps stay
    int chain_quarters = 4; ///< quarters of a move's tolerance that chains of short lines get, where the program does
                            ///< not say it
    SmoothJoint<S> smooth{};
    PassedKink<S> kink{};
    PerAxis<bool> rotary{};          ///< axes that the feed does not count where others move
    S roundest = from_integer<S>(1); ///< 1 to 2: how far from a corner a blend may pass that has less room than its
                                     ///< tolerance allows: (1/4 + roundest / 8) way sin(phi/2)
};

/// The same in another scalar.
template <Scalar S>
[[nodiscard]] constexpr PathRules<S> rules_cast(const PathRules<double>& rules) noexcept {
    const SharpestBlend<double>& sharpest = rules.sharpest;
    const SmoothJoint<double>& smooth = rules.smooth;
    PassedKink<S> kink{{},
                       {},
                       from_double<S>(rules.kink.fastest_mm_s),
                       from_double<S>(rules.kink.bend_s),
                       from_double<S>(rules.kink.sharpest)};
    for (const unsigned k : indices(max_axes)) {
        kink.turn_mm_s[k] = from_double<S>(rules.kink.turn_mm_s[k]);
        kink.acceleration_mm_s2[k] = from_double<S>(rules.kink.acceleration_mm_s2[k]);
    }
    return {
        from_double<S>(rules.joint_tolerance_mm),
        {from_double<S>(sharpest.curvature_1_mm), from_double<S>(sharpest.fading), from_double<S>(sharpest.half_sine)},
        rules.rounds_curvature,
        rules.chain_quarters,
        {larger(from_double<S>(smooth.jump), std::same_as<S, float> ? SmoothJoint<S>{}.jump : S{}),
         from_double<S>(smooth.bend_1_mm)},
        kink,
        rules.rotary,
        from_double<S>(rules.roundest)};
}

} // namespace splinefeed
