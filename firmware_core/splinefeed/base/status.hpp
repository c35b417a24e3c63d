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
};

/// One sentence: what is wrong, and which values are right.
[[nodiscard]] const char* describe(Error error) noexcept;

/// Success, or the error. A room with errors of its own has its own E, an enumeration with `none` for success.
template <class E>
class [[nodiscard]] StatusOf {
public:
    constexpr StatusOf() noexcept = default;
    constexpr StatusOf(E error) noexcept : error_(error) {} // NOLINT(google-explicit-constructor): `return Error::x;`
    [[nodiscard]] constexpr bool ok() const noexcept { return error_ == E::none; }
    [[nodiscard]] constexpr E error() const noexcept { return error_; }

private:
    E error_ = E::none;
};
using Status = StatusOf<Error>;

/// A value, or the error. The members have the names of std::expected, which C++20 does not have.
template <class T, class E = Error>
class [[nodiscard]] Result {
public:
    constexpr Result(T value) noexcept : value_(std::move(value)) {} // NOLINT(google-explicit-constructor)
    constexpr Result(E error) noexcept : error_(error) {}            // NOLINT(google-explicit-constructor)
    [[nodiscard]] constexpr bool has_value() const noexcept { return error_ == E::none; }
    [[nodiscard]] constexpr E error() const noexcept { return error_; }
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
    E error_ = E::none;
};

/// For numbers that are known to the compiler: static_assert(no_error<limits.error()>()). If there is an error, the
/// compiler's message names it.
template <auto error>
[[nodiscard]] consteval bool no_error() noexcept {
    static_assert(error == decltype(error)::none, "the error is the one that this message has behind no_error");
    return true;
}

/// The answer of a stage when it is asked for its next item.
enum class Pull : std::uint8_t {
    item,     ///< one item was written
    starved,  ///< none now: push more waypoints, or finish the input
    held,     ///< none now: the machine stands until it is resumed (only FeedPlan and the stages after it)
    finished, ///< none, and there will be no more
    busy,     ///< none yet: the budget of work is spent; call again (only with a WorkBudget)
};

} // namespace splinefeed
