// SPDX-License-Identifier: MIT
// ProgramStep: an item of a program without a scalar.
#pragma once

#include "splinefeed/s0_program/words/block_motion.hpp"

namespace splinefeed {

/// What `Interpreter<S>` makes a `ProgramItem<S>` of. Places are in machine coordinates.
struct ProgramStep {
    ItemKind kind = ItemKind::move;
    MoveKind move = MoveKind::feed;
    MoveShape shape = MoveShape::line;
    ProbeCondition probe{};
    bool stops_before = false;
    bool stop_at_end = false;
    bool is_contour = false; // cutter compensation holds it back
    bool joined = false;     // it goes on with the direction and curvature of the step before it
    bool is_point = false;   // of a curve: it is no move by itself
    std::uint32_t home_axes = 0;
    AxisPoint from{};
    AxisPoint to{};
    const ArcPlan* arc = nullptr; // until the next step
    const BezierPlan* bezier = nullptr;
    Decimal dwell_s{};
};

} // namespace splinefeed
