// SPDX-License-Identifier: MIT
#include "splinefeed/s0_program/words/fanuc_fault.hpp"

#include "splinefeed/base/sentence_table.hpp"

namespace splinefeed {

namespace {

constexpr Sentence<FanucFault> fault_sentences[] = {
    {FanucFault::none, "no error"},
    {FanucFault::system_number, "G54.1 takes P1 to P48, and G154 P1 to P99, alone in their block with a P"},
    {FanucFault::rotation_angle, "G68 needs R, its angle in degrees; without it controls take that of a setting"},
    {FanucFault::rotation_centre,
     "G68 has its centre by both axes of the plane, or by none of them: then it is where the tool stands"},
    {FanucFault::rotation_step,
     "under G91 a setting of the control says whether R is added to the angle before; write G90, or G69 before it"},
    {FanucFault::rotation_again, "another centre, or plane, needs G69 before: controls do not agree on what G68 within "
                                 "G68 turns"},
    {FanucFault::scale_factor, "G51 needs P, 0.01 to 10 with a decimal point, as in P2.; without it controls do not "
                               "agree: P2 is 2 or 0.002"},
    {FanucFault::scale_parts, "G51 takes one P for X, Y and Z; I, J and K are not supported, as arcs would be none"},
    {FanucFault::order, "controls do not agree on this order: G51 stands before G68, G69 before G50, and G51.1 goes "
                        "with neither"},
    {FanucFault::mirror_axes, "G51.1 and G50.1 state those of X, Y and Z whose mirror they begin or end"},
    {FanucFault::local_step, "G52 and G51.1 need G90: controls do not agree on what they are under G91"},
    {FanucFault::origin_word, "G10 L2 takes P1 to P6 for G54 to G59, and L20 P1 to P99 for G54.1 and G154, with axis "
                              "words and without R"},
    {FanucFault::with_turned,
     "this does not go with coordinates that G68, G51 or G51.1 have changed; write G69, G50 or G50.1 before it"},
    {FanucFault::scaled_cycle, "controls do not agree on the levels of a cycle that is scaled; write G50 before it, or "
                               "plain moves"},
    {FanucFault::mirrored_side, "a mirror would change the side of G41 and G42; write G50.1 before them"},
    {FanucFault::place_unstated, "behind G68 the first move states both axes of the plane: controls do not agree on "
                                 "where the other one is"},
    {FanucFault::step_behind_end,
     "behind G69, G50 and G50.1 the first move of an axis is absolute: its place is lost on some controls"},
    {FanucFault::dwell_point, "P with a decimal point is seconds on Haas' controls, more than a minute in a hole here, "
                              "and is not of Fanuc's; write milliseconds without it"},
};
static_assert(has_all(fault_sentences, FanucFault::dwell_point));

} // namespace

const char* describe(FanucFault fault) noexcept {
    return sentence_of(fault_sentences, fault);
}

} // namespace splinefeed
