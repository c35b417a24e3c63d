// SPDX-License-Identifier: MIT
// PathTee: passes the curve on to the plan and shows it to those who check, measure and write it.
#pragma once

#include "host_sim/curve/segment_cast.hpp"
#include "host_sim/planning/curve_watch.hpp"
#include "host_sim/planning/path_feeder.hpp"

#include "splinefeed/s1_curve/curve_source.hpp"

#include <exception>

namespace splinefeed::host {

/// A decorator of the curve. If whoever looks at it refuses a segment, it is not passed on and the curve ends before
/// it: the machine stops there in a controlled way, and failure() has the reason.
template <Scalar S>
class PathTee final : public CurveSource<S> {
public:
    /// All arguments must outlive it.
    PathTee(CurveSource<S>& source, const PathFeeder& feeder, CurveWatch& watch) noexcept
        : source_(&source), feeder_(&feeder), watch_(&watch) {}

    /// Segments are passed on with the index of the waypoint in the input, from 0.
    Pull next(CurveSegment<S>& out) noexcept override {
        if (failure_) {
            return Pull::finished;
        }
        const Pull pull = source_->next(out);
        if (pull != Pull::item) {
            return pull;
        }
        const std::uint32_t row = feeder_->row_of(out.waypoint);
        try {
            watch_->segment(in_double(out), row, *feeder_);
        } catch (...) {
            failure_ = std::current_exception();
            return Pull::finished;
        }
        out.waypoint = row;
        ++segments_;
        return pull;
    }

    [[nodiscard]] const std::exception_ptr& failure() const noexcept { return failure_; }
    [[nodiscard]] std::uint64_t segments() const noexcept { return segments_; }

private:
    CurveSource<S>* source_;
    const PathFeeder* feeder_;
    CurveWatch* watch_;
    std::exception_ptr failure_;
    std::uint64_t segments_ = 0;
};

} // namespace splinefeed::host
