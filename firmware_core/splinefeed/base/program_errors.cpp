// SPDX-License-Identifier: MIT
// The sentences for errors of programs in G-code; `describe` asks for them.
#include "splinefeed/base/status.hpp"

#include <initializer_list>

namespace splinefeed {

namespace {

const char* describe_refusal(Error error) noexcept {
    switch (error) {
    case Error::cutter_radius_unsupported:
        return "cutter radius compensation is not supported; let the CAM offset the path, and leave G41 and G42 out";
    case Error::thread_unsupported:
        return "motion in step with the spindle (G33, G76) is not supported; cut threads by helical arcs, G2 or G3 "
               "with Z";
    case Error::lathe_unsupported:
        return "lathe words (G7, G70 to G72) are not supported; program radii, and each pass as moves";
    case Error::tapping_unsupported: return "tapping (G74, G84) is not supported; the spindle does not follow the feed";
    case Error::boring_unsupported: return "G87 and G88 are not supported; use G85, G86 or G89, or moves of their own";
    case Error::feed_per_revolution_unsupported:
        return "feed per revolution is not supported; use G94, units per minute, or G93, inverse time";
    case Error::surface_speed_unsupported: return "constant surface speed is not supported; use G97 and S in rpm";
    case Error::plane_unsupported: return "the planes of U, V and W are not supported; use G17, G18 or G19";
    case Error::tool_offset_sum_unsupported: return "added tool offsets are not supported; use G43 H or G43.1";
    case Error::spindle_orientation_unsupported: return "the spindle cannot be oriented; leave M19 out";
    case Error::analog_output_unsupported: return "analog outputs are not supported; use M62 to M65 for digital ones";
    case Error::modal_state_unsupported:
        return "modes cannot be saved and put back by M70 to M73; state the modes that the program needs";
    case Error::subprogram_unsupported: return "M98 and M99 are not supported; use O words, sub and call";
    case Error::user_code_unsupported: return "there are no user codes M100 to M199; --ignore leaves such a word out";
    case Error::firmware_retraction_unsupported:
        return "retraction by the firmware is not supported; let the slicer write E moves";
    case Error::bed_levelling_unsupported: return "bed levelling is not supported; --ignore G29 leaves it out";
    case Error::polar_unsupported: return "polar coordinates (@ and ^) are not supported; write X and Y";
    case Error::grbl_command_unsupported: return "of grbl's $ commands there is $H only";
    case Error::o_word: return "O words need the file; they are read by the host, and not within a block";
    case Error::expression_unsupported: return "parameters and expressions are not built in here; use plain numbers";
    case Error::not_in_dialect: return "this dialect does not have the word; --dialect linuxcnc does";
    default: return nullptr;
    }
}

const char* describe_text(Error error) noexcept {
    switch (error) {
    case Error::line_too_long: return "a line has at most 256 characters";
    case Error::character_invalid: return "this character has no meaning here; a word is a letter and a number";
    case Error::number_invalid: return "a number must follow, such as 12.5, -3 or .5";
    case Error::number_out_of_range: return "a number must lie within +-100000000";
    case Error::comment_not_closed: return "the comment has no ')'";
    case Error::comment_nested: return "a comment cannot hold a '('";
    case Error::word_repeated: return "the letter stands twice; a block has each letter once, other than G and M";
    case Error::modal_group_conflict: return "two words of one group exclude each other; write two blocks";
    case Error::g_code_unknown: return "there is no such G word";
    case Error::m_code_unknown: return "there is no such M word";
    case Error::checksum_wrong: return "the checksum behind * is not that of the line";
    case Error::expression_too_deep: return "brackets are nested more than 10 deep";
    case Error::bracket_missing: return "a bracket [ or ] is missing";
    case Error::operator_unknown: return "an operator or ] must follow: + - * / ** MOD AND OR XOR EQ NE GT GE LT LE";
    case Error::function_unknown:
        return "there is no such function; there are SIN COS TAN ASIN ACOS ATAN SQRT ABS EXP LN ROUND FIX FUP EXISTS";
    case Error::atan_needs_two: return "ATAN takes two values: ATAN[y]/[x]";
    case Error::division_by_zero: return "the divisor is 0";
    case Error::power_invalid: return "a negative number has whole powers only";
    case Error::root_of_negative: return "SQRT takes a number of at least 0";
    case Error::logarithm_argument: return "LN takes a number above 0";
    case Error::arc_function_argument: return "ASIN and ACOS take a number from -1 to 1";
    case Error::parameter_name_invalid: return "a parameter is #1, #[...] or #<name>";
    case Error::parameter_out_of_range: return "the number of a parameter is a whole number from 1 to 5602";
    case Error::parameter_unset: return "the parameter has no value yet; set it first, or ask EXISTS[#<name>]";
    case Error::parameter_read_only: return "the parameter is the control's, and cannot be set";
    case Error::parameter_storage_full: return "the parameter cannot be stored: no room, or its value is out of range";
    case Error::too_many_assignments: return "a block sets at most 16 parameters";
    case Error::assignment_invalid: return "a parameter is set by '=', as in #1 = 2.5";
    default: return nullptr;
    }
}

const char* describe_words(Error error) noexcept {
    switch (error) {
    case Error::axis_missing: return "the machine has no such axis; --ignore leaves the letter out";
    case Error::axis_word_unused: return "no G word uses the axis words; write G0 or G1 before them";
    case Error::axis_words_twice: return "two G words would use the axis words; write two blocks";
    case Error::axis_words_missing: return "this G word needs at least one axis word";
    case Error::word_unused: return "no word of the block uses this letter; leave it out, or add the word that does";
    case Error::integer_needed: return "a whole number is needed here";
    case Error::count_out_of_range: return "P is needed: a whole number from 0 to 63";
    case Error::dwell_invalid: return "a dwell needs P, its seconds, and P is at least 0";
    case Error::feed_missing: return "a feed move needs a feed rate F above 0, in this block or before it";
    case Error::inverse_feed_missing: return "under G93 each feed move needs an F of its own, in 1/min";
    case Error::inverse_feed_cycle: return "canned cycles need G94; under G93 no hole has a feed";
    case Error::feed_negative: return "F must not be negative";
    case Error::speed_negative: return "S must not be negative; the direction is that of M3 or M4";
    case Error::tool_unknown: return "a tool is a whole number from 0, and G43 needs one that is in the tool table";
    case Error::tool_table_missing: return "there is no tool table; give one (--tools), or write G43.1";
    case Error::g53_unsuited: return "G53 needs G0 or G1 in effect, and G90";
    case Error::g10_invalid:
        return "G10 takes L2 or L20 with P0 to P9 for the system (0: the one in effect), and R with L2 only";
    case Error::g92_axes_missing: return "this G word needs at least one axis word, for the axes that it sets";
    case Error::nurbs_word: return "between G5.2 and G5.3 a block has X and Y, P and L, and nothing else";
    case Error::nurbs_weight_invalid:
        return "a weight P is above 0, and within a factor of 64 of the other weights of the curve";
    case Error::nurbs_order_invalid: return "the order L is 3 to 6, and stands in the first block of the curve";
    case Error::nurbs_too_few_points: return "a NURBS needs as many control points as its order L, with its start";
    case Error::nurbs_not_begun: return "G5.3 ends a NURBS; G5.2 begins one";
    case Error::nurbs_not_ended: return "the NURBS is not ended; G5.3 ends it before other words";
    case Error::spline_plane: return "splines lie in the plane of X and Y: select G17";
    case Error::spline_axis_word: return "splines move X and Y only";
    case Error::spline_offset_missing:
        return "I and J, the way to the first control point, are needed, not both 0; after a G5 both may be left out";
    case Error::spline_end_missing: return "G5 needs P and Q, the way from its end to its second control point";
    case Error::probe_too_short: return "a probe move needs an end that is not where the machine stands";
    case Error::probe_inverse_time: return "a probe move needs G94";
    case Error::input_word_invalid:
        return "M66 takes P or E for the input, 0 to 63; L0 to L4 for the wait, L0 with E; and Q above 0 s for L1 to "
               "L4";
    case Error::block_pending: return "the items of the block before have not been taken";
    default: return nullptr;
    }
}

const char* describe_shapes(Error error) noexcept {
    switch (error) {
    case Error::arc_centre_missing:
        return "an arc needs its centre, by the two of I, J, K that lie in its plane, or R; under G90.1 both";
    case Error::arc_centre_and_radius: return "an arc has a centre (I, J, K) or a radius R, not both";
    case Error::arc_offset_unused: return "this letter is across the arc's plane; G17 takes I J, G18 I K, G19 J K";
    case Error::arc_radius_zero: return "the centre lies on an end of the arc, within 0.2 um";
    case Error::arc_radius_too_small: return "R is too small: at least half of the way from the start to the end";
    case Error::arc_radius_mismatch:
        return "the centre is nearer to one end: radii may differ by 0.005 mm or 0.1 %, and at most by 0.5 mm";
    case Error::arc_end_is_start: return "by R an arc cannot end where it starts; give the centre of a whole circle";
    case Error::arc_turns_invalid: return "P, the number of turns, is a whole number from 1 to 10000";
    case Error::arc_axes_unsuited: return "arcs need their two axes, X, Y and Z as the first of the machine's axes";
    case Error::cycle_depth_missing: return "the cycle needs its depth: Z, or the axis across the plane";
    case Error::cycle_radius_missing: return "the cycle needs R, the level where the feed begins";
    case Error::cycle_below_depth: return "R must not be below the depth";
    case Error::cycle_peck_invalid: return "Q, the depth of a peck, is above 0, with at most 100000 pecks a hole";
    case Error::cycle_dwell_missing: return "the cycle needs P, its dwell in seconds, at least 0";
    case Error::cycle_repeats_invalid: return "L, the number of holes, is a whole number from 1 to 100000";
    case Error::cycle_axis_word: return "a canned cycle moves X, Y and Z only";
    case Error::cycle_spindle_stopped: return "G86 stops and starts the spindle: it must turn (M3 or M4)";
    default: return "unknown error";
    }
}

} // namespace

const char* describe_program_error(Error error) noexcept {
    for (const auto describe_part : {describe_refusal, describe_text, describe_words}) {
        if (const char* sentence = describe_part(error); sentence != nullptr) {
            return sentence;
        }
    }
    return describe_shapes(error);
}

} // namespace splinefeed
