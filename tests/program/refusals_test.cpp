// SPDX-License-Identifier: MIT
// Every wrong use of a word is refused, at the word, and nothing of its block happens.
#include "support/gcode.hpp"

using namespace splinefeed_test;

namespace {

struct Case {
    const char* line;
    ProgramError error;
    int column; // 0: the block
};

} // namespace

TEST_CASE("what does not belong together is refused", "[program][refusals]") {
    const Case cases[] = {
        {"X1", ProgramError::axis_word_unused, 0},
        {"G80 X1", ProgramError::axis_word_unused, 1},
        {"G4 X1", ProgramError::axis_word_unused, 0},
        {"M2 X1", ProgramError::axis_word_unused, 0},
        {"G1 X1 U2", ProgramError::axis_missing, 7},
        {"G1 G92 X1", ProgramError::axis_words_twice, 1},
        {"G28 G1 X1", ProgramError::axis_words_twice, 5},
        {"G1 G43.1 Z1", ProgramError::axis_words_twice, 1},
        {"G38.2 F10", ProgramError::axis_words_missing, 1},
        {"G81 R1", ProgramError::axis_words_missing, 1},
        {"G92", ProgramError::g92_axes_missing, 1},
        {"G52", ProgramError::g92_axes_missing, 1},
        {"G43.1", ProgramError::g92_axes_missing, 1},
        {"G1 X1 K2", ProgramError::word_unused, 7},
        {"G1 X1 P2", ProgramError::word_unused, 7},
        {"G61 P1", ProgramError::word_unused, 5},
        {"G1 X1 D3", ProgramError::word_unused, 7},
        {"G1 X1 H3", ProgramError::word_unused, 7},
        {"G81 X1 Z-1 R1 P2", ProgramError::word_unused, 15},
        {"G1 X1 L2", ProgramError::word_unused, 7},
        {"G4", ProgramError::dwell_invalid, 1},
        {"G4 P-1", ProgramError::dwell_invalid, 1},
        {"G1 X1", ProgramError::feed_missing, 1},
        {"G95 F1 G1 X1", ProgramError::spindle_stands, 8},
        {"G95 F1 S0.001 G1 X1", ProgramError::feed_out_of_range, 15},
        {"G95 F1 S10 G38.2 X1", ProgramError::probe_inverse_time, 12},
        {"G33 Z1 K1", ProgramError::spindle_stands, 1},
        {"G33 Z1 S9 M3", ProgramError::turn_way_missing, 1},
        {"G33 Z1 K1 F2 S9 M3", ProgramError::turn_way_missing, 1},
        {"G33 Z1 K0 S9 M3", ProgramError::turn_way_missing, 1},
        {"G33 Z1 K9999999 S9999999 M3", ProgramError::feed_out_of_range, 1},
        {"G33.1 Z1 K1 I0.5 S9 M3", ProgramError::turn_way_missing, 1},
        {"G33.1 Z70000 K1 S9 M3", ProgramError::move_too_long, 7},
        {"G84 Z-1 R1 F9", ProgramError::tapping_direction, 1},
        {"G84 Z-1 R1 F9 M4 S9", ProgramError::tapping_direction, 1},
        {"G74 Z-1 R1 F9 M3 S9", ProgramError::tapping_direction, 1},
        {"G84 Z-1 R1 F9 M3 S9 P-1", ProgramError::cycle_dwell_missing, 21},
        {"G1 X1 F0", ProgramError::feed_missing, 1},
        {"F-3", ProgramError::feed_negative, 1},
        {"F0.001", ProgramError::feed_out_of_range, 1},
        {"S-5", ProgramError::speed_negative, 1},
        {"T-1", ProgramError::tool_unknown, 1},
        {"T1.5", ProgramError::tool_unknown, 1},
        {"G43 H33", ProgramError::tool_unknown, 5},
        {"M61", ProgramError::tool_unknown, 0},
        {"G64 P-1", ProgramError::tolerance_out_of_range, 5},
        {"G64 P101", ProgramError::tolerance_out_of_range, 5},
        {"G53 X1", ProgramError::g53_unsuited, 1},
        {"G0 G91 G53 X1", ProgramError::g53_unsuited, 8},
        {"G10 L1 P1 Z5", ProgramError::g10_tool_table, 5},
        {"G10 L10 P1 Z5 R2 Q3", ProgramError::g10_tool_table, 5},
        {"G10 P1 X5 L11", ProgramError::g10_tool_table, 11},
        {"G10 L3 P1 X1", ProgramError::g10_invalid, 1},
        {"G10 L2 X1", ProgramError::g10_invalid, 1},
        {"G10 L2 P10 X1", ProgramError::g10_invalid, 1},
        {"G10 L20 P1 R3", ProgramError::g10_invalid, 1},
        {"G10 L2 P1 X2000000", ProgramError::position_out_of_range, 1},
        {"G0 X1100000", ProgramError::position_out_of_range, 4},
        {"G0 X70000", ProgramError::move_too_long, 4},
        {"F1 G2 I10450", ProgramError::move_too_long, 4},
        {"F1 G3 I-1000 P11", ProgramError::move_too_long, 4},
        {"F1 G18 G96 S9 D99 M3 G2 K911000", ProgramError::move_too_long, 22},
        {"G0 X99999999", ProgramError::position_out_of_range, 4},
        {"M62", ProgramError::count_out_of_range, 1},
        {"M64 P64", ProgramError::count_out_of_range, 5},
        {"M65 P0.5", ProgramError::integer_needed, 5},
        {"M66", ProgramError::input_word_invalid, 1},
        {"M66 P1 E1", ProgramError::input_word_invalid, 1},
        {"M66 P1 L1", ProgramError::input_word_invalid, 1},
        {"M66 E1 L1 Q1", ProgramError::input_word_invalid, 1},
        {"G2 X1 Y1 F100", ProgramError::arc_centre_missing, 1},
        {"G2 X1 R1 I1 F100", ProgramError::arc_centre_and_radius, 7},
        {"G2 X1 I1 K1 F100", ProgramError::arc_offset_unused, 10},
        {"G90.1 G2 X1 I1 F100", ProgramError::arc_centre_missing, 13},
        {"G2 X1 I0 J0 F100", ProgramError::arc_radius_zero, 7},
        {"G2 X1 I1 F100", ProgramError::arc_radius_zero, 7},
        {"G2 X1 I3 F100", ProgramError::arc_radius_mismatch, 7},
        {"G3 X1 Y1 R0.1 F100", ProgramError::arc_radius_too_small, 10},
        {"G2 R1 F100", ProgramError::arc_end_is_start, 4},
        {"G2 X0 Y0 R1 F100", ProgramError::arc_end_is_start, 10},
        {"G2 X2 I1 P2.5 F100", ProgramError::arc_turns_invalid, 10},
        {"G2 X2 I1 P0 F100", ProgramError::arc_turns_invalid, 10},
        {"G81 X1 R1 F100", ProgramError::cycle_depth_missing, 1},
        {"G81 X1 Z-1 F100", ProgramError::cycle_radius_missing, 1},
        {"G81 X1 Z1 R0 F100", ProgramError::cycle_below_depth, 11},
        {"G83 X1 Z-1 R1 F100", ProgramError::cycle_peck_invalid, 12},
        {"G73 X1 Z-1 R1 Q0 F100", ProgramError::cycle_peck_invalid, 15},
        {"G83 X1 Z-1 R1 Q0.00001 F100", ProgramError::cycle_peck_invalid, 15},
        {"G82 X1 Z-1 R1 F100", ProgramError::cycle_dwell_missing, 1},
        {"G81 X1 Z-1 R1 L0 F100", ProgramError::cycle_repeats_invalid, 15},
        {"G81 X1 Z-1 R1 L2.5 F100", ProgramError::cycle_repeats_invalid, 15},
        {"G81 X1 A1 Z-1 R1 F100", ProgramError::cycle_axis_word, 1},
        {"G86 X1 Z-1 R1 P1 F100", ProgramError::cycle_spindle_stopped, 1},
        {"G93 G81 X1 Z-1 R1 F100", ProgramError::inverse_feed_cycle, 5},
        {"G93 G1 X1", ProgramError::inverse_feed_missing, 5},
        {"G93 G38.2 X1 F3", ProgramError::probe_inverse_time, 5},
        {"G18 G5 X1 Y1 I1 J1 P1 Q1 F100", ProgramError::spline_plane, 5},
        {"G5 X1 Y1 Z1 I1 J1 P1 Q1 F100", ProgramError::spline_axis_word, 1},
        {"G5 X1 Y1 P1 Q1 F100", ProgramError::spline_offset_missing, 1},
        {"G5 X1 Y1 I1 P1 Q1 F100", ProgramError::spline_offset_missing, 1},
        {"G5 X1 Y1 I1 J1 P1 F100", ProgramError::spline_end_missing, 1},
        {"G5.1 X1 Y1 I0 J0 F100", ProgramError::spline_offset_missing, 12},
        {"G5.2 X1 F100", ProgramError::nurbs_word, 1},
        {"G5.2 X1 Y1 P0 F100", ProgramError::nurbs_weight_invalid, 12},
        {"G5.2 X1 Y1 P100 F100", ProgramError::nurbs_weight_invalid, 12},
        {"G5.2 X1 Y1 L7 F100", ProgramError::nurbs_order_invalid, 12},
        {"G5.3", ProgramError::nurbs_not_begun, 1},
        {"G5.5 F100", ProgramError::axis_words_missing, 1},
        {"G5.5 X1", ProgramError::feed_missing, 1},
        {"G5.5 X1 I2 F100", ProgramError::word_unused, 9},
        {"G5.5 X1 P2 F100", ProgramError::word_unused, 9},
        {"G5.5 X9000 F100", ProgramError::points_too_far, 6},
        {"G93 G5.5 X1 F100", ProgramError::points_inverse_time, 5},
        {"G53 G5.5 X1 F100", ProgramError::g53_unsuited, 1},
        {"G1 G5.5 X1 F100", ProgramError::modal_group_conflict, 4},
        {"G41.1 D1 G5.5 X1 F100", ProgramError::cutter_active, 10},
        {"G96 S100 M3 G5.5 X1 F100", ProgramError::surface_speed_unsuited, 13},
        {"G17.1", ProgramError::plane_unsupported, 1},
        {"G76 Z1", ProgramError::spindle_stands, 1},
        {"G71", ProgramError::lathe_unsupported, 1},
        {"G87 Z1", ProgramError::boring_unsupported, 1},
        {"G96", ProgramError::surface_speed_missing, 1},
        {"G43.2 H1", ProgramError::tool_offset_sum_unsupported, 1},
        {"M19 R361", ProgramError::orient_word_invalid, 1},
        {"M19 R-1", ProgramError::orient_word_invalid, 1},
        {"M19 P3", ProgramError::orient_word_invalid, 1},
        {"M19 P0.5", ProgramError::orient_word_invalid, 1},
        {"M19 Q0", ProgramError::orient_word_invalid, 1},
        {"M67 E1", ProgramError::analog_output_invalid, 1},
        {"M68 Q1", ProgramError::analog_output_invalid, 1},
        {"M67 E64 Q1", ProgramError::count_out_of_range, 5},
        {"M70", ProgramError::o_word, 1},
        {"M98 P1", ProgramError::o_word, 1},
        {"M101", ProgramError::user_code_unsupported, 1},
    };
    for (const Case& of : cases) {
        GcodeRun<double> run;
        run.run("G0 X0");
        run.run("G80");
        const WorkOffsets offsets = run.interpreter().offsets();
        const PerAxis<Position> position = run.interpreter().position();
        const BlockStatus status = run.push(of.line);
        CAPTURE(of.line, describe(status.error));
        CHECK(status.error == of.error);
        CHECK(static_cast<int>(status.column) == of.column);
        CHECK(run.interpreter().offsets() == offsets);
        CHECK(run.interpreter().position() == position);
        CHECK(run.interpreter().modal().feed.raw == 0);
        CHECK(run.last("G0 X1") == "rapid 1 0 0"); // and the program can go on
    }
}

