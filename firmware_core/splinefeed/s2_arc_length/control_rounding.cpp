// SPDX-License-Identifier: MIT
//
// Halving rounds the control points of a piece. From one cell to the next dr/dw of the axis jumps by at most the degree
// n times what two of them are off by, and r'' is off by 24 roundings of a cubic, of which twice as many are allowed
// for. Relative to |dr/dw| that is n_k; and |dr/dw| itself, or its slope, is off by the sum of |q'_k| n_k at most, of
// which the axis feels the part |q'_k|.
//
// In float the control points of a piece count from its start. After j halvings those of axis k are below h_k 2^-j, h_k
// being the sum of the steps between the segment's control points. A halving rounds them by at most four halves of an
// ulp on either side of the joint that it makes: averages, counting from the new start, and the share of what leads to
// the end. That makes n 2^-22 h_k 2^-j of dr/dw; what is left of it after m - j more halvings is 2^(j-m), as of
// |dr/dw|: each of the m halvings and the segment's own rounding add the same to n_k. Of r'' four times less is left
// with each halving: their sum is below twice the last.
//
// In the other scalars a control point is off by half an ulp of one, whatever its piece.
#include "splinefeed/s2_arc_length/control_rounding.hpp"

namespace splinefeed {

namespace {

// The rounding of two control points, and of r''. In Fixed and double what the bound is asked for on top of it, too.
template <Scalar S>
constexpr S two_roundings = literal<S>(2.4e-10);
template <Scalar S>
constexpr S bend_rounding = literal<S>(1e-8);

// h_k 2^-level
float reach(const CurveSegment<float>& segment, unsigned axis, int level) noexcept {
    const PerDegree<float>& control = segment.control[axis];
    float sum = absolute(control[0]);
    for (unsigned i = 1; i <= static_cast<unsigned>(segment.degree); ++i) {
        sum += absolute(control[i] - control[i - 1]);
    }
    return scale2(sum, -level);
}

} // namespace

template <Scalar S>
ControlRounding<S> ControlRounding<S>::of(const CurveSegment<S>& segment, int level, S slowest,
                                          const PerAxis<S>& tangent_max) noexcept {
    ControlRounding out;
    S jump_along{};
    S bend_along{};
    for (unsigned k = 0; k < static_cast<unsigned>(segment.axes); ++k) {
        S two = two_roundings<S>;
        S bend = bend_rounding<S>;
        if constexpr (std::same_as<S, float>) {
            const float rounding = reach(segment, k, level) * 0x1p-22F;
            two = from_integer<S>(level + 1) * rounding;
            bend = from_integer<S>(2 * 24) * rounding;
        }
        out.jump[k] = from_integer<S>(segment.degree) * two / slowest;
        out.bend[k] = bend / slowest;
        jump_along += tangent_max[k] * out.jump[k];
        bend_along += tangent_max[k] * out.bend[k];
    }
    for (unsigned k = 0; k < static_cast<unsigned>(segment.axes); ++k) {
        out.jump[k] = out.jump[k] + tangent_max[k] * jump_along;
        out.bend[k] = out.bend[k] + tangent_max[k] * bend_along;
    }
    return out;
}

template <Scalar S>
S ControlRounding<S>::steady_speed(const PerAxis<S>& jump_mm_s, int axes) const noexcept {
    S speed = largest<S>();
    for (unsigned k = 0; k < static_cast<unsigned>(axes); ++k) {
        speed = smaller(speed, quotient_or_max(jump_mm_s[k], jump[k]));
    }
    return speed;
}

template struct ControlRounding<double>;
template struct ControlRounding<float>;
template struct ControlRounding<Fixed>;

} // namespace splinefeed
