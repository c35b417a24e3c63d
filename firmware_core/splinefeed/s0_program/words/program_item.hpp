// SPDX-License-Identifier: MIT
// ProgramItem: what the interpreter makes of a program: moves, dwells, events, in order.
#pragma once

#include "splinefeed/s0_program/words/program_event.hpp"
#include "splinefeed/s1_blended_path/path_element.hpp"

namespace splinefeed {

enum class ItemKind : std::uint8_t { move, dwell, event };

/// What a move is for.
enum class MoveKind : std::uint8_t {
    feed,
    rapid,   ///< a straight line at the limits of the axes; feed_mm_s is 0
    probe,   ///< G38.n; call Interpreter::report_probe with the result
    turning, ///< G33, G33.1, G74, G76, G84: a feed that goes with the turns of the spindle; the feed is that of its S
    home, ///< Marlin's and grbl's homing: a rapid to the stored position in the simulation, a homing cycle on a machine
};

/// How a probe move ends; G38.2 to G38.5.
struct ProbeCondition {
    bool away = false;     ///< stops on the loss of contact (G38.4, G38.5), not on contact
    bool required = false; ///< it is an error if that does not happen (G38.2, G38.4)
};

/// Only the members of its kind are meaningful.
template <Scalar S>
struct ProgramItem {
    ItemKind kind = ItemKind::move;
    std::uint32_t line = 0;    ///< of the source, as push() was told
    bool stops_before = false; ///< the machine must stand at the end of the move before this item

    MoveKind move = MoveKind::feed;
    bool inverse_time = false; ///< G93: `feed` is 1/min
    ProbeCondition probe{};
    std::uint32_t home_axes = 0; ///< MoveKind::home: bit k for axis k of the machine
    PathElement<S> element{};    ///< feed_mm_s as the feed plan counts it: ProgramSettings::rotary_axes
    Decimal feed{};              ///< F as programmed, in mm/min or degrees/min, also if only rotary axes move

    Decimal dwell_s{};

    ProgramEvent event{};
};

} // namespace splinefeed
