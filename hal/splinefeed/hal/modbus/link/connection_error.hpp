// SPDX-License-Identifier: MIT
// connection_error: why a Modbus line cannot be opened, and what to do.
#pragma once

#include "splinefeed/hal/modbus/link/link_address.hpp"

#include <string>

namespace splinefeed::hal::modbus {

inline constexpr int no_such_host = -1; ///< in the place of an errno: the name has no address

/// The system's reason, and what to do: "Connection refused; check the port, ...".
/// @param error  errno of the connection, or no_such_host
[[nodiscard]] std::string connection_error(int error, const LinkAddress& address);

} // namespace splinefeed::hal::modbus
