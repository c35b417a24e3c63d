// SPDX-License-Identifier: MIT
// BlockMotion: the motion of a block, in machine coordinates and without a scalar.
#pragma once

#include "splinefeed/s0_program/words/modal_state.hpp"
#include "splinefeed/s0_program/words/program_item.hpp"
#include "splinefeed/s0_program/words/work_frame.hpp"

namespace splinefeed {

/// x, y and z, in this order, of the program.
using SpacePoint = std::array<Decimal, 3>;

enum class PlanKind : std::uint8_t { none, line, line_by_way, arc, bezier, cycle, nurbs, point, tap, thread };

/// An arc; its axis is a direction of the program's frame.
struct ArcPlan {
    SpacePoint centre{}; ///< in machine coordinates
    Plane plane = Plane::xy;
    Decimal sweep_deg{}; ///< negative: clockwise
};

struct BezierPlan {
    static constexpr int most_points = 6;
    int degree = 3;
    bool rational = false;
    std::array<SpacePoint, most_points> points{}; ///< in machine coordinates; the first is the start
    std::array<Decimal, most_points> weights{};   ///< if rational; the largest is 1
};

/// How moves are made; the same for all of a block.
struct MoveManner {
    PathMode mode = PathMode::continuous;
    bool inverse_time = false;
    bool per_turn = false;       ///< under G96: the feed is the way of a turn
    bool feed_in_inches = false; ///< it was stated in them, or in degrees
    Decimal tolerance_mm{};
    Decimal chain_tolerance_mm{};
    Decimal feed{};
    SurfaceSpeed surface{}; ///< of a spindle that turns
};

struct BlockMotion {
    PlanKind kind = PlanKind::none;
    MoveKind move = MoveKind::feed;
    ProbeCondition probe{};
    bool stops_before = false; ///< the move before it ends at rest
    bool stop_at_end = false;
    bool is_contour = false; ///< the contour of cutter compensation goes on
    std::uint32_t home_axes = 0;
    MoveManner manner{};
    AxisPoint way{};      ///< of line_by_way and tap: where the first line ends
    Decimal back_speed{}; ///< of tap: the spindle on the way back [1/min]
    AxisPoint to{};
    ArcPlan arc{};

    /// No motion; what the shapes do not have stays as it is.
    void clear() noexcept {
        kind = PlanKind::none;
        move = MoveKind::feed;
        probe = {};
        stops_before = stop_at_end = is_contour = false;
        home_axes = 0;
    }
};

} // namespace splinefeed
