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

#include "splinefeed/base/ring_index.hpp"
#include "splinefeed/s2_arc_length/arc_length.hpp"
#include "splinefeed/s3_feed_plan/acceleration/profile_segment.hpp"
#include "splinefeed/s3_feed_plan/acceleration/turning.hpp"
#include "splinefeed/s3_feed_plan/steering/steering.hpp"

#include <span>

namespace splinefeed {

/// A cell with its speeds. `entry_sq`, `exit_sq` are v^2 at its ends, valid once it is the front of the plan.
template <Scalar S>
struct PlannedCell {
    Cell<S> cell{};
    S entry_sq{};
    S exit_sq{};
    S cap_sq{};          ///< largest v^2 anywhere in the cell that the machine allows, whatever feed is programmed
    EndSpeeds<S> peak{}; ///< the fastest entry whatever comes after the cell, and the exit that it asks for
    S reach_from_rest{}; ///< an exit_sq that can be reached from rest, and with it all that is below
};

/// Stage 3. The window is the caller's storage. The plan in the window always ends at rest, so whatever is travelled
/// can stop within what is known. Cost: amortised at most four visits a cell, each two products and sums per axis;
/// independent of the program's length. A change of the steering, and a cell that comes in while the input is starved,
/// cost a visit to every cell of the window.
template <Scalar S>
class FeedPlan final : public MotionPlan<S> {
public:
    static constexpr std::size_t smallest_window = 10;

    /// `limits` must outlive the plan: on a microcontroller they stay in ROM.
    /// A window below smallest_window is a broken precondition of all that follows.
    FeedPlan(ArcLength<S>& source, const MotionLimits<S>& limits, std::span<PlannedCell<S>> window) noexcept;
    FeedPlan(ArcLength<S>& source, const MotionLimits<S>&& limits, std::span<PlannedCell<S>> window) = delete;

    Pull prepare(UnderrunPolicy underrun = UnderrunPolicy::wait) noexcept override;
    [[nodiscard]] const PlannedCell<S>& front() const noexcept { return at(0); }
    [[nodiscard]] const Cell<S>& cell() const noexcept override { return at(0).cell; }
    /// Largest v^2 in the front cell, whatever is programmed and comes before and after it.
    [[nodiscard]] S cap_sq() const noexcept { return at(0).cap_sq; }
    /// Largest v^2 that is wanted in a cell with this cap, for a factor of the programmed feed.
    [[nodiscard]] S wanted_sq(const Cell<S>& cell, S cap_sq, S ratio) const noexcept;
    /// v^2 of the feed that is programmed for a cell, or of the machine's.
    [[nodiscard]] S programmed_sq(const Cell<S>& cell) const noexcept;
    void advance() noexcept override;
    void rest_at(S fraction) noexcept override;
    /// The cell is done.
    void pop() noexcept;

    bool steer(const Place<S>& place) noexcept override;
    [[nodiscard]] bool standing() const noexcept override { return !chosen_ && !(speed_sq_ > S{}); }
    void clear() noexcept override;
    /// Another plan takes the cells, and these speeds as bounds of its own, whatever the override: the end of what is
    /// known is where that plan rests, and no bound. @pre nothing was asked of it yet
    void lead() noexcept;
    /// Forgets every cell, wherever the plan is: another plan travelled them.
    void forget() noexcept;

    /// How often the window was too short to tell the plan from that of an unlimited one (0: the plan is the same).
    [[nodiscard]] std::uint64_t window_limited() const noexcept { return window_limited_; }

private:
    [[nodiscard]] PlannedCell<S>& at(std::size_t i) noexcept { return window_[ring_index(head_ + i, window_.size())]; }
    [[nodiscard]] const PlannedCell<S>& at(std::size_t i) const noexcept {
        return window_[ring_index(head_ + i, window_.size())];
    }

    void bound(PlannedCell<S>& planned) const noexcept;
    [[nodiscard]] S path_speed(const Cell<S>& cell, S feed) const noexcept;
    [[nodiscard]] S wanted_sq(const PlannedCell<S>& planned) const noexcept {
        return wanted_sq(planned.cell, planned.cap_sq, steering_.ratio());
    }
    Pull fill() noexcept;
    std::size_t backward_pass(bool open_end = false) noexcept;
    void commit(bool ended) noexcept;
    void replan() noexcept;
    [[nodiscard]] S reachable_exit() const noexcept;
    void forward_step(S known_sq) noexcept;
    void choose_steered(S known_sq) noexcept;
    [[nodiscard]] S known_exit() const noexcept;

    ArcLength<S>* source_;
    const MotionLimits<S>& limits_;
    std::span<PlannedCell<S>> window_;
    using MotionPlan<S>::profile_segment_;
    using MotionPlan<S>::steering_;

    Turning<S> turning_;
    std::size_t head_ = 0;
    std::size_t size_ = 0;
    std::size_t committed_ = 0;
    S at_{};          // where the next profile segment starts in the front cell
    S speed_sq_{};    // v^2 there
    S wanted_exit_{}; // at the end of the front cell, once a profile segment is chosen
    std::uint64_t window_limited_ = 0;
    bool planned_ = false;      // the window, as it is
    bool open_ = false;         // with a free speed at its end: a motion that follows need not rest there
    bool leads_ = false;        // another plan follows
    bool chosen_ = false;       // passage_ is the front's
    bool rest_to_rest_ = false; // passage_ is the first half of one from rest to rest
    bool steered_ = false;      // not yet back on the plan that the steering asks for
};

} // namespace splinefeed
