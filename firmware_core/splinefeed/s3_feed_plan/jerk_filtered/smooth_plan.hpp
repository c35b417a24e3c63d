// SPDX-License-Identifier: MIT
// SmoothPlan: a speed profile whose moving average keeps every axis's jerk limit. It takes its cells from an
// acceleration-limited plan; the speeds of that plan are upper bounds. It computes in the scalar of the pipeline.
//
//      b |      ____            backward: the largest b from which the end of the known path can be
//        |     /    \           reached at standstill; forward: as fast as that allows, where the
//        |    /      \          acceleration changes its sign only after the time of the average
//        |___/        \___
//        +----------------> s
//
// Derivation: smooth_plan.cpp, filtered_limits.cpp.
#pragma once

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/s3_feed_plan/acceleration/graded_feed.hpp"
#include "splinefeed/s3_feed_plan/jerk_filtered/sign_memory.hpp"
#include "splinefeed/s3_feed_plan/jerk_filtered/smooth_window.hpp"

namespace splinefeed {

/// Stage 3b with bounded cost. SmoothSampler averages the motion that is planned here. The machine follows the average;
/// cells are kept until the machine has passed them. Cost: amortised at most four visits per cell, each with
/// FilteredLimits.
template <Scalar S>
class SmoothPlan final : public MotionPlan<S> {
public:
    static constexpr std::size_t smallest_window = 12;

    /// @pre at least smallest_window cells; this also holds for all other functions
    SmoothPlan(FeedPlan<S>& source, const MotionLimits<S>& limits, std::span<SmoothCell<S>> cells) noexcept;

    using MotionPlan<S>::prepare;
    Pull prepare(UnderrunPolicy underrun, WorkBudget& work) noexcept override;
    /// The cell of the profile segment.
    [[nodiscard]] const Cell<S>& cell() const noexcept override { return window_.at(window_.front()).cell; }
    /// Duration of the profile segment, in ticks.
    [[nodiscard]] S ticks() const noexcept { return ticks_; }
    /// Path length at the start of the profile segment's cell.
    [[nodiscard]] PathPosition cell_start() const noexcept { return window_.at(window_.front()).start; }
    void advance() noexcept override;
    void rest_at(S fraction) noexcept override {
        at_ = fraction;
        speed_sq_ = speed_ = S{};
        chosen_ = false;
    }
    bool steer(const PlanState<S>& place) noexcept override;
    [[nodiscard]] bool standing() const noexcept override { return !chosen_ && !(speed_sq_ > S{}); }
    void clear() noexcept override {
        SPLINEFEED_ASSERT(standing());
        source_.forget();
        window_.clear();
        steering_.start();
        taken_ = looked_ = 0;
        at_ = speed_sq_ = speed_ = S{};
        sign_ = {};
        chosen_ = starved_ = false;
    }

    /// The length of the average, from this standstill on. @pre standing(), the last prepare() answered item
    [[nodiscard]] std::uint32_t smoothing_q8() const noexcept { return window_.at(window_.front()).smoothing_q8; }

    /// The oldest cell that is kept, and its place on the path; release() moves on to the next one.
    [[nodiscard]] const SmoothCell<S>& oldest() const noexcept { return window_.at(0); }
    /// Whether there is a cell after the oldest one.
    [[nodiscard]] bool can_release() const noexcept { return window_.front() > 0 && window_.size() > 1; }
    void release() noexcept { window_.release(); }
    [[nodiscard]] bool empty() const noexcept { return window_.size() == 0; }

private:
    using MotionPlan<S>::profile_segment_;
    using MotionPlan<S>::steering_;

    [[nodiscard]] SmoothCell<S>& ahead(std::size_t i) noexcept { return window_.at(window_.front() + i); }
    [[nodiscard]] const SmoothCell<S>& ahead(std::size_t i) const noexcept { return window_.at(window_.front() + i); }
    [[nodiscard]] std::size_t known() const noexcept { return window_.prepared() - window_.front(); }
    [[nodiscard]] bool ends(std::size_t i) const noexcept {
        return i + 1 == known() || window_.ends_leg(window_.front() + i);
    }
    [[nodiscard]] S override_exit(std::size_t i) const noexcept {
        return ends(i) ? S{} : ahead(i + 1).override_controllable_sq;
    }
    [[nodiscard]] S machine_exit(std::size_t i) const noexcept {
        return ends(i) ? S{} : ahead(i + 1).machine_controllable_sq;
    }

    Pull take(UnderrunPolicy underrun) noexcept;
    Pull refill(UnderrunPolicy underrun) noexcept;
    [[nodiscard]] S wanted_sq(const SmoothCell<S>& cell) const noexcept {
        const S ratio = steering_.ratio();
        return larger(smaller(cell.max_steady_sq, cell.demand.programmed_sq * (ratio * ratio)),
                      smaller(cell.max_steady_sq, literal<S>(SpeedCaps<S>::slowest_sq)));
    }
    bool ends_here() noexcept;
    void backward_pass(bool all) noexcept;
    [[nodiscard]] S length() const noexcept { return ahead(0).cell.length_mm; }
    [[nodiscard]] FilteredLimits<S> bound_of(const SmoothCell<S>& cell) noexcept {
        if (cell.smoothing_q8 != smoothing_.duration_q8) {
            smoothing_ = Smoothing<S>(cell.smoothing_q8, *limits_);
        }
        return FilteredLimits<S>(cell.demand, *limits_, smoothing_);
    }
    [[nodiscard]] bool coasts(S from, S speed_sq, S speed) const noexcept;
    void forward_step() noexcept;
    bool accelerate() noexcept;
    void brake(S goal_sq) noexcept;
    bool coast() noexcept;
    void follow() noexcept;
    void crawl() noexcept;
    /// Whether the speed was constant for long enough to change the sign of the acceleration.
    [[nodiscard]] bool rested() const noexcept { return sign_.rested(smoothing_.ticks()); }
    void profile_segment_to(S to, S exit_sq) noexcept;

    GradedFeed<S> source_;
    const MotionLimits<S>* limits_;
    SmoothWindow<S> window_;
    Smoothing<S> smoothing_{}; // of the cell that was looked at last
    std::size_t taken_ = 0;    // cells that the motion left since the window was filled
    std::size_t looked_ = 0;   // cells from the front on at the last backward pass
    S at_{};                   // where the next profile segment starts in the front cell
    S speed_sq_{};             // v^2 there
    S speed_{};                // v there
    S exit_speed_{};           // v at the end of the profile segment
    S ticks_{};                // of the profile segment
    SignMemory<S> sign_{};     // of the acceleration so far
    bool chosen_ = false;
    bool starved_ = false; // the input was starved when the window was filled last
};

} // namespace splinefeed
