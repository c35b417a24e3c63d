// SPDX-License-Identifier: MIT
// FeedPlan: how fast each cell may be travelled: b = v^2 at the nodes between cells; b is linear in s within a cell.
//
//      b |        ______            caps: feed, axis velocity, curvature
//        |   ____/      \___        backward pass: from standstill at the end of the window
//        |  /               \__     forward pass: from what is committed
//        |_/                   \_
//        +-----------------------> s
//        ^committed    ^final      ^end of the window: standstill
//
// Derivation and the proof that the limits hold everywhere in a cell: feed_plan.cpp.
#pragma once

#include "splinefeed/base/work_budget.hpp"
#include "splinefeed/s2_arc_length/arc_length.hpp"
#include "splinefeed/s3_feed_plan/acceleration/backward_pass.hpp"
#include "splinefeed/s3_feed_plan/acceleration/cell_window.hpp"
#include "splinefeed/s3_feed_plan/acceleration/peaked_segment.hpp"
#include "splinefeed/s3_feed_plan/acceleration/steered_segment.hpp"

#include "splinefeed/s3_feed_plan/acceleration/turning.hpp"
#include "splinefeed/s3_feed_plan/steering/steering.hpp"

#include <span>

namespace splinefeed {

/// Stage 3. The window is the caller's storage. The plan in the window always ends at standstill, so the machine can
/// always stop within the known path. Cost: amortised at most four visits per cell, each with two products and sums per
/// axis; independent of the program's length. A change of the steering costs a visit to every cell of the window, and
/// so does a cell that arrives while the input is starved. With a budget the cells that come and the visits are divided
/// among calls; what is planned is the same.
template <Scalar S>
class FeedPlan final : public SampledPlan<S> {
public:
    static constexpr std::size_t smallest_window = 10;

    /// `limits` must outlive the plan: on a microcontroller they stay in ROM.
    /// @pre the window has at least smallest_window cells; this also holds for all other functions
    FeedPlan(ArcLength<S>& source, const MotionLimits<S>& limits, std::span<PlannedCell<S>> window) noexcept;
    FeedPlan(ArcLength<S>& source, const MotionLimits<S>&& limits, std::span<PlannedCell<S>> window) = delete;

    using MotionPlan<S>::prepare;
    Pull prepare(UnderrunPolicy underrun, WorkBudget& work) noexcept override;
    bool plan_ahead(WorkBudget& work) noexcept override { return measure_ahead(work); }
    /// Measures cells that the plan will ask for, as far as the budget and the window's room go. false: nothing was
    /// left to measure, because the window is full or the input has no more.
    bool measure_ahead(WorkBudget& work) noexcept;
    [[nodiscard]] const PlannedCell<S>& front() const noexcept { return window_.at(0); }
    [[nodiscard]] const Cell<S>& cell() const noexcept override { return front().cell; }
    void advance() noexcept override;
    void rest_at(S fraction) noexcept override;
    /// Removes the front cell.
    void pop() noexcept;

    Steered steer(const PlanState<S>& place, UnderrunPolicy underrun, WorkBudget& work) noexcept override;
    [[nodiscard]] bool standing() const noexcept override { return !chosen_ && !(speed_sq_ > S{}); }
    void clear() noexcept override {
        SPLINEFEED_ASSERT(standing());
        forget();
        steering_.start();
    }
    /// Prepares this plan to be refined: another plan takes its cells and uses its speeds as upper bounds, without the
    /// override. The other plan stops at the end of the known path; this plan sets no bound there. @pre first call
    /// after construction
    void lead() noexcept {
        steering_.override_feed(from_integer<S>(2));
        steering_.poll();
        steering_.acknowledge();
        leads_ = true;
    }
    /// Forgets every cell, wherever the plan is, because another plan has travelled them.
    void forget() noexcept;

    /// How often the window was too short to know that the plan equals the plan of an unlimited window (0: always
    /// equal).
    [[nodiscard]] std::uint64_t window_limited() const noexcept { return window_limited_; }

private:
    /// What is wanted in the front cell.
    [[nodiscard]] CapLine<S> wanted() const noexcept {
        return SpeedCaps<S>(limits_).wanted(cell(), front().cap, pass_.wish());
    }
    Pull measure(WorkBudget& work) noexcept;
    Pull fill(WorkBudget& work) noexcept;
    Pull plan(UnderrunPolicy underrun, WorkBudget& work) noexcept;
    bool replan(WorkBudget& work) noexcept;
    [[nodiscard]] bool go_on(UnderrunPolicy underrun) noexcept;
    void begin_pass(bool open_end) noexcept;
    [[nodiscard]] bool run_pass(WorkBudget& work) noexcept;
    void commit() noexcept;
    [[nodiscard]] S reachable_exit() const noexcept;
    void forward_step(S known_sq) noexcept;
    [[nodiscard]] S exit_from_start(S known_sq) const noexcept;
    [[nodiscard]] bool may_peak(S fastest_entry) const noexcept;
    void choose_peaked(S known_sq) noexcept;
    void choose_steered(S known_sq) noexcept;
    [[nodiscard]] S known_exit() const noexcept;

    ArcLength<S>* source_;
    const MotionLimits<S>& limits_;
    CellWindow<S> window_;
    using SampledPlan<S>::profile_segment_;
    using MotionPlan<S>::steering_;

    Turning<S> turning_;
    BackwardPass<S> pass_;
    std::size_t committed_ = 0;
    S at_{};          // where the next profile segment starts in the front cell
    S speed_sq_{};    // v^2 there
    S wanted_exit_{}; // v^2 wanted at the end of the front cell, once a profile segment is chosen
    std::uint64_t window_limited_ = 0;
    Pull filled_ = Pull::starved; // what fill() answered before the pass that commits
    bool planned_ = false;        // the cells in the window have a plan
    bool open_ = false;         // the speed at the end of the window is free: a motion that follows need not stop there
    bool leads_ = false;        // another plan refines this one
    bool chosen_ = false;       // profile_segment_ belongs to the front cell
    bool rest_to_rest_ = false; // profile_segment_ is the first half of a move from standstill to standstill
    bool peaks_ = false;        // the machine is in a cell where its speed has a peak
    bool steered_ = false;      // not yet back on the plan that the steering asks for
};

} // namespace splinefeed
