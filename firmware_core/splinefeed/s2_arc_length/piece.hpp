// SPDX-License-Identifier: MIT
// Piece: a part of a Bezier segment that may become a cell, and its measures at w = 0, 1/2 and 1.
#pragma once

#include "splinefeed/number/division_by.hpp"
#include "splinefeed/s1_curve/curve_segment.hpp"
#include "splinefeed/s2_arc_length/cell.hpp"

namespace splinefeed {

/// Whether the control points of a piece count from the start of the piece. In float the control points of a segment
/// are known to 2^-24 of its length, which is a large part of a short piece. Counted from the start of the piece they
/// are known to 2^-24 of the piece.
template <Scalar S>
inline constexpr bool counts_from_own_start = std::same_as<S, float>;

/// A part of a segment, in the segment's units.
template <Scalar S>
struct Piece {
    struct Nowhere {};

    PerAxis<PerDegree<S>> control{}; ///< offsets from the segment's origin, or from `start`
    [[no_unique_address]] std::conditional_t<counts_from_own_start<S>, PerAxis<Position>, Nowhere> start{};
    int level = 0;         ///< number of halvings of the segment
    bool at_start = false; ///< it begins at the start of its segment
    bool at_end = false;

    /// Whether no control point is farther than `nothing` from the first one, in each axis.
    [[nodiscard]] bool vanishes(int axes, int degree, S nothing) const noexcept {
        for (const unsigned k : indices(axes)) {
            for (unsigned i = 1; i <= static_cast<unsigned>(degree); ++i) {
                if (absolute(control[k][i] - control[k][0]) > nothing) {
                    return false;
                }
            }
        }
        return true;
    }
    /// The control points of its halves, by de Casteljau at 1/2. Either may be this piece.
    void halve(int axes, int degree, PerAxis<PerDegree<S>>& left, PerAxis<PerDegree<S>>& right) const noexcept;
    /// What the control points of an axis count from.
    [[nodiscard]] Position origin(const CurveSegment<S>& segment, unsigned axis) const noexcept {
        if constexpr (counts_from_own_start<S>) {
            return start[axis];
        } else {
            return segment.origin[axis];
        }
    }
    /// Moves the start of an axis to the first control point, which the others count from then.
    void begin_at_start(unsigned axis, int degree, int unit_log2) noexcept requires counts_from_own_start<S> {
        const S first = control[axis][0];
        start[axis] = displaced(start[axis], first, unit_log2);
        for (unsigned i = 0; i <= static_cast<unsigned>(degree); ++i) {
            control[axis][i] = control[axis][i] - first;
        }
    }
    /// Turns and stretches the piece by its rounding, so that it ends where the next one begins.
    void lead_to(Position end, unsigned axis, int degree, int unit_log2) noexcept requires counts_from_own_start<S> {
        const S rest = distance<S>(start[axis], end, unit_log2) - control[axis][static_cast<unsigned>(degree)];
        const S share = rest / from_integer<S>(degree);
        for (int i = 1; i <= degree; ++i) {
            control[axis][static_cast<unsigned>(i)] += from_integer<S>(i) * share;
        }
    }
};

/// Derivatives, length and inverse of a piece. The members are computed in this order, each from earlier ones, in units
/// of 2^unit_log2 times that of the segment: in Fixed one in which they fit in a word. Derivation: piece.cpp. Cost:
/// three roots, 4 + 3 divisors and 6 divisions per axis, a dozen more.
template <Scalar S>
struct PieceMeasure {
    using R = Ratio<S>;

    static constexpr int points = 3;         // w = 0, 1/2, 1
    static constexpr int sharpest = 1 << 24; ///< curvatures above this count as infinite [1/mm]
    int unit_log2 = 0;
    R noise{};                               ///< what rounding may do to `second`
    std::array<PerAxis<R>, points> first{};  ///< dr/dw; after measure_length: dq/ds
    std::array<PerAxis<R>, points> second{}; ///< d2r/dw2; after measure_curvature: length d2q/ds2
    std::array<R, points> sigma{};           ///< |dr/dw|
    std::array<R, points> slope{};           ///< dsigma/dw
    R slowest{};                             ///< smallest sigma
    R fastest{};                             ///< largest sigma
    R length{};
    R length_error{}; ///< 8 times the difference to a rule two orders lower
    S length_mm{};
    std::array<R, 6> inverse{}; ///< w = sum inverse[i] x^(i+1), x = fraction of the length
    R shape_error{};            ///< 2^12 times the relative error of the inverse, estimated from the shape of sigma
    R middle{};                 ///< x at w = 1/2
    R middle_slope{};           ///< dw/dx of the inverse at `middle`; times sigma/length it should be 1

    /// Chooses the unit, and computes dr/dw, d2r/dw2 and sigma.
    void differentiate(const Piece<S>& piece, int degree, int axes) noexcept;
    /// @pre slowest > 0
    void measure_length(int axes, int segment_unit_log2) noexcept;
    void invert() noexcept;
    void measure_curvature(int axes, int segment_unit_log2) noexcept;
    /// How far the slope of the inverse is off in the middle, times the length.
    [[nodiscard]] R slope_error() const noexcept { return absolute(middle_slope * sigma[1] - length); }
    /// Largest length |d2q/ds2| of an axis at the three points.
    [[nodiscard]] R sharpest_bend(int axes) const noexcept;
    /// The shape of one axis, without its error bound.
    [[nodiscard]] AxisShape<S> shape(unsigned axis) const noexcept;
    /// In the unit of the segment.
    [[nodiscard]] S in_segment(R x) const noexcept { return lengthened<S>(x, unit_log2); }
    /// x / length, for x in any unit.
    [[nodiscard]] R by_length(R x) const noexcept { return x / by_length_; }
    /// Largest magnitude over the piece of a function that is known at the three points.
    [[nodiscard]] static R bound(const std::array<PerAxis<R>, points>& f, unsigned axis) noexcept;

private:
    void choose_unit(const Piece<S>& piece, unsigned degree, int axes) noexcept;

    int fine_log2_ = 0; // the differences of control points are in units of 2^(unit_log2 - fine_log2_)
    std::array<DivisionBy<R>, points> by_sigma_{};
    DivisionBy<R> by_length_{};
    DivisionBy<R> by_hump_{};         // x (1 - x) at the middle
    std::array<R, points> stretch_{}; // length / sigma
};

} // namespace splinefeed
