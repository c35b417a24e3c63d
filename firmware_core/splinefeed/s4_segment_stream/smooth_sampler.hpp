// SPDX-License-Identifier: MIT
// SmoothSampler: samples of a planned motion that is averaged over a time: what keeps its acceleration keeps its jerk.
// Derivation: smooth_sampler.cpp.
#pragma once

#include "splinefeed/s3_feed_plan/jerk_filtered/smooth_plan.hpp"
#include "splinefeed/s4_segment_stream/moving_average.hpp"
#include "splinefeed/s4_segment_stream/sampler.hpp"

namespace splinefeed {

/// Memory: constant, beside the places of the mean. Cost of next(): one evaluation of the curve and one division, and
/// one for each cell that the motion and its mean pass.
template <Scalar S>
class SmoothSampler final : public Sampler<S> {
public:
    /// @param places  the caller's, at least places_for() the limits
    SmoothSampler(SmoothPlan<S>& plan, std::span<PathPosition> places) noexcept : plan_(&plan), mean_(places) {}

    [[nodiscard]] static constexpr std::size_t places_for(const MotionLimits<S>& limits) noexcept {
        return MovingAverage::places_for(larger(limits.smoothing_q8, limits.most_smoothing_q8));
    }

    Pull next(UnderrunPolicy underrun) noexcept override;
    [[nodiscard]] bool at_rest() const noexcept override { return rests_ && rested_ >= dwell_; }
    void clear() noexcept override { begun_ = false; }

private:
    static constexpr int fine = 12; // lengths in units of 2^-12 mm

    Pull tick(UnderrunPolicy underrun) noexcept;
    void begin() noexcept;
    void travel() noexcept;
    void follow_steering() noexcept;
    void arrive() noexcept;
    void locate(PathPosition mean) noexcept;

    using Sampler<S>::position_;
    using Sampler<S>::origin_;
    using Sampler<S>::waypoint_;

    SmoothPlan<S>* plan_;
    MovingAverage mean_;
    PathPosition place_{};      // of the motion
    PathPosition tick_start_{}; // and at the start of the tick
    S sum_{};                   // mean over the part of the tick that has passed, times that part, from tick_start_
    S left_{};                  // part of the tick that is still to come
    S elapsed_{};               // time since the start of the profile segment [ticks]
    std::uint32_t rested_ = 0;  // ticks since the motion came to rest
    std::uint32_t dwell_ = 0;   // until the mean has come to rest, and twice more
    bool rests_ = true;
    bool in_segment_ = false;
    bool in_tick_ = false;
    bool begun_ = false;
};

} // namespace splinefeed