TEST_CASE("a NURBS takes nothing else until it is ended", "[program][refusals]") {
    GcodeRun<double> run;
    run.run("F100 G5.2 X1 Y1");
    CHECK(run.push("G1 X2").error == ProgramError::nurbs_not_ended);
    CHECK(run.push("M2").error == ProgramError::nurbs_not_ended);
    CHECK(run.push("G5.3").error == ProgramError::nurbs_too_few_points);
    CHECK(run.push("X3").error == ProgramError::nurbs_word);
    CHECK(run.push("X3 Y3 L4").error == ProgramError::nurbs_order_invalid);
    CHECK(run.push("X3 Y3 P65").error == ProgramError::nurbs_weight_invalid);
    CHECK(run.push("X3 Y3").ok());
    CHECK(run.last("G5.3") == "feed bezier 3 3 0 degree 2");
}

TEST_CASE("every error has a sentence, which names no option of the host", "[program][refusals]") {
    for (int error = 0; error <= static_cast<int>(ProgramError::block_pending); ++error) {
        const std::string sentence = describe(static_cast<ProgramError>(error));
        CAPTURE(error, sentence);
        CHECK(sentence != "unknown error");
        CHECK(sentence.size() > 7);
        CHECK(sentence.find("--") == std::string::npos);
    }
}
