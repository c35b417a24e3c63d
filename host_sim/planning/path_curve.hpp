// SPDX-License-Identifier: MIT
// PathCurve: the curve of an input in the scalar of its plan.
#pragma once

#include "host_sim/curve/bezier_source.hpp"
#include "host_sim/curve/streamed_curve.hpp"
#include "host_sim/program/path_input.hpp"

#include "splinefeed/s1_curve/smoothed_curve.hpp"

#include <optional>
#include <variant>

namespace splinefeed::host {

/// One of two: a curve that is made while its waypoints come, or segments that came whole. Both may be smoothed.
template <Scalar S>
class PathCurve {
public:
    /// Throws UsageError if an end tangent does not fit the axes, or the method cannot be told what was chosen.
    /// `input` must outlive it. @pre its path is none within a tolerance
    explicit PathCurve(const PathInput& input);
    PathCurve(const PathCurve&) = delete;
    PathCurve& operator=(const PathCurve&) = delete;

    [[nodiscard]] CurveSource<S>& source() noexcept { return *source_; }
    /// @pre it is made of waypoints
    [[nodiscard]] WaypointCurve<S>& waypoints() noexcept { return *std::get<StreamedCurve<S>>(curve_).curve; }
    /// Its memory.
    [[nodiscard]] std::size_t bytes() const noexcept;

    Status push(const Waypoint<double>& waypoint, Role role);

private:
    int axes_;
    std::variant<StreamedCurve<S>, BezierSource<S>> curve_;
    std::optional<SmoothedCurve<S>> smoothed_; // --smooth
    CurveSource<S>* source_ = nullptr;
};

} // namespace splinefeed::host
