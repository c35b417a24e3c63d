// SPDX-License-Identifier: MIT
// SmoothPlan: the feed plan once more, so that its average over a time keeps every axis's jerk, too. It takes its cells
// from an acceleration-limited plan, whose speeds bound its own. All of it is in the scalar of the pipeline.
//
//      b |      ____            backward: the largest b from which what is known can be ended at rest
//        |     /    \           forward: as fast as that allows, where an acceleration never changes its sign
//        |    /      \          but after the time that is averaged over
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

/// Stage 3b of bounded cost. The motion that it plans is to be averaged (SmoothSampler); the machine follows the mean,
/// and cells are kept until that has passed them. Cost: amortised at most four visits a cell of FilteredLimits.
template <Scalar S>
class SmoothPlan final : public MotionPlan<S> {
public:
    static constexpr std::size_t smallest_window = 12;

    /// Fewer cells than smallest_window are a broken precondition of all that follows.
    SmoothPlan(FeedPlan<S>& source, const MotionLimits<S>& limits, std::span<SmoothCell<S>> cells) noexcept;

    Pull prepare(UnderrunPolicy underrun = UnderrunPolicy::wait) noexcept override;
    /// Of the profile segment.
    [[nodiscard]] const Cell<S>& cell() const noexcept override { return window_.at(window_.front()).cell; }
    /// What the profile segment takes, in ticks.
    [[nodiscard]] S ticks() const noexcept { return ticks_; }
    /// Path length at the start of the profile segment's cell.
    [[nodiscard]] PathPosition cell_start() const noexcept { return window_.at(window_.front()).start; }
    void advance() noexcept override;
    void rest_at(S fraction) noexcept override {
        at_ = fraction;
        speed_sq_ = speed_ = S{};
        chosen_ = false;
    }
    bool steer(const Place<S>& place) noexcept override;
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

    /// How the motion is averaged from its rest on. @pre standing(), the last prepare() answered item
    [[nodiscard]] std::uint32_t smoothing_q8() const noexcept { return window_.at(window_.front()).smoothing_q8; }

    /// The oldest cell that is kept, and its place on the path; the machine goes on to the next one.
    [[nodiscard]] const SmoothCell<S>& oldest() const noexcept { return window_.at(0); }
    /// There is one behind the oldest.
    [[nodiscard]] bool can_release() const noexcept { return window_.front() > 0 && window_.size() > 1; }
    void release() noexcept { window_.release(); }
    [[nodiscard]] bool empty() const noexcept { return window_.size() == 0; }

private:
    static constexpr double slowest_sq = 1e-6; // as FeedPlan's

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
                      smaller(cell.max_steady_sq, literal<S>(slowest_sq)));
    }
    bool ends_here() noexcept;
    void backward_pass(bool all) noexcept;
    [[nodiscard]] S length() const noexcept { return ahead(0).cell.length_mm; }
    [[nodiscard]] FilteredLimits<S> bound_of(const SmoothCell<S>& cell) noexcept {
        if (cell.smoothing_q8 != smoothing_.duration_q8) {
            smoothing_ = Smoothing<S>(cell.smoothing_q8, limits_->segments_per_s);
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
    /// Long enough at constant speed for a change of sign.
    [[nodiscard]] bool rested() const noexcept { return sign_.rested(smoothing_.ticks()); }
    void profile_segment_to(S to, S exit_sq) noexcept;

    GradedFeed<S> source_;
    const MotionLimits<S>* limits_;
    SmoothWindow<S> window_;
    Smoothing<S> smoothing_{}; // of the cell that was looked at last
    std::size_t taken_ = 0;    // cells that were left since the window was filled
    std::size_t looked_ = 0;   // cells from the front on when it was looked back last
    S at_{};                   // where the next profile segment starts in the front cell
    S speed_sq_{};             // v^2 there
    S speed_{};                // v there
    S exit_speed_{};           // v at the end of the profile segment
    S ticks_{};                // of the profile segment
    SignMemory<S> sign_{};     // of the acceleration before
    bool chosen_ = false;
    bool starved_ = false; // when it was filled last
};

} // namespace splinefeed
