// SPDX-License-Identifier: MIT
// LegMotion: the motion along a leg: b, db/ds and d2b/ds2 at its nodes, and the middle Bezier points of b in its cells.
//
//      b |      m1____m2            b = v^2: a parabola in each cell, with the middle Bezier point m;
//        |    .'        '.          b and db/ds are continuous whatever the m are
//        |  .'            '.m3
//        |.'                '.      the first and the last cell next to standstill: constant jerk
//        +--|------|-----|----|--> s
#pragma once

#include "splinefeed/s3_feed_plan/jerk/leg_node.hpp"
#include "splinefeed/s3_feed_plan/jerk/speed_state.hpp"

#include <span>

namespace splinefeed {

namespace detail {
/// Slope of b at the moving end of a cell next to standstill, times its length, of b.
inline constexpr double rise_from_rest = 4.0 / 3.0;
} // namespace detail

/// The nodes are the caller's: node i and the cell after it; the last one is the end, at standstill. A node keeps db/ds
/// and d2b/ds2 beside b, because differences of b lose them in short cells.
template <Floating R>
class LegMotion {
public:
    LegMotion() noexcept = default;
    /// @param nodes  one more than cells
    /// @param rests  the leg begins at standstill; otherwise b, slope and middle_sq of the first node are its start
    LegMotion(std::span<LegNode<R>> nodes, bool rests) noexcept
        : node_(nodes), cells_(nodes.size() - 1), first_(rests ? 1U : 0U) {}

    /// What b is made of at each node, and what the nodes stand for. Largest b at the moving ends of the first cell (if
    /// it begins at standstill) and of the last one.
    void join(R first_most_sq, R last_most_sq) noexcept;
    /// b, slope and curvature from middle_sq.
    void evaluate() noexcept;
    /// The state at the first node that moves. @param start  of the leg, if that does not begin at standstill
    [[nodiscard]] SpeedState first(const SpeedState& start) const noexcept;
    /// The state at the end of cell i, from that at its start, by its curvature: continuous to the last digit of
    /// double.
    [[nodiscard]] SpeedState behind(std::size_t i, const SpeedState& state) const noexcept;
    /// Makes the nodes those of that motion. What steps of LegSolver have rounded in R, the gains of the last one
    /// correct.
    void settle(const SpeedState& start, bool by_gains) noexcept;

private:
    [[nodiscard]] bool rests() const noexcept { return first_ == 1; }

    std::span<LegNode<R>> node_;
    std::size_t cells_ = 0;
    std::size_t first_ = 0; // node that the start is told by
};

} // namespace splinefeed
