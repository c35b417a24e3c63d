// SPDX-License-Identifier: MIT
#include "splinefeed/s1_curve/curve_segment.hpp"

#include "splinefeed/number/exponent.hpp"
#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

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

#define SPLINEFEED_INSTANTIATE(S) template struct CurveSegment<S>;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
