// SPDX-License-Identifier: MIT
//
// A cell gives 2 L q'' as a parabola with the Bezier points c0, c1, c2, and `error_bound`, the largest error of that
// parabola. q'' stays between its Bezier points, c / (2 L); q''' is linear between (c1 - c0) / L^2 and (c2 - c1) / L^2.
// The error of q''' is taken as 10.4 / L times that of q'': an error x (1-x) (1-2x) has the slope 1 at the ends and
// reaches 0.096.
#include "splinefeed/s3_feed_plan/jerk_filtered/path_derivative_bounds.hpp"

namespace splinefeed {

namespace {

constexpr double ripple = 10.4;

// x / L, x >= 0, at most 2^steepest_log2; sets the flag if it is more.
template <Scalar S>
S per_length(S x, S length, bool& beyond) noexcept {
    const S most = scale2(from_integer<S>(1), PathDerivativeBounds<S>::steepest_log2);
    const S quotient = quotient_or_max(x, length);
    beyond = beyond || !(quotient < most);
    return smaller(quotient, most);
}

} // namespace

template <Scalar S>
PathDerivativeBounds<S> PathDerivativeBounds<S>::of(const Cell<S>& cell, S cap_sq, S programmed_sq) noexcept {
    PathDerivativeBounds out;
    out.cap_sq = cap_sq;
    out.programmed_sq = programmed_sq;
    const S length = cell.length_mm;
    for (const unsigned k : indices(cell.axes)) {
        const AxisShape<S>& shape = cell.shape[k];
        const std::array<S, 3> c{lengthened<S>(shape.bend[0]), lengthened<S>(shape.bend[1]),
                                 lengthened<S>(shape.bend[2])};
        const S error = lengthened<S>(shape.error_bound);
        const S highest = larger(c[0], larger(c[1], c[2])) + error;
        const S lowest = smaller(c[0], smaller(c[1], c[2])) - error;
        const S rest = literal<S>(ripple / 2.0) * lengthened<S>(shape.shape_error());
        const S rise = larger(c[1] - c[0], c[2] - c[1]) + rest;
        const S fall = larger(c[0] - c[1], c[1] - c[2]) + rest;
        const auto twice_per_length = [&](S x) {
            return per_length(per_length(larger(x, S{}), length, out.beyond), length, out.beyond);
        };
        const S up = twice_per_length(rise);
        const S downwards = twice_per_length(fall);
        AxisDemand<S>& at = out.axis[k];
        at.first = lengthened<S>(cell.tangent_max[k]);
        at.second = half(per_length(larger(highest, -lowest), length, out.beyond));
        at.third_with = larger(highest > S{} ? up : S{}, lowest < S{} ? downwards : S{});
        at.third_against = larger(highest > S{} ? downwards : S{}, lowest < S{} ? up : S{});
    }
    return out;
}

template <Scalar S>
void PathDerivativeBounds<S>::join(const PathDerivativeBounds& other, int axes) noexcept {
    for (const unsigned k : indices(axes)) {
        AxisDemand<S>& at = axis[k];
        const AxisDemand<S>& from = other.axis[k];
        at.first = larger(at.first, from.first);
        at.second = larger(at.second, from.second);
        at.third_with = larger(at.third_with, from.third_with);
        at.third_against = larger(at.third_against, from.third_against);
    }
    cap_sq = smaller(cap_sq, other.cap_sq);
    programmed_sq = smaller(programmed_sq, other.programmed_sq);
    beyond = beyond || other.beyond;
}

template struct PathDerivativeBounds<double>;
template struct PathDerivativeBounds<float>;
template struct PathDerivativeBounds<Fixed>;

} // namespace splinefeed
