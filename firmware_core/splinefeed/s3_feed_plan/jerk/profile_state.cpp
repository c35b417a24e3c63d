// SPDX-License-Identifier: MIT
//
// For a parabola, b and db/ds by de Casteljau's construction; for a cubic s(t), b = (ds/dt)^2 and db/ds = 2 d2s/dt2.
#include "splinefeed/s3_feed_plan/jerk/profile_state.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

template <Scalar X>
SpeedState state_on(const ProfileSegment<X>& profile_segment, double cell_length_mm, double fraction,
                    double time_share) noexcept {
    if (profile_segment.shape == SpeedShape::parabola) {
        const double b0 = to_double(profile_segment.entry_sq);
        const double rise = to_double(profile_segment.middle_sq) - b0;
        const double fall = to_double(profile_segment.exit_sq) - to_double(profile_segment.middle_sq);
        const double rest = 1.0 - fraction;
        return {b0 + rise * fraction * (1.0 + rest) + fall * fraction * fraction,
                2.0 * (rise * rest + fall * fraction) / cell_length_mm};
    }
    const double per_s = 1e3 / to_double(profile_segment.duration_ms);
    const double linear = to_double(profile_segment.linear);
    const double quadratic = to_double(profile_segment.quadratic);
    const double cubic = 1.0 - linear - quadratic;
    const double y = time_share;
    const double speed = cell_length_mm * to_double(profile_segment.stretch.length()) * per_s;
    const double v = speed * (linear + y * (2.0 * quadratic + 3.0 * cubic * y));
    return {v * v, 2.0 * speed * per_s * (2.0 * quadratic + 6.0 * cubic * y)};
}

#define SPLINEFEED_INSTANTIATE(X)                                                                                      \
    template SpeedState state_on(const ProfileSegment<X>&, double, double, double) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
