// SPDX-License-Identifier: MIT
// SmoothSampler: samples of a planned motion, averaged over a time. The planned motion keeps the acceleration limits;
// its average also keeps the jerk limits. Derivation: smooth_sampler.cpp.
#pragma once

#include "splinefeed/s3_feed_plan/jerk_filtered/smooth_plan.hpp"
#include "splinefeed/s4_segment_stream/moving_average.hpp"
#include "splinefeed/s4_segment_stream/sampler.hpp"

namespace splinefeed {

/// Memory: constant, besides the places of the average. Cost of next(): one evaluation of the curve, one division, and
/// one more division for each cell that the motion or its average passes.
template <Scalar S>
class SmoothSampler final : public Sampler<S> {
public:
    /// @param places  owned by the caller, at least places_for(limits)
    SmoothSampler(SmoothPlan<S>& plan, std::span<PathPosition> places) noexcept : plan_(&plan), mean_(places) {}

    [[nodiscard]] static constexpr std::size_t places_for(const MotionLimits<S>& limits) noexcept {
        return MovingAverage::places_for(larger(limits.smoothing_q8, limits.most_smoothing_q8));
    }

    Pull next(UnderrunPolicy underrun, WorkBudget& work) noexcept override;
    [[nodiscard]] bool at_rest() const noexcept override { return rests_ && rested_ >= dwell_; }
    void clear() noexcept override { begun_ = false; }

private:
    static constexpr int fine = 12; // lengths in units of 2^-12 mm

    Pull tick(UnderrunPolicy underrun, WorkBudget& work) noexcept;
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
    PathPosition tick_start_{}; // of the motion, at the start of the tick
    S sum_{};                   // average over the elapsed part of the tick, times that part, relative to tick_start_
    S left_{};                  // part of the tick that is not yet elapsed
    S elapsed_{};               // time since the start of the profile segment [ticks]
    std::uint32_t rested_ = 0;  // ticks since the motion came to standstill
    std::uint32_t dwell_ = 0;   // ticks until the average is at standstill, plus two
    bool rests_ = true;
    bool in_segment_ = false;
    bool in_tick_ = false;
    bool begun_ = false;
};

} // namespace splinefeed
