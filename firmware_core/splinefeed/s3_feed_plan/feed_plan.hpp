// SPDX-License-Identifier: MIT
// FeedPlan: how fast each cell may be travelled: b = v^2 at the nodes between cells, linear in s within a cell.
//
//      b |        ______            caps: feed, axis velocity, curvature
//        |   ____/      \___        backward pass: from rest at the end of the window
//        |  /               \__     forward pass: from what is committed
//        |_/                   \_
//        +-----------------------> s
//        ^committed    ^final      ^end of the window: at rest
//
// Derivation and the proof that the limits hold everywhere in a cell: feed_plan.cpp.
#pragma once

#include "splinefeed/s2_arc_length/arc_length.hpp"
#include "splinefeed/s3_feed_plan/acceleration_bound.hpp"

#include <span>

namespace splinefeed {

/// A cell with its speeds. `entry_sq`, `exit_sq` are v^2 at its ends, valid once it is committed.
template <Scalar S>
struct PlannedCell {
    Cell<S> cell{};
    S entry_sq{};
    S exit_sq{};
    S cap_sq{};          ///< largest v^2 anywhere in the cell
    EndSpeeds<S> peak{}; ///< the fastest entry whatever comes after the cell, and the exit that it asks for
    S reach_from_rest{}; ///< an exit_sq that can be reached from rest, and with it all that is below
};

/// Stage 3. The window is the caller's storage. The plan in the window always ends at rest, so whatever is committed
/// can stop within what is known. Committed values never change. Cost: amortised at most four visits a cell, each one
/// product and sum per axis; independent of the program's length.
template <Scalar S>
class FeedPlan {
public:
    static constexpr std::size_t smallest_window = 12;

    /// `limits` must outlive the plan: on a microcontroller they stay in ROM.
    /// @pre window.size() >= smallest_window
    FeedPlan(ArcLength<S>& source, const MotionLimits<S>& limits, std::span<PlannedCell<S>> window) noexcept;
    FeedPlan(ArcLength<S>& source, const MotionLimits<S>&& limits, std::span<PlannedCell<S>> window) = delete;

    /// Makes sure that front() is a committed cell. `starved`: the window is not full and no cell is committed.
    Pull prepare() noexcept;
    /// @pre the last prepare() answered item
    [[nodiscard]] const PlannedCell<S>& front() const noexcept { return at(0); }
    void pop() noexcept;

    /// How often the window was too short to tell the plan from that of an unlimited one (0: the plan is the same).
    [[nodiscard]] std::uint32_t window_limited() const noexcept { return window_limited_; }

private:
    [[nodiscard]] PlannedCell<S>& at(std::size_t i) noexcept { return window_[(head_ + i) % window_.size()]; }
    [[nodiscard]] const PlannedCell<S>& at(std::size_t i) const noexcept {
        return window_[(head_ + i) % window_.size()];
    }

    void bound(PlannedCell<S>& planned) const noexcept;
    void plan(bool ended) noexcept;

    ArcLength<S>* source_;
    const MotionLimits<S>& limits_;
    std::span<PlannedCell<S>> window_;
    std::size_t head_ = 0;
    std::size_t size_ = 0;
    std::size_t committed_ = 0;
    S entry_sq_{}; // v^2 at the first cell that is not committed
    std::uint32_t window_limited_ = 0;
};

} // namespace splinefeed
