// SPDX-License-Identifier: MIT
#include "splinefeed/s1_curve/curve_segment.hpp"

#include "splinefeed/number/exponent.hpp"
#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

namespace {

constexpr double shortest_line_mm = 0.01; // a shorter one is not passed faster

} // namespace

template <Scalar S>
void CurveSegment<S>::assign(const PerAxis<PerDegree<S>>& offsets) noexcept {
    S largest{};
    const auto axes_u = static_cast<unsigned>(axes);
    const auto points = static_cast<unsigned>(degree) + 1U;
    for (unsigned k = 0; k < axes_u; ++k) {
        for (unsigned i = 0; i < points; ++i) {
            largest = larger(largest, absolute(offsets[k][i]));
        }
    }
    const int up = largest > S{} ? 15 - exponent_of(largest) : 0;
    unit_log2 = chord_unit_log2 - up;
    for (unsigned k = 0; k < axes_u; ++k) {
        for (unsigned i = 0; i < points; ++i) {
            control[k][i] = scale2(offsets[k][i], up);
        }
    }
}

template <Scalar S>
void CurveSegment<S>::straighten() noexcept {
    if (degree < 2) {
        return;
    }
    const auto n = static_cast<unsigned>(degree);
    PerAxis<S> direction = leg(control, 0, n, axes);
    const S length = norm(direction, axes);
    if (!(scale2(length, unit_log2) > literal<S>(shortest_line_mm))) {
        return;
    }
    divide(direction, length, axes);
    S before{};
    for (unsigned i = 1; i < n; ++i) {
        PerAxis<S> beside = leg(control, 0, i, axes);
        const S along = dot(beside, direction, axes);
        subtract(beside, along, direction, axes);
        if (along < before || along > length || largest_size(beside, axes) > negligible_units<S>) {
            return;
        }
        before = along;
    }
    for (const unsigned k : indices(axes)) {
        control[k][1] = control[k][n];
    }
    degree = 1;
}

#define SPLINEFEED_INSTANTIATE(S) template struct CurveSegment<S>;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
