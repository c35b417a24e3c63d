// SPDX-License-Identifier: MIT
// WireGroups: which drives share a wire, and the timing that suits all of them.
#pragma once

#include "splinefeed/hal/modbus/link/link_address.hpp"

#include <cstddef>
#include <vector>

namespace splinefeed::hal::modbus {

/// Where a drive hangs and what it asks of its wire; or a wire and what the slowest of its drives asks of it.
struct WireUse {
    LinkAddress link;
    LinkTiming timing;
};

struct WireGroups {
    std::vector<WireUse> wires;        ///< each once, in the order of their first drives, with the address of that one
    std::vector<std::size_t> of_drive; ///< which of the wires a drive hangs on
};

/// @param base  what suits the caller: no wire is faster
[[nodiscard]] WireGroups group_by_wire(const std::vector<WireUse>& drives, const LinkTiming& base);

} // namespace splinefeed::hal::modbus
