// SPDX-License-Identifier: MIT
// Joint: what becomes of the place where two moves meet, and the blend that rounds it.
#pragma once

#include "splinefeed/s1_blended_path/path_move.hpp"
#include "splinefeed/s1_blended_path/path_rules.hpp"

namespace splinefeed {

enum class JointKind : std::uint8_t {
    stop,    ///< the machine stops there, exactly
    through, ///< the moves meet in one direction: nothing to round
    blend,   ///< a blend replaces both ends
};

template <Scalar S>
struct Joint {
    JointKind kind = JointKind::stop;
    S way{};       ///< of a blend: what it would take of each move if there is room, in chord units
    S half_sine{}; ///< sin(phi/2) of the angle phi between the moves
    S tolerance{}; ///< largest distance of the blend from the moves, in chord units
    S sharpest{};  ///< largest curvature of a blend in units of 2^-20 per chord unit; 0: any
};

/// What a joint may be, in chord units.
template <Scalar S>
struct JointTolerances {
    S corner{};                  ///< 0: the path is exact
    S exact{};                   ///< of an exact path, where it turns by less than a degree
    SharpestBlend<S> sharpest{}; ///< its curvature in units of 2^-20 per chord unit
    bool curvature = true;       ///< an exact path is rounded where only its curvature jumps, too
    SmoothJoint<S> smooth{};     ///< its curvature likewise
    PassedKink<S> kink{};
};

/// Decides by the geometry of two moves alone, so the path does not depend on feed or override. A joint is a stop at a
/// reversal (within half a degree). In exact_path mode it is one where the direction jumps by more than a degree. Where
/// the tolerance of exact paths is 0, smaller jumps stay, and a plan stops there.
template <Scalar S>
[[nodiscard]] Joint<S> decide_joint(const PathMove<S>& before, const PathMove<S>& after, PathMode mode,
                                    const JointTolerances<S>& tolerances, int axes) noexcept;

/// Bezier points as offsets from the joint, in chord units.
template <Scalar S>
struct Blend {
    int degree = 0;
    S way{}; ///< what it takes of each move
    PerAxis<PerDegree<S>> points{};
};

/// The blend of a joint that has `room` on both moves. It joins both with their direction and curvature (G2), lies
/// within joint.tolerance of the moves, and they within it. Between lines that holds by construction; where a move is
/// an arc or a Bezier segment it is measured at eleven places, and the blend made shorter. false: there is none, the
/// machine has to stop.
///
/// Between lines: a cubic with both inner points on the corner; its largest distance from the corner is
/// way sin(phi/2) / 4. Where the room is shorter than joint.way it becomes a quintic that uses the tolerance on less
/// way. Where the curvature jumps: Hermite's quintic. Cost: between lines a division; otherwise some hundred products.
/// @param roundest  PathRules::roundest
template <Scalar S>
[[nodiscard]] bool fit_blend(const Joint<S>& joint, const PathMove<S>& before, const PathMove<S>& after, S room,
                             int axes, Blend<S>& out, S roundest = from_integer<S>(1)) noexcept;

} // namespace splinefeed
