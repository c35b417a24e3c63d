// SPDX-License-Identifier: MIT
// drive_sentence: a failure of a port to drives as one line for the user: which drive, what is wrong with it, and the
// option that helps.
#pragma once

#include "host_sim/config/drive_table.hpp"

#include "splinefeed/hal/port_failure.hpp"

#include <string>

namespace splinefeed::host {

/// @param table  the drives of the port, in the same order
[[nodiscard]] std::string drive_sentence(const DriveTable& table, const hal::PortFailure& failure);

} // namespace splinefeed::host
