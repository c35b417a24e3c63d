// SPDX-License-Identifier: MIT
#include "host_sim/analysis/limit_kind.hpp"

#include <array>

namespace splinefeed::host {

std::string limit_name(BindingLimit limit, std::span<const std::string> axes) {
    constexpr std::array names{"no limit", "programmed feed",   "machine's feed", "velocity of ", "acceleration of ",
                               "jerk of ", "centripetal limit", "chord error",    "override",     "hold",
                               "dwell"};
    const bool of_axis =
        limit.kind == LimitKind::velocity || limit.kind == LimitKind::acceleration || limit.kind == LimitKind::jerk;
    return names[static_cast<std::size_t>(limit.kind)] + (of_axis ? axes[limit.axis] : std::string());
}

} // namespace splinefeed::host
