// SPDX-License-Identifier: MIT
// WaypointRows: waypoints in order, from wherever they come.
#pragma once

#include "host_sim/program/waypoint_reader.hpp"

#include <chrono>

namespace splinefeed::host {

/// Throws InputError where one is wrong.
class WaypointRows {
public:
    using Patience = std::chrono::steady_clock::duration;

    WaypointRows() = default;
    WaypointRows(const WaypointRows&) = delete;
    WaypointRows& operator=(const WaypointRows&) = delete;
    virtual ~WaypointRows() = default;

    /// False when there are no more. May wait for the input.
    virtual bool next(WaypointRow& out) = 0;
    /// Whether next() answers at once, or will within so long, for which it waits. One that cannot tell says yes.
    virtual bool wait(Patience /*patience*/) { return true; }
    /// From any thread: next() does not wait for the input any more, and says that there are no more.
    virtual void stop() noexcept {}
};

} // namespace splinefeed::host
