// SPDX-License-Identifier: MIT
// The composite Ferguson curve: cubic Hermite segments, joined at every knot with a length ratio lambda, a tension mu
// and a sign of the curvature delta.
//
// Karpenko & Kleshchev, "Influence of the sign of curvature on parametric spline curves". The conditions at joint i are
//     r_{i+1}''(0) = delta_i lambda_i^2 r_i''(1) + mu_i r_i'(1),   r_{i+1}'(0) = lambda_i r_i'(1).
// With the incoming tangent t_i = r_i'(1) they are row i of a tridiagonal system, (7) and (9):
//     delta_i lambda_i^2 lambda_{i-1} t_{i-1} + 2 (mu_i/4 + delta_i lambda_i^2 + lambda_i) t_i + t_{i+1}
//         = 3 (r_{i+1} - (1 - delta_i lambda_i^2) r_i - delta_i lambda_i^2 r_{i-1}).
// Errors in print that are not followed:
// - (9) has delta lambda^2 below the diagonal: the segment before leaves its knot with lambda_{i-1} t_{i-1};
// - (7) puts the diagonal coefficient on r_2'(0) = lambda t_i; it belongs to r_1'(1) = t_i;
// - (10), the bound of dominance, has lambda^2 + 1 instead of |delta| lambda_i^2 lambda_{i-1} + 1, and joins two
//   disjoint half-lines of mu by "and". It is also not a condition of solvability: that is judged on the system itself;
// - "class C2" holds only for delta = lambda = 1, mu = 0: see FergusonClass.
//
// Do not use delta = -1, except in rare cases. It reverses the curvature vector at the knot (only |kappa| is
// continuous). The right side becomes a second difference. The tangent in the centre of a symmetric S is exactly zero
// (a stop), and on straight data the curve may run backwards. With mu = 0 the system is singular for every odd number
// of equal joints. A true inflection needs no sign: with delta = +1 it lies inside a segment. Loops come from uniform
// parameters on uneven chords; mu removes them, delta does not.
#pragma once

#include "splinefeed/splines/cyclic_system.hpp"

namespace splinefeed {

template <Scalar S>
struct FergusonJoint {
    S lambda = literal<S>(1); ///< |r_{i+1}'(0)| / |r_i'(1)|: 2^-4 to 2^4 in Fixed, otherwise 2^-20 to 2^20
    S mu{};                   ///< tension; |mu| <= 2^16 in Fixed, otherwise 2^60
    int delta = 1;            ///< +1 or -1
};

/// Continuity that the conditions of a joint give if its tangent is not zero. It follows from the formula and is not
/// measured: special data can be smoother.
enum class FergusonClass : std::uint8_t {
    c2,           ///< delta = lambda = 1, mu = 0
    c1_g2,        ///< delta = lambda = 1
    g2,           ///< delta = 1
    c1_abs_kappa, ///< delta = -1, lambda = 1: the modulus of curvature is continuous, its vector is reversed
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
    Point<S> end_tangent{};   ///< derivative of the last segment at its end
};

/// Each span has at least as many entries as there are points.
template <Scalar S>
struct FergusonOutput {
    std::span<Point<S>> tangents_in;  ///< r_i'(1); at the start of an open curve its start tangent
    std::span<Point<S>> tangents_out; ///< lambda_i r_i'(1)
    std::span<BezierPiece<S>> pieces;
    std::span<CyclicRow<S>> system; ///< working memory
};

template <Scalar S>
struct FergusonReport {
    std::size_t segments = 0;
    bool diagonally_dominant = false;             ///< |2(mu/4+...)| >= the sum of the others, in every row
    bool elimination_without_pivoting_ok = false; ///< only for open curves
    S condition{};                                ///< of the system, a lower estimate (infinity norm); 1: no unknowns
    std::size_t weakest_knot = 0;                 ///< the knot with the smallest pivot: change this one if the system
                                                  ///< is singular
    std::size_t vanishing = 0;       ///< knots with a zero tangent: direction and curvature undefined there
    S tangent_noise{};               ///< tangents up to this length count as zero
    std::size_t first_vanishing = 0; ///< the first of them
};

/// Row of knot i without its right side. @param lambda_before  lambda of the joint before; 1 if that is a given end
/// tangent
template <Scalar S>
[[nodiscard]] CyclicRow<S> ferguson_row(const FergusonJoint<S>& joint, S lambda_before) noexcept;

/// The curve through the points. Two points: one Hermite segment. Closed (an extension of the article): at least three
/// points; a repeated closing point is dropped. Parameters are uniform: neighbours at distance 0 give a loop, not an
/// error. Fixed: |coordinates|, |tangents| <= 2^18. Error of the tangents: condition * rounding. Errors:
/// too_few_points, position_out_of_range, tangent_out_of_range (NaN, infinity, out of range), lambda_not_positive (or
/// NaN), curvature_sign_invalid, lambda_or_mu_out_of_range (FergusonJoint; a mu that is NaN), parameters_invalid
/// (number of joints), storage_too_small, system_singular (report.weakest_knot), result_out_of_range. Cost:
/// solve_cyclic and 12 products per point and axis.
template <Scalar S>
[[nodiscard]] Status ferguson(const FergusonInput<S>& input, const FergusonOutput<S>& out,
                              FergusonReport<S>& report) noexcept;

// ---- values that the program can choose

/// Estimates end tangents if none are given: those of the parabola through the first and last three points, whose spans
/// are in the ratio lambda; for two points the chord. (The article requires given tangents.)
template <Scalar S>
void estimate_end_tangents(std::span<const Point<S>> points, std::span<const FergusonJoint<S>> joints, Point<S>& start,
                           Point<S>& end) noexcept;

/// -1 at a knot that is an inflection of the polygon. The polygon turns to opposite sides at the knots before and after
/// it, each by at least about 2 degrees, and by less than either at this knot. +1 elsewhere, in particular at the ends
/// and on straight data. In space, sides are compared by the inner product of the turns. For the effect on a symmetric
/// S see above.
template <Scalar S>
[[nodiscard]] int automatic_sign(std::span<const Point<S>> points, std::size_t knot, bool closed) noexcept;

/// The mu nearest to `wish` that makes the row dominant by a sixteenth: |2(mu/4 + delta lambda^2 + lambda)| >= 17/16
/// (lambda^2 lambda_before + 1), (10) as corrected. If all rows are dominant, open or closed, the influence of a point
/// decays along the curve, and with one lambda the condition is at most 33. The weaker bound 2 lambda^(3/2) only keeps
/// pivots from zero: unless lambda is 1, errors may still grow from knot to knot.
template <Scalar S>
[[nodiscard]] S stable_mu(S wish, int delta, S lambda, S lambda_before) noexcept;

} // namespace splinefeed
