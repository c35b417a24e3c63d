// SPDX-License-Identifier: MIT
#include "host_sim/drive/pvt_axis.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

using hal::modbus::PvtFault;

namespace {

constexpr double slack = 1.0 + 1e-6; // of limits: rounding of positions to the map's units

bool beyond(double value, double largest) {
    return largest > 0.0 && std::fabs(value) > slack * largest;
}

} // namespace

int PvtReference::fastest() const noexcept {
    const auto slower = [](double a, double b) {
        return std::fabs(a) < std::fabs(b);
    };
    return static_cast<int>(std::ranges::max_element(counts_s, slower) - counts_s.begin());
}

bool PvtReference::rests() const noexcept {
    return std::ranges::all_of(counts_s, [](double speed) { return speed == 0.0; });
}

PvtFault fault_of(const PvtAxisParameters& axis, const PvtAxisStep& step, double window_counts) noexcept {
    if (window_counts > 0.0 && std::fabs(step.following_error_counts) > window_counts) {
        return PvtFault::following_error;
    }
    const bool limited = beyond(step.counts_s, axis.largest_counts_s) || beyond(step.counts_s2, axis.largest_counts_s2);
    return step.on_ring && limited ? PvtFault::limit : PvtFault::none;
}

} // namespace splinefeed::host
