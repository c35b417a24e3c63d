// SPDX-License-Identifier: MIT
// PathTee: passes the curve on to the machine and shows it to the objects that check, measure and write it.
#pragma once

#include "host_sim/analysis/limit_share.hpp"
#include "host_sim/analysis/optimum_time.hpp"
#include "host_sim/analysis/path_deviation.hpp"
#include "host_sim/analysis/waypoint_error.hpp"
#include "host_sim/output/curve_writer.hpp"
#include "host_sim/planning/curve_feeder.hpp"
#include "host_sim/planning/path_limits.hpp"

#include <exception>

namespace splinefeed::host {

/// The objects that see the curve; null: not used.
struct PathObservers {
    const PathLimits* limits = nullptr;
    CurveWriter* writer = nullptr;
    WaypointError* error = nullptr;
    PathDeviation* deviation = nullptr;
    OptimumTime* optimum = nullptr;
    LimitShare* share = nullptr;
};

/// A decorator of the curve. If a segment leaves the limits, or cannot be written, it is not passed on and the curve
/// ends before it: the machine stops there in a controlled way, and failure() has the reason.
template <Scalar S>
class PathTee final : public CurveSource<S> {
public:
    /// `file`: the name of the input for messages. All arguments must outlive it.
    PathTee(CurveFeeder<S>& feeder, const std::string& file, const PathObservers& observers) noexcept
        : feeder_(&feeder), file_(&file), observers_(observers) {}

    /// Segments are passed on with the index of the waypoint in the input, from 0.
    Pull next(CurveSegment<S>& out) noexcept override;

    [[nodiscard]] const std::exception_ptr& failure() const noexcept { return failure_; }
    [[nodiscard]] std::uint64_t segments() const noexcept { return segments_; }

private:
    void look(CurveSegment<S>& segment);

    CurveFeeder<S>* feeder_;
    const std::string* file_;
    PathObservers observers_;
    std::exception_ptr failure_;
    std::uint64_t segments_ = 0;
};

} // namespace splinefeed::host
