// SPDX-License-Identifier: MIT
//
// Halving rounds the control points of a piece. From one cell to the next, dr/dw of the axis jumps by at most the
// degree n times the error of two control points. The error of r'' is 24 roundings of a cubic; twice as many are
// allowed for. Relative to |dr/dw| the jump is n_k. |dr/dw| itself, or its slope, has an error of at most the sum of
// |q'_k| n_k, and |q'_k| of that acts on the axis.
//
// In float the control points of a piece count from its start. Let h_k be the sum of the steps between the segment's
// control points on axis k. After j halvings the control points are below h_k 2^-j. A halving makes a joint, and on
// each side of it at most four roundings of half an ulp: averages, the new start, and the correction that makes the
// piece end where the next one begins. Together that is n 2^-22 h_k 2^-j of dr/dw. After m - j more halvings 2^(j-m) of
// it remains, and the same part of |dr/dw|. So each of the m halvings, and the rounding of the segment itself, adds the
// same amount to n_k. Of the error of r'' a quarter remains after each halving: the sum is below twice the last one.
//
// In the other scalars a control point has an error of half a unit, whatever its piece.
#include "splinefeed/s2_arc_length/control_rounding.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

namespace {

// The rounding of two control points, and of r''. In Fixed and double what the bound is asked for on top of it, too.
template <Scalar S>
constexpr S two_roundings = literal<S>(2.4e-10);
template <Scalar S>
constexpr S bend_rounding = literal<S>(1e-8);

// h_k 2^-level
template <Floating S>
S reach(const CurveSegment<S>& segment, unsigned axis, int level) noexcept {
    const PerDegree<S>& control = segment.control[axis];
    S sum = absolute(control[0]);
    for (unsigned i = 1; i <= static_cast<unsigned>(segment.degree); ++i) {
        sum += absolute(control[i] - control[i - 1]);
    }
    return scale2(sum, -level);
}

} // namespace

template <Scalar S>
ControlRounding<S> ControlRounding<S>::of(const CurveSegment<S>& segment, int level, S slowest,
                                          const PerAxis<Ratio<S>>& tangent_max) noexcept {
    ControlRounding out;
    S jump_along{};
    S bend_along{};
    for (const unsigned k : indices(segment.axes)) {
        S two = two_roundings<S>;
        S bend = bend_rounding<S>;
        if constexpr (std::same_as<S, float>) {
            const float rounding = reach(segment, k, level) * 0x1p-22F;
            two = from_integer<S>(level + 1) * rounding;
            bend = from_integer<S>(2 * 24) * rounding;
        }
        if (k == 0 || std::same_as<S, float>) {
            out.jump[k] = from_integer<S>(segment.degree) * two / slowest;
            out.bend[k] = bend / slowest;
        } else { // the same for all axes
            out.jump[k] = out.jump[0];
            out.bend[k] = out.bend[0];
        }
        jump_along += out.jump[k] * tangent_max[k];
        bend_along += out.bend[k] * tangent_max[k];
    }
    if (jump_along == S{} && bend_along == S{}) {
        return out; // in Fixed, of a long piece
    }
    for (const unsigned k : indices(segment.axes)) {
        out.jump[k] = out.jump[k] + jump_along * tangent_max[k];
        out.bend[k] = out.bend[k] + bend_along * tangent_max[k];
    }
    return out;
}

template <Scalar S>
S ControlRounding<S>::steady_speed(const PerAxis<S>& jump_mm_s, int axes) const noexcept {
    S speed = largest<S>();
    for (const unsigned k : indices(axes)) {
        speed = smaller(speed, quotient_or_max(jump_mm_s[k], jump[k]));
    }
    return speed;
}

#define SPLINEFEED_INSTANTIATE(S) template struct ControlRounding<S>;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
