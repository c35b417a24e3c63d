// SPDX-License-Identifier: MIT
//
// Halving rounds the control points of a piece. Those of axis k, at most m_k, have an error e_k: half an ulp of m_k in
// float, half an ulp of one in the other scalars. From one cell to the next, dr/dw of the axis jumps by at most 2 e_k
// times the degree. The error of r'' is 24 roundings of a cubic; twice as many are allowed for. Relative to |dr/dw| the
// jump is n_k. |dr/dw| itself, or its slope, has an error of at most the sum of |q'_k| n_k, and |q'_k| of that acts on
// the axis.
#include "splinefeed/s2_arc_length/control_rounding.hpp"

namespace splinefeed {

namespace {

// 2 e_k
template <Scalar S>
S two_roundings(S /*largest*/) noexcept {
    return literal<S>(2.4e-10);
}
template <>
float two_roundings<float>(float largest) noexcept {
    return largest * 0x1p-23F;
}

// Rounding of r''. In the other scalars it includes the extra reserve of the bound.
template <Scalar S>
S bend_rounding(S two) noexcept {
    return std::same_as<S, float> ? from_integer<S>(24) * two : literal<S>(1e-8);
}

} // namespace

template <Scalar S>
ControlRounding<S> ControlRounding<S>::of(const CurveSegment<S>& segment, S slowest,
                                          const PerAxis<S>& tangent_max) noexcept {
    ControlRounding out;
    S jump_along{};
    S bend_along{};
    for (unsigned k = 0; k < static_cast<unsigned>(segment.axes); ++k) {
        if (std::same_as<S, float> || k == 0) { // the same for all axes in the other scalars
            S most{};
            for (unsigned i = 0; i <= static_cast<unsigned>(segment.degree); ++i) {
                most = larger(most, absolute(segment.control[k][i]));
            }
            const S two = two_roundings<S>(most);
            out.jump[k] = from_integer<S>(segment.degree) * two / slowest;
            out.bend[k] = bend_rounding<S>(two) / slowest;
        } else {
            out.jump[k] = out.jump[0];
            out.bend[k] = out.bend[0];
        }
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
