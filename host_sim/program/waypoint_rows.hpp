// SPDX-License-Identifier: MIT
// WaypointRows: a source of waypoints in order.
#pragma once

#include "host_sim/program/waypoint_reader.hpp"

#include <chrono>

namespace splinefeed::host {

/// Throws InputError for a wrong row.
class WaypointRows {
public:
    using Patience = std::chrono::steady_clock::duration;

    WaypointRows() = default;
    WaypointRows(const WaypointRows&) = delete;
    WaypointRows& operator=(const WaypointRows&) = delete;
    virtual ~WaypointRows() = default;

    /// Reads the next row; false if there are no more. May wait for the input.
    virtual bool next(WaypointRow& out) = 0;
    /// Whether next() would return without waiting; waits for that up to the given time. A source that cannot tell
    /// returns true.
    virtual bool wait(Patience /*patience*/) { return true; }
    /// For any thread: from now on next() does not wait for the input, and returns false.
    virtual void stop() noexcept {}
};

} // namespace splinefeed::host
