// SPDX-License-Identifier: MIT
#include "splinefeed/s1_curve/polyline.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

template <Scalar S>
Pull Polyline<S>::next(CurveSegment<S>& out) noexcept {
    for (;;) {
        const std::uint64_t i = next_;
        if (const Pull ready = this->ready(i); ready != Pull::item) {
            return ready;
        }
        next_ = this->oldest_ = i + 1;
        if (this->travelled(i)) {
            this->describe_segment(i, 1, out);
            // The arc-length stage stops only where the direction jumps, so a break without a turn costs nothing. The
            // flag is set only for forced corners of the user.
            out.stop_at_end = this->knot(i + 1).corner == Corner::forced;
            PerAxis<PerDegree<S>> offsets{};
            for (const unsigned k : indices(this->axes())) {
                offsets[k][1] = this->knot(i).chord[k];
            }
            out.assign(offsets);
            return Pull::item;
        }
    }
}

SPLINEFEED_INSTANTIATE_CLASS(Polyline)

} // namespace splinefeed
