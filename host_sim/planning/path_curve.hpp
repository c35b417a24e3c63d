// SPDX-License-Identifier: MIT
// PathCurve: the curve of an input in the scalar of its plan.
#pragma once

#include "host_sim/curve/bezier_source.hpp"
#include "host_sim/curve/streamed_curve.hpp"
#include "host_sim/planning/path_sink.hpp"
#include "host_sim/program/path_input.hpp"

#include "splinefeed/s1_blended_path/tolerance_path.hpp"
#include "splinefeed/s1_curve/smoothed_curve.hpp"

#include <optional>
#include <variant>

namespace splinefeed::host {

/// One of three: a curve that is made while its waypoints come, segments that came whole, a path within a tolerance of
/// moves. The first two may be smoothed.
template <Scalar S>
class PathCurve final : public PathSink {
public:
    /// Throws UsageError if an end tangent does not fit the axes, or the method cannot be told what was chosen.
    /// `input` must outlive it.
    explicit PathCurve(const PathInput& input);
    PathCurve(const PathCurve&) = delete;
    PathCurve& operator=(const PathCurve&) = delete;

    [[nodiscard]] CurveSource<S>& source() noexcept { return *source_; }
    /// @pre it is made of waypoints
    [[nodiscard]] WaypointCurve<S>& waypoints() noexcept { return *std::get<StreamedCurve<S>>(curve_).curve; }
    /// What the path within a tolerance has become; 0 for others.
    [[nodiscard]] PathCounts counts() const noexcept;
    /// Its memory.
    [[nodiscard]] std::size_t bytes() const noexcept;

    Status push(const Waypoint<double>& waypoint, Role role) override;
    Status start(const PerAxis<Position>& position) override { return path().start(position); }
    Status push(const SourceStep& step) override;
    [[nodiscard]] Result<bool> has_length(const PerAxis<Position>& from, const SourceStep& step) const override;
    Status finish() override;

private:
    [[nodiscard]] TolerancePath<S>& path() noexcept { return *std::get_if<TolerancePath<S>>(&curve_); }

    int axes_;
    std::variant<StreamedCurve<S>, BezierSource<S>, TolerancePath<S>> curve_;
    std::optional<SmoothedCurve<S>> smoothed_; // --smooth
    CurveSource<S>* source_ = nullptr;
};

} // namespace splinefeed::host
