// SPDX-License-Identifier: MIT
// program_arc: the centre and the angle of G2 and G3.
#pragma once

#include "splinefeed/s0_program/words/modal_state.hpp"
#include "splinefeed/s0_program/words/plane_vector.hpp"

namespace splinefeed {

struct ArcGeometry {
    PlanePoint centre{};
    Decimal sweep_deg{}; ///< negative: clockwise
    Decimal radius{};
    /// The radius is above 32768 mm, and the parabola with this control point is within 1e-6 mm of the arc.
    bool is_flat = false;
    PlanePoint control{};
};

/// The letters of a plane's axes and centre offsets: first, second, normal; then I, J, K in the same order.
struct PlaneLetters {
    std::array<char, 3> axes;
    std::array<char, 3> offsets;
};
[[nodiscard]] PlaneLetters letters_of(Plane plane) noexcept;

/// From the words of a block, in program coordinates in mm, within the tolerance of the dialect. The centre of an arc
/// whose radii at both ends differ by more than a 32nd is moved onto the perpendicular bisector. The core's arcs cannot
/// follow such a spiral, and the centre of so small an arc moves by less than its rounding. Errors: the
/// ProgramError::arc_... of a wrong centre, radius or number of turns.
BlockStatus find_arc(const Block& block, const ModalState& modal, const DialectRules& rules, PlanePoint from,
                     PlanePoint to, ArcGeometry& out) noexcept;

} // namespace splinefeed
