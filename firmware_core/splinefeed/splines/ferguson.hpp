// SPDX-License-Identifier: MIT
// The composite Ferguson curve: cubic Hermite segments joined with a length ratio lambda, a tension mu and a sign of
// the curvature delta at every knot.
//
// Karpenko & Kleshchev, "Influence of the sign of curvature on parametric spline curves". Joint i asks
//     r_{i+1}''(0) = delta_i lambda_i^2 r_i''(1) + mu_i r_i'(1),   r_{i+1}'(0) = lambda_i r_i'(1),
// and with t_i = r_i'(1), the incoming tangent, this is row i of a tridiagonal system, (7) and (9):
//     delta_i lambda_i^2 lambda_{i-1} t_{i-1} + 2 (mu_i/4 + delta_i lambda_i^2 + lambda_i) t_i + t_{i+1}
//         = 3 (r_{i+1} - (1 - delta_i lambda_i^2) r_i - delta_i lambda_i^2 r_{i-1}).
// What the print has wrong and is not followed:
// - (9) has delta lambda^2 below the diagonal: the segment before leaves its knot with lambda_{i-1} t_{i-1};
// - (7) puts the diagonal coefficient on r_2'(0) = lambda t_i; it belongs to r_1'(1) = t_i;
// - (10), the bound of dominance, has lambda^2 + 1 for |delta| lambda_i^2 lambda_{i-1} + 1, and joins two disjoint
//   half-lines of mu by "and". Nor is it a condition of solvability: that is judged on the system itself;
// - "class C2" holds for delta = lambda = 1, mu = 0 only: see FergusonClass.
//
// When not to use delta = -1: nearly always. It turns the curvature vector round at the knot (only |kappa| is
// continuous); the right side becomes a second difference, so that the tangent in the centre of a symmetric S is
// exactly zero (a stop), on straight data the curve may run backwards, and with mu = 0 the system is singular for
// every odd number of equal joints. A true inflection needs no sign: with delta = +1 it falls inside a segment. Loops
// come from uniform parameters on uneven chords; mu removes them, delta does not.
#pragma once

#include "splinefeed/splines/cyclic_system.hpp"

namespace splinefeed {

template <Scalar S>
struct FergusonJoint {
    S lambda = literal<S>(1); ///< |r_{i+1}'(0)| / |r_i'(1)|: 2^-4 to 2^4 in Fixed, 2^-20 to 2^20 else
    S mu{};                   ///< tension; |mu| <= 2^16 in Fixed, 2^60 else
    int delta = 1;            ///< +1, -1
};

/// Continuity that the conditions of a joint give, where its tangent is not zero. As a formula, not as measured:
/// special data can be smoother.
enum class FergusonClass : std::uint8_t {
    c2,           ///< delta = lambda = 1, mu = 0
    c1_g2,        ///< delta = lambda = 1
    g2,           ///< delta = 1
    c1_abs_kappa, ///< delta = -1, lambda = 1: the modulus of curvature is continuous, its vector turns round
    g1_abs_kappa, ///< delta = -1
    undefined,    ///< the tangent is zero: there is no direction and no curvature
};
template <Scalar S>
[[nodiscard]] FergusonClass ferguson_class(const FergusonJoint<S>& joint, bool tangent_vanishes) noexcept;

template <Scalar S>
struct FergusonInput {
    std::span<const Point<S>> points;
    std::span<const FergusonJoint<S>> joints; ///< one per inner point; closed: one per point
    bool closed = false;
    Point<S> start_tangent{}; ///< derivative of the first segment at its start (no lambda); not used if closed
    Point<S> end_tangent{};   ///< of the last segment at its end
};

/// Each span as long as there are points, at least.
template <Scalar S>
struct FergusonOutput {
    std::span<Point<S>> tangents_in;  ///< r_i'(1); at the start of an open curve its tangent
    std::span<Point<S>> tangents_out; ///< lambda_i r_i'(1)
    std::span<BezierPiece<S>> pieces;
    std::span<CyclicRow<S>> system; ///< work
};

template <Scalar S>
struct FergusonReport {
    std::size_t segments = 0;
    bool diagonally_dominant = false;             ///< |2(mu/4+...)| >= the sum of the others, in every row
    bool elimination_without_pivoting_ok = false; ///< open only
    S condition{};                                ///< of the system, a lower estimate (infinity norm); 1: no unknowns
    std::size_t weakest_knot = 0;                 ///< with the smallest pivot: the one to change if singular
    std::size_t vanishing = 0;       ///< knots with a zero tangent: direction and curvature undefined there
    S tangent_noise{};               ///< tangents up to this are taken for zero
    std::size_t first_vanishing = 0; ///< the first of them
};

/// Row of knot i without its right side. @param lambda_before  of the joint before; 1 where that is a given end tangent
template <Scalar S>
[[nodiscard]] CyclicRow<S> ferguson_row(const FergusonJoint<S>& joint, S lambda_before) noexcept;

/// The curve through the points. Two points: one Hermite segment. Closed (an extension of the article): three points at
/// least, a repeated closing point is dropped. Parameters are uniform: neighbours at distance 0 are a loop, not an
/// error. Fixed: |coordinates|, |tangents| <= 2^18. Tangents are accurate to condition * rounding. Errors:
/// too_few_points, position_out_of_range, tangent_out_of_range (NaN, infinity, out of range), lambda_not_positive (or
/// NaN), curvature_sign_invalid, lambda_or_mu_out_of_range (FergusonJoint; a mu that is NaN), parameters_invalid
/// (number of joints), storage_too_small, system_singular (report.weakest_knot), result_out_of_range. Cost:
/// solve_cyclic and 12 products per point and axis.
template <Scalar S>
[[nodiscard]] Status ferguson(const FergusonInput<S>& input, const FergusonOutput<S>& out,
                              FergusonReport<S>& report) noexcept;

// ---- what may be left to the program

/// End tangents where none are given: of the parabola through the first and last three points, whose spans are in the
/// ratio lambda; two points: the chord. (The article needs them given.)
template <Scalar S>
void estimate_end_tangents(std::span<const Point<S>> points, std::span<const FergusonJoint<S>> joints, Point<S>& start,
                           Point<S>& end) noexcept;

/// -1 at a knot that is an inflection of the polygon: it turns to opposite sides at the knots before and after, each by
/// at least 2 degrees or so, and by less than either at this one. +1 elsewhere, in particular at the ends and on
/// straight data. In space sides are compared by the inner product of the turns. What a symmetric S then gives: above.
template <Scalar S>
[[nodiscard]] int automatic_sign(std::span<const Point<S>> points, std::size_t knot, bool closed) noexcept;

/// The mu nearest to `wish` with which the row dominates by a sixteenth: |2(mu/4 + delta lambda^2 + lambda)| >= 17/16
/// (lambda^2 lambda_before + 1), (10) as corrected. Where all rows do, open or closed, the influence of a point fades
/// along the curve, and with one lambda the condition is at most 33. The weaker 2 lambda^(3/2) only keeps pivots from
/// zero: unless lambda is 1 errors may still grow from knot to knot.
template <Scalar S>
[[nodiscard]] S stable_mu(S wish, int delta, S lambda, S lambda_before) noexcept;

} // namespace splinefeed
