// SPDX-License-Identifier: MIT
// How the core reports bad data: with a Status where a function returns nothing else, with a Result<T> where it returns
// a value. Programming errors are assertions (assertion.hpp). After construction, the functions of the motion itself
// cannot fail.
#pragma once

#include "splinefeed/base/assertion.hpp"

#include <cstdint>
#include <utility>

namespace splinefeed {

/// What is wrong with the data. `describe` gives the sentence for it.
enum class Error : std::uint8_t {
    none,
    axes_out_of_range,
    position_out_of_range,
    move_too_long,
    counts_out_of_range,
    feed_out_of_range,
    velocity_out_of_range,
    acceleration_out_of_range,
    braking_out_of_range,
    travel_end_out_of_range,
    jerk_out_of_range,
    jerk_in_float,
    centripetal_out_of_range,
    chord_error_out_of_range,
    speed_limit_out_of_range,
    sample_period_out_of_range,
    segments_per_sample_invalid,
    period_too_short,
    steps_out_of_range,
    corner_angle_out_of_range,
    tension_out_of_range,
    factor_out_of_range,
    tangent_out_of_range,
    too_few_waypoints,
    degree_out_of_range,
    gap_in_curve,
    arc_invalid,
    curve_invalid,
    tolerance_out_of_range,
    no_room,
    input_finished,
    window_too_small,
    planner_unsuited,
    axes_differ,
    start_elsewhere,
    still_moving,
    too_few_points,
    coincident_points,
    storage_too_small,
    beta1_not_positive,
    beta1_out_of_range,
    beta2_out_of_range,
    closed_chain_overlaps,
    lambda_not_positive,
    lambda_or_mu_out_of_range,
    curvature_sign_invalid,
    system_singular,
    schoenberg_whitney,
    knots_invalid,
    knot_rule_unsuited,
    parameters_invalid,
    even_degree_closed,
    tangent_vanishes,
    result_out_of_range,
    step_times_out_of_range,
    step_tick_out_of_range,
    step_rate_too_high,
    direction_change_too_long,
    // Of programs in G-code (s0_program).
    line_too_long,
    character_invalid,
    number_invalid,
    number_out_of_range,
    comment_not_closed,
    comment_nested,
    word_repeated,
    modal_group_conflict,
    g_code_unknown,
    m_code_unknown,
    not_in_dialect,
    o_word,
    checksum_wrong,
    grbl_command_unsupported,
    polar_unsupported,
    cutter_radius_unsupported,
    thread_unsupported,
    lathe_unsupported,
    tapping_unsupported,
    boring_unsupported,
    feed_per_revolution_unsupported,
    surface_speed_unsupported,
    plane_unsupported,
    tool_offset_sum_unsupported,
    spindle_orientation_unsupported,
    analog_output_unsupported,
    modal_state_unsupported,
    subprogram_unsupported,
    user_code_unsupported,
    firmware_retraction_unsupported,
    bed_levelling_unsupported,
    expression_unsupported,
    expression_too_deep,
    bracket_missing,
    operator_unknown,
    function_unknown,
    atan_needs_two,
    division_by_zero,
    power_invalid,
    root_of_negative,
    logarithm_argument,
    arc_function_argument,
    parameter_name_invalid,
    parameter_out_of_range,
    parameter_unset,
    parameter_read_only,
    parameter_storage_full,
    too_many_assignments,
    assignment_invalid,
    axis_missing,
    axis_word_unused,
    axis_words_twice,
    axis_words_missing,
    word_unused,
    integer_needed,
    count_out_of_range,
    dwell_invalid,
    feed_missing,
    inverse_feed_missing,
    inverse_feed_cycle,
    feed_negative,
    speed_negative,
    tool_unknown,
    tool_table_missing,
    g53_unsuited,
    g10_invalid,
    g92_axes_missing,
    arc_centre_missing,
    arc_centre_and_radius,
    arc_offset_unused,
    arc_radius_zero,
    arc_radius_too_small,
    arc_radius_mismatch,
    arc_end_is_start,
    arc_turns_invalid,
    arc_axes_unsuited,
    cycle_depth_missing,
    cycle_radius_missing,
    cycle_below_depth,
    cycle_peck_invalid,
    cycle_dwell_missing,
    cycle_repeats_invalid,
    cycle_axis_word,
    cycle_spindle_stopped,
    spline_plane,
    spline_axis_word,
    spline_offset_missing,
    spline_end_missing,
    nurbs_word,
    nurbs_weight_invalid,
    nurbs_order_invalid,
    nurbs_too_few_points,
    nurbs_not_begun,
    nurbs_not_ended,
    probe_too_short,
    probe_inverse_time,
    input_word_invalid,
    block_pending,
};

/// One sentence: what is wrong, and which values are right.
[[nodiscard]] const char* describe(Error error) noexcept;

/// The part of it that is about G-code.
[[nodiscard]] const char* describe_program_error(Error error) noexcept;

/// Success, or the error.
class [[nodiscard]] Status {
public:
    constexpr Status() noexcept = default;
    constexpr Status(Error error) noexcept : error_(error) {} // NOLINT(google-explicit-constructor): `return Error::x;`
    [[nodiscard]] constexpr bool ok() const noexcept { return error_ == Error::none; }
    [[nodiscard]] constexpr Error error() const noexcept { return error_; }

private:
    Error error_ = Error::none;
};

/// A value, or the error. The members have the names of std::expected, which C++20 does not have.
template <class T>
class [[nodiscard]] Result {
public:
    constexpr Result(T value) noexcept : value_(std::move(value)) {} // NOLINT(google-explicit-constructor)
    constexpr Result(Error error) noexcept : error_(error) {}        // NOLINT(google-explicit-constructor)
    [[nodiscard]] constexpr bool has_value() const noexcept { return error_ == Error::none; }
    [[nodiscard]] constexpr Error error() const noexcept { return error_; }
    /// The value. A temporary Result returns it by value, because a reference into the temporary would dangle. @pre
    /// has_value(); otherwise the result is T{}
    [[nodiscard]] constexpr const T& value() const& noexcept {
        SPLINEFEED_ASSERT(has_value());
        return value_;
    }
    [[nodiscard]] constexpr T value() && noexcept {
        SPLINEFEED_ASSERT(has_value());
        return std::move(value_);
    }
    constexpr const T& operator*() const& noexcept { return value(); }
    constexpr T operator*() && noexcept { return std::move(*this).value(); }
    constexpr const T* operator->() const noexcept { return &value(); }
    constexpr T& operator*() & noexcept {
        SPLINEFEED_ASSERT(has_value());
        return value_;
    }
    constexpr T* operator->() noexcept { return &**this; }

private:
    T value_{};
    Error error_ = Error::none;
};

/// The answer of a stage when it is asked for its next item.
enum class Pull : std::uint8_t {
    item,     ///< one item was written
    starved,  ///< none now: push more waypoints, or finish the input
    held,     ///< none now: the machine stands until it is resumed (only FeedPlan and the stages after it)
    finished, ///< none, and there will be no more
    busy,     ///< none yet: the budget of work is spent; call again (only with a WorkBudget)
};

} // namespace splinefeed
