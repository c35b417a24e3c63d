// SPDX-License-Identifier: MIT
// WireGroups: groups drives by their wires and finds a timing that suits all drives of a wire.
#pragma once

#include "splinefeed/hal/modbus/link/link_address.hpp"

#include <cstddef>
#include <vector>

namespace splinefeed::hal::modbus {

/// Address and required timing of a drive; or a wire and the timing that its slowest drive requires.
struct WireUse {
    LinkAddress link;
    LinkTiming timing;
};

struct WireGroups {
    std::vector<WireUse> wires; ///< each wire once, in the order of their first drives, with the address of that drive
    std::vector<std::size_t> of_drive; ///< index of each drive's wire
};

/// @param base  lower bound of every wire's timing
[[nodiscard]] WireGroups group_by_wire(const std::vector<WireUse>& drives, const LinkTiming& base);

} // namespace splinefeed::hal::modbus
