// SPDX-License-Identifier: MIT
// Planner: decides which plan a Trajectory follows, and holds the memory of all its stages.
#pragma once

#include "splinefeed/base/slot.hpp"
#include "splinefeed/s3_feed_plan/acceleration/feed_plan.hpp"
#include "splinefeed/s4_segment_stream/sampler.hpp"
#include "splinefeed/s4_segment_stream/segment_stream.hpp"

namespace splinefeed {

template <Scalar S>
class Trajectory;

/// The caller chooses one of the derived classes, owns it, and passes it to Trajectory::make(): AccelerationPlanner for
/// limits without jerk, JerkPlanner for limits with jerk. One planner serves one trajectory at a
/// time.
/// Size: several kilobytes, so static memory is the best place. The window of cells is separate storage of the caller.
template <Scalar S>
class Planner {
public:
    Planner(const Planner&) = delete;
    Planner& operator=(const Planner&) = delete;

protected:
    /// The stages that differ between the planners.
    struct Stages {
        MotionPlan<S>* plan = nullptr;
        Sampler<S>* sampler = nullptr;
    };

    /// @param window  where the feed plan looks ahead, at least FeedPlan::smallest_window cells, owned by the caller
    explicit constexpr Planner(std::span<PlannedCell<S>> window) noexcept : window_(window) {}
    ~Planner() = default;

private:
    friend class Trajectory<S>;
    friend struct CounterSeam;

    /// Checks that this planner suits the limits and has enough storage. Errors: planner_unsuited, window_too_small,
    /// storage_too_small.
    [[nodiscard]] virtual Status fits(const MotionLimits<S>& limits) const noexcept = 0;
    [[nodiscard]] virtual Stages build(FeedPlan<S>& speeds, const MotionLimits<S>& limits) noexcept = 0;

    std::span<PlannedCell<S>> window_;
    Slot<ArcLength<S>> arc_length_;
    Slot<FeedPlan<S>> feed_plan_;
    Slot<SegmentStream<S>> stream_;
    Stages stages_{};
    Pull state_ = Pull::starved; // the answer of the last next()
};

} // namespace splinefeed
