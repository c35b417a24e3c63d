// SPDX-License-Identifier: MIT
// JerkPlan: the feed plan once more, with every axis's jerk limited. It takes its cells from an acceleration-limited
// plan, whose speeds bound its own.
//
//      b |    __/ \__         acceleration-limited: kinks are jumps of the acceleration
//        |   / .---. \        jerk-limited: below, b and db/ds continuous, at rest with a = 0,
//        |  /./     \.\       and at rest at the end of what is known
//        |_//         \\_
//        +-----------------> s
#pragma once

#include "splinefeed/s3_feed_plan/feed_plan.hpp"
#include "splinefeed/s3_feed_plan/jerk_leg.hpp"
#include "splinefeed/s3_feed_plan/line_travel.hpp"

namespace splinefeed {

/// Memory of a JerkPlan, the caller's: its window of cells, and one node more.
template <Scalar S>
struct JerkStorage {
    std::span<Cell<S>> cells;
    std::span<JerkNode> nodes;
};

/// Stage 3b. What is planned in the window always ends at rest. Cost: a cell is planned about twice (JerkLeg::plan).
/// It is not steered yet: hold, abort and override wait for the end of the program.
template <Scalar S>
class JerkPlan final : public MotionPlan<S> {
public:
    static constexpr std::size_t smallest_window = 16;

    /// @pre cells.size() >= smallest_window, nodes.size() > cells.size()
    JerkPlan(FeedPlan<S>& source, const MotionLimits<S>& limits, const JerkStorage<S>& storage) noexcept;

    Pull prepare(Starvation starvation = Starvation::waits) noexcept override;
    [[nodiscard]] const Cell<S>& cell() const noexcept override { return cell_at(0); }
    void advance() noexcept override;
    void rest_at(S fraction) noexcept override;
    void steer(S fraction, S speed_sq) noexcept override;
    [[nodiscard]] bool standing() const noexcept override;
    void clear() noexcept override;

    /// How often a leg could not be planned as fast as it should be: it is travelled slower, within all limits.
    [[nodiscard]] std::uint32_t slow_legs() const noexcept { return slow_legs_; }

private:
    using MotionPlan<S>::passage_;

    [[nodiscard]] Cell<S>& cell_at(std::size_t i) noexcept {
        return storage_.cells[(head_ + i) % storage_.cells.size()];
    }
    [[nodiscard]] const Cell<S>& cell_at(std::size_t i) const noexcept {
        return storage_.cells[(head_ + i) % storage_.cells.size()];
    }

    Pull fill(Starvation starvation) noexcept;
    Pull take(Starvation starvation) noexcept;
    [[nodiscard]] bool bend_jumps(const JerkNode& before, const JerkNode& after) const noexcept;
    void plan(bool ended) noexcept;
    bool plan_leg(std::size_t first, std::size_t end) noexcept;
    void mark_hops(std::size_t first, std::size_t end) noexcept;
    void forget_travelled() noexcept;
    void choose() noexcept;
    void choose_on_line() noexcept;

    FeedPlan<S>* source_;
    const MotionLimits<S>* limits_;
    JerkStorage<S> storage_;
    LineTravel line_{};         // while a straight leg is travelled
    std::size_t head_ = 0;      // of the ring of cells
    std::size_t size_ = 0;      // cells in it
    std::size_t travelled_ = 0; // nodes before the head's
    std::size_t committed_ = 0; // cells from the head on
    std::size_t planned_ = 0;   // cells from the head on that have a plan, at rest at its end
    std::uint32_t slow_legs_ = 0;
    double on_line_mm_ = 0.0; // of the cell, already travelled
    bool chosen_ = false;
    bool planned_all_ = false; // nothing came in since the last plan
};

} // namespace splinefeed
