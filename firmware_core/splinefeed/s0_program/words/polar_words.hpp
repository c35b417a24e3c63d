// SPDX-License-Identifier: MIT
// polar_words: @, a radius, and ^, an angle, in the plane of X and Y.
#pragma once

#include "splinefeed/s0_program/words/axis_letters.hpp"
#include "splinefeed/s0_program/words/modal_state.hpp"

namespace splinefeed {

/// Before a block is understood: X and Y stand in the place of @ and ^, as in LinuxCNC (interp_find.cc, find_ends).
/// Under G91 they are added to the radius and the angle of the place.
/// @param modal  before the block
/// @param from  the place, in the program's coordinates
/// Repeats of a cycle under G91 need @ and ^ themselves: there they stay, beside X and Y of the first hole.
/// Error: polar_unsuited.
BlockStatus adapt_polar(Block& block, const ModalState& modal, const AxisLetters& letters, PlanePoint from) noexcept;

/// A point with that much more radius about X0 Y0, turned by the angle. @pre it is not X0 Y0
[[nodiscard]] PlanePoint polar_step(PlanePoint from, Decimal radius, Decimal degrees) noexcept;

} // namespace splinefeed
