// SPDX-License-Identifier: MIT
// beta_chain: a chain of Bezier polygons of one degree, each continuing the one before with G1 or G2 (Barsky & DeRose).
#pragma once

#include "splinefeed/splines/beta_joint.hpp"

#include <cstddef>

namespace splinefeed {

/// What a chain is made of. Each joint gives the polygon after it its points 0 to order; the others are free.
template <Scalar S>
struct BetaChain {
    int degree = 3; ///< of every polygon: at least the order, closed at least 2 order + 1
    int order = 2;  ///< 1: G1, 2: G2
    bool closed = false;
    std::span<const Point<S>> first_polygon; ///< degree + 1 points; closed: none
    std::span<const Point<S>> free_points; ///< degree - order for each polygon that a joint begins, one after the other
    std::span<const Beta<S>> betas;        ///< one a joint; closed: the last joint leads back to polygon 0

    [[nodiscard]] std::size_t joint_count() const noexcept { return betas.size(); }
    [[nodiscard]] std::size_t piece_count() const noexcept { return betas.size() + (closed ? 0U : 1U); }
};

/// Builds the pieces and the points of every joint, in order. Class at every joint as beta_joint has it: G1, or G2 of
/// the curvature vector; for any free points, as no point of a joint depends on what is free after it. A closed chain
/// of a lower degree than 2 order + 1 is refused: one joint would write the points that the next one reads. Barsky &
/// DeRose (8b), with free points W3 ... Wd (the text's "only W3" is the cubic). On an error nothing is promised about
/// the storage; `failed_joint`, if given, says at which joint.
template <Scalar S>
Status beta_chain(const BetaChain<S>& chain, std::span<BezierPiece<S>> pieces, std::span<BetaJoint<S>> joints,
                  std::size_t* failed_joint = nullptr) noexcept;

} // namespace splinefeed
