// SPDX-License-Identifier: MIT
// PathSink: what waypoints or moves are pushed into: a curve, whatever its scalar is.
#pragma once

#include "host_sim/program/move_source.hpp"

#include "splinefeed/s1_curve/waypoint.hpp"

namespace splinefeed::host {

/// Numbers become those of the curve's scalar here and nowhere else. The curve has to be starved before each call but
/// has_length(), which changes nothing.
class PathSink {
public:
    /// Accepts the next waypoint. Errors: WaypointCurve::push(). @pre the curve goes through waypoints
    virtual Status push(const Waypoint<double>& waypoint, Role role) = 0;

    /// Where the first move begins. Errors: TolerancePath::start(). @pre the curve follows moves; likewise below
    virtual Status start(const PerAxis<Position>& position) = 0;
    /// Accepts the next move. Errors: TolerancePath::push().
    virtual Status push(const SourceStep& step) = 0;
    /// Whether a move has a length. Errors: BlendedPath::length_of(). @param from  where it begins
    [[nodiscard]] virtual Result<bool> has_length(const PerAxis<Position>& from, const SourceStep& step) const = 0;

    /// Nothing comes any more. Errors: those of the curve.
    virtual Status finish() = 0;

protected:
    PathSink() = default;
    PathSink(const PathSink&) = default;
    PathSink& operator=(const PathSink&) = default;
    ~PathSink() = default;
};

} // namespace splinefeed::host
