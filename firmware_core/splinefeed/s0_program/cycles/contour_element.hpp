// SPDX-License-Identifier: MIT
// ContourElement: a line or an arc of a contour, and where a tool that is offset from it travels.
#pragma once

#include "splinefeed/s0_program/text/program_errors.hpp"
#include "splinefeed/s0_program/words/cutter_offset.hpp"

namespace splinefeed {

/// In one plane. `programmed` is the contour, `from` and `to` where the tool travels; an arc of both has one centre.
struct ContourElement {
    bool is_arc = false;
    bool is_entry = false; ///< a line to the contour: there is nothing beside it
    PlanePoint programmed_from{};
    PlanePoint programmed_to{};
    PlanePoint centre{};
    Decimal sweep_deg{}; ///< as programmed; negative: clockwise
    PlanePoint from{};
    PlanePoint to{};

    /// 1: an arc to the left, -1: to the right.
    [[nodiscard]] int turn() const noexcept { return sweep_deg.raw < 0 ? -1 : 1; }
    /// Whether the tool is within the circle.
    [[nodiscard]] bool holds_tool(int side) const noexcept { return is_arc && side == turn(); }
    /// Which way it goes where it begins and ends.
    [[nodiscard]] PlaneDirection first_direction() const noexcept;
    [[nodiscard]] PlaneDirection last_direction() const noexcept;
    /// How far the tool's arc turns. Negative where it would have to go back. @pre is_arc
    [[nodiscard]] Decimal tool_sweep_deg() const noexcept;
    /// Whether the tool's way has its direction: the reverse is a gouge.
    [[nodiscard]] bool fits() const noexcept;
};

/// Where a tool passes from an element to the next one. Around an outer corner it goes on an arc about the corner, from
/// `before.to` to `tool_at`; else the former element ends at `tool_at`, and the latter begins there.
struct CornerPlace {
    bool around = false;
    PlanePoint tool_at{};
};
/// Outer corners of less than 0.05 rad have no arc: there both ways are extended to where they cross. A way that turns
/// back within 0.001 rad goes around the corner, unless an arc bends to where the tool was. Error: cutter_gouge where
/// the tool does not fit into the corner.
[[nodiscard]] ProgramResult<CornerPlace> find_corner(const ContourElement& before, const ContourElement& next,
                                                     CutterOffset offset) noexcept;

/// Sets where the tool's way ends if the contour ended there. Error: cutter_arc_too_small where the tool does not fit
/// into an arc.
ProgramStatus offset_end(ContourElement& element, CutterOffset offset) noexcept;

/// Makes an arc the first element: from where the tool stands, at `from`, to its end beside the contour, which it meets
/// as the programmed arc does. @pre offset_end()  Error: cutter_entry_too_short.
ProgramStatus enter_by_arc(ContourElement& element, CutterOffset offset) noexcept;

} // namespace splinefeed
