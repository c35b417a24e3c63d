// SPDX-License-Identifier: MIT
// beta_chain: a chain of Bezier polygons of one degree; each continues the previous one with G1 or G2 (Barsky &
// DeRose).
#pragma once

#include "splinefeed/splines/beta_joint.hpp"

#include <cstddef>

namespace splinefeed {

/// The input. Each joint determines points 0 to order of the polygon after it; the other points are free.
template <Scalar S>
struct BetaChain {
    int degree = 3; ///< of every polygon: at least the order; if closed, at least 2 order + 1
    int order = 2;  ///< 1: G1, 2: G2
    bool closed = false;
    std::span<const Point<S>> first_polygon; ///< degree + 1 points; empty if closed
    std::span<const Point<S>> free_points; ///< degree - order points for each polygon that a joint begins, one polygon
                                           ///< after the other
    std::span<const Beta<S>> betas;        ///< one per joint; if closed, the last joint leads back to polygon 0

    [[nodiscard]] std::size_t joint_count() const noexcept { return betas.size(); }
    [[nodiscard]] std::size_t piece_count() const noexcept { return betas.size() + (closed ? 0U : 1U); }
};

/// Builds the pieces and the points of every joint, in order. Class at every joint as for beta_joint: G1, or G2 of the
/// curvature vector, for any free points. No point of a joint depends on the free points after it. A closed
/// chain with a degree below 2 order + 1 is refused: one joint would overwrite the points that the next joint reads.
/// Source: Barsky & DeRose (8b), with free points W3 ... Wd (the text's "only W3" is the cubic case). After an error
/// the content of the storage is undefined; `failed_joint`, if given, receives the index of the joint.
template <Scalar S>
Status beta_chain(const BetaChain<S>& chain, std::span<BezierPiece<S>> pieces, std::span<BetaJoint<S>> joints,
                  std::size_t* failed_joint = nullptr) noexcept;

} // namespace splinefeed
