// SPDX-License-Identifier: MIT
#include "host_sim/machine/machine_fault.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace splinefeed::host {

const char* fault_name(FaultKind kind) noexcept {
    switch (kind) {
    case FaultKind::chain: return "chain";
    case FaultKind::duration: return "duration";
    case FaultKind::velocity: return "velocity";
    case FaultKind::acceleration: return "acceleration";
    case FaultKind::braking: return "braking";
    case FaultKind::jerk: return "jerk";
    case FaultKind::feed: return "feed";
    case FaultKind::travel_end: return "travel end";
    case FaultKind::travel: return "travel";
    case FaultKind::underrun: return "underrun";
    }
    return "unknown";
}

std::string describe(const Fault& fault, const std::string& place) {
    const std::string where = fault.axis.empty() ? "path" : "axis " + fault.axis;
    const std::string_view mm = fault.unit;
    const std::string unit =
        fault.rotary ? fmt::format("degrees{}", mm.substr(std::min<std::size_t>(2, mm.size()))) : std::string(mm);
    std::string what;
    switch (fault.kind) {
    case FaultKind::chain:
        what = fmt::format("{}: a segment does not start where the last one ended: {} is off by {:.6g} {}", where,
                           mm == "mm" ? "position" : "velocity", fault.value, unit);
        break;
    case FaultKind::duration: what = "a segment lasts no time"; break;
    case FaultKind::velocity:
    case FaultKind::acceleration:
    case FaultKind::braking:
    case FaultKind::jerk:
    case FaultKind::feed:
        what = fmt::format("{}: {} {:.9g} {} is above the limit of {:.9g} {}", where, fault_name(fault.kind),
                           fault.value, unit, fault.limit, unit);
        break;
    case FaultKind::travel:
        what = fmt::format("{}: position {:.9g} {} is {} the travel limit of {:.9g} {}", where, fault.value, unit,
                           fault.value < fault.limit ? "below" : "above", fault.limit, unit);
        break;
    case FaultKind::travel_end:
        what = fmt::format("{}: velocity {:.9g} {} is above the limit of {:.9g} {} near the end of the travel", where,
                           fault.value, unit, fault.limit, unit);
        break;
    case FaultKind::underrun:
        what = fmt::format("the segments ran out while the machine moved at {:.6g} mm/s", fault.value);
        break;
    }
    return fmt::format("{}, at t = {:.6f} s near {}", what, fault.time_s,
                       place.empty() ? fmt::format("waypoint {}", fault.waypoint) : place);
}

} // namespace splinefeed::host
