// SPDX-License-Identifier: MIT
// CounterSeam: starts counters where a run of years would have taken them. The classes that count name it their friend.
#pragma once

#include "splinefeed/number/wide.hpp"

#include <cstdint>

namespace splinefeed {

struct CounterSeam {
    /// A Trajectory's: path length [2^-40 mm], segments of the curve, feed segments.
    template <class Trajectory>
    static void travelled(Trajectory& trajectory, Wide length, std::uint64_t curve_segments,
                          std::uint64_t feed_segments) {
        auto& planner = *trajectory.planner_;
        planner.arc_length_->travelled_ = length;
        planner.arc_length_->segments_ = curve_segments;
        planner.stream_->index_ = feed_segments;
    }
    /// A host's Motion: ticks and feed segments that its machine has executed.
    template <class Motion>
    static void ran(Motion& motion, std::uint64_t ticks, std::uint64_t segments) {
        motion.machine_.elapsed_ticks_ = ticks;
        motion.machine_.executed_ = segments;
        motion.segments_ = segments;
    }
    /// What its path is made of.
    template <class ScalarPath, class Motion>
    static ScalarPath& path(Motion& motion) {
        return *static_cast<ScalarPath*>(motion.path_->memory_.get());
    }
    /// Rows that a WaypointFeeder has read.
    template <class Feeder>
    static void read(Feeder& feeder, std::uint64_t rows) {
        feeder.rows_read_ = rows;
        feeder.pushed_ = rows;
    }
    /// Index of the next waypoint of a WaypointCurve.
    template <class Curve>
    static void pushed(Curve& curve, std::uint32_t waypoints) {
        curve.pushed_ = waypoints;
    }
    /// Start of the next segment of a StepIntervals, of the tick before of an InterpolatedSteps [ticks].
    template <class Engine>
    static void started(Engine& engine, std::int64_t ticks) {
        engine.start_ = ticks;
    }
    /// Ticks of a FixedRate.
    template <class Engine>
    static void passed(Engine& engine, std::int64_t ticks) {
        engine.passed_ = ticks;
    }
};

} // namespace splinefeed
