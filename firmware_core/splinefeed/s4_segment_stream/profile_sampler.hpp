// SPDX-License-Identifier: MIT
// ProfileSampler: samples of a motion that is travelled exactly as planned, profile segment after profile segment.
// Derivation: profile_sampler.cpp.
#pragma once

#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"
#include "splinefeed/s4_segment_stream/profile_motion.hpp"
#include "splinefeed/s4_segment_stream/sampler.hpp"

namespace splinefeed {

/// Memory: constant. Cost of next(): one evaluation of the curve, and one division per cell that is passed: amortised
/// constant, at most the cells of the window. After a change of the steering also a visit to every cell of the window.
/// @tparam X  in which it counts: that of the plan
template <Scalar S, Scalar X = S>
class ProfileSampler final : public Sampler<S> {
public:
    ProfileSampler(SampledPlan<S, X>& plan, const MotionLimits<S>& limits) noexcept;

    Pull next(UnderrunPolicy underrun, WorkBudget& work) noexcept override;
    [[nodiscard]] bool at_rest() const noexcept override { return place_ <= Place::between && repeats_ == 0; }
    void clear() noexcept override {}

private:
    /// `past`: the end of a profile segment; elapsed_ already holds the next sample's time.
    enum class Place : std::uint8_t { fresh, between, on_segment, past };

    Pull enter_segment(UnderrunPolicy underrun, WorkBudget& work) noexcept;
    bool follow_steering(UnderrunPolicy underrun, WorkBudget& work) noexcept;
    [[nodiscard]] X braked(X x, X speed) const noexcept;
    bool arrive() noexcept;
    void rest() noexcept;
    [[nodiscard]] bool may_arrive_at(const PerAxis<Position>& stop) const noexcept;
    [[nodiscard]] bool may_leave() const noexcept;
    [[nodiscard]] bool within(unsigned axis, X change) const noexcept;
    [[nodiscard]] X fraction_at(X time) const noexcept;

    using Sampler<S>::position_;
    using Sampler<S>::origin_;
    using Sampler<S>::waypoint_;

    SampledPlan<S, X>* plan_;
    PerAxis<X> braking_mm_s2_{};
    X segments_per_s_{};
    X elapsed_{}; // time since the start of the profile segment [segment durations]
    ProfileMotion<X> motion_;
    PerAxis<Position> previous_{}; // the previous sample
    PerAxis<Position> older_{};    // the one before it
    int axes_ = 0;
    int repeats_ = 0;              // samples that are still to be repeated at a stop
    bool between_samples_ = false; // a motion may arrive at a stop, and leave it, between samples
    bool resting_ = false;         // the last three samples are equal
    Place place_ = Place::fresh;
    bool steers_ = false; // the plan is about to follow the steering
};

} // namespace splinefeed
