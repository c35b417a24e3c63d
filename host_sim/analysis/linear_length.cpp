// SPDX-License-Identifier: MIT
#include "host_sim/analysis/linear_length.hpp"

#include "splinefeed/number/vector.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

LinearLength::LinearLength(const MachineSettings& machine) : axes_(machine.axes) {
    const bool linear = std::any_of(machine.axis.begin(), machine.axis.begin() + axes_,
                                    [](const AxisSettings& axis) { return !axis.rotary; });
    for (const unsigned k : indices(axes_)) {
        const bool counts = !linear || !machine.axis[k].rotary;
        is_part_ = is_part_ || !counts;
        mm_per_unit_[k] = counts ? 1.0 / (static_cast<double>(units_per_count) * machine.axis[k].steps_per_mm) : 0.0;
    }
}

double LinearLength::of(const FeedSegment& segment) const {
    double speed_sq[3] = {}; // at the begin, in the middle, at the end [mm a segment]
    for (const unsigned k : indices(axes_)) {
        const auto way = static_cast<double>(segment.end[k] - segment.start[k]);
        const auto m0 = static_cast<double>(segment.start_velocity[k]);
        const auto m1 = static_cast<double>(segment.end_velocity[k]);
        const double speeds[3] = {m0, 0.25 * (6.0 * way - m0 - m1), m1};
        for (int i = 0; i < 3; ++i) {
            const double mm = speeds[i] * mm_per_unit_[k];
            speed_sq[i] += mm * mm;
        }
    }
    return (std::sqrt(speed_sq[0]) + 4.0 * std::sqrt(speed_sq[1]) + std::sqrt(speed_sq[2])) / 6.0;
}

} // namespace splinefeed::host
