// SPDX-License-Identifier: MIT
// WaypointRows: a source of waypoints in order.
#pragma once

#include "host_sim/program/row_source.hpp"
#include "host_sim/program/waypoint_row.hpp"

namespace splinefeed::host {

using WaypointRows = RowSource<WaypointRow>;

} // namespace splinefeed::host
