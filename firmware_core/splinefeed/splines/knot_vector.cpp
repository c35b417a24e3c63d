// SPDX-License-Identifier: MIT
#include "splinefeed/splines/knot_vector.hpp"

#include "splinefeed/base/capacity.hpp"
#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/splines/point_list.hpp"

namespace splinefeed {

namespace {

template <Scalar S>
S whole(std::size_t value) noexcept {
    return from_integer<S>(static_cast<std::int32_t>(value));
}

template <Scalar S>
bool finite(S value) noexcept {
    return within(value, largest<S>());
}

template <Scalar S>
Status check_parameters(std::span<const S> parameters, S last) noexcept {
    if (!finite(last) || parameters.front() != S{}) {
        return Error::parameters_invalid;
    }
    if constexpr (std::same_as<S, Fixed>) {
        if (last > from_integer<S>(1 << 26)) { // the mean of 9 parameters of up to four periods is summed
            return Error::parameters_invalid;
        }
    }
    for (std::size_t i = 1; i < parameters.size(); ++i) {
        if (!(parameters[i] > parameters[i - 1U])) {
            return Error::parameters_invalid;
        }
    }
    return {};
}

/// The parameters of a closed curve, continued periodically to both sides.
template <Scalar S>
struct PeriodicParameters {
    std::span<const S> parameters;
    S period;
    S operator()(std::ptrdiff_t i) const noexcept {
        const auto count = static_cast<std::ptrdiff_t>(parameters.size());
        std::ptrdiff_t turns = i / count;
        if (turns * count > i) {
            --turns;
        }
        return parameters[static_cast<std::size_t>(i - turns * count)] +
               from_integer<S>(static_cast<std::int32_t>(turns)) * period;
    }
};

/// Knot j of a closed rule before it is taken modulo the period; increasing in j.
template <Scalar S>
S closed_knot(KnotRule rule, const PeriodicParameters<S>& t, int degree, std::ptrdiff_t j) noexcept {
    switch (rule) {
    case KnotRule::uniform:
        return t.period * from_integer<S>(static_cast<std::int32_t>(j)) / whole<S>(t.parameters.size());
    case KnotRule::average: {
        S sum{};
        for (std::ptrdiff_t i = j; i < j + degree; ++i) {
            sum += t(i);
        }
        return sum / from_integer<S>(degree);
    }
    case KnotRule::midpoints: return scale2(t(j) + t(j + 1), -1);
    case KnotRule::params:
    case KnotRule::average_tangents: break;
    }
    return t(j);
}

/// @param inner  number of knots between the ends
bool suits_open(KnotRule rule, std::size_t parameters, int degree, bool end_derivatives, std::size_t inner) noexcept {
    switch (rule) {
    case KnotRule::uniform: return true;
    case KnotRule::average: return !end_derivatives;
    case KnotRule::average_tangents: return end_derivatives && degree >= 2;
    case KnotRule::params: return inner == parameters - 2U;
    case KnotRule::midpoints: break;
    }
    return false;
}

} // namespace

template <Scalar S>
Status open_knots(KnotRule rule, std::span<const S> parameters, int degree, bool end_derivatives,
                  std::span<S> knots) noexcept {
    if (degree < 1 || degree > max_degree) {
        return Error::degree_out_of_range;
    }
    const auto k = static_cast<std::size_t>(degree);
    const std::size_t controls = open_control_count(parameters.size(), end_derivatives);
    if (parameters.size() < 2 || controls < k + 1U) {
        return Error::too_few_points;
    }
    if (knots.size() < open_knot_count(controls, degree)) {
        return Error::storage_too_small;
    }
    const S last = parameters.back();
    if (const Status status = check_parameters(parameters, last); !status.ok()) {
        return status;
    }
    const std::size_t inner = controls - k - 1U;
    if (!suits_open(rule, parameters.size(), degree, end_derivatives, inner)) {
        return Error::knot_rule_unsuited;
    }
    for (std::size_t i = 0; i <= k; ++i) {
        knots[i] = S{};
        knots[controls + i] = last;
    }
    // The first of the averaged parameters: t_1, or t_0 with end derivatives, each of which counts like a point.
    const std::size_t first = end_derivatives ? 0U : 1U;
    for (std::size_t j = 0; j < inner; ++j) {
        S& knot = knots[k + 1U + j];
        if (rule == KnotRule::uniform) {
            knot = last * whole<S>(j + 1U) / whole<S>(inner + 1U);
            if constexpr (std::same_as<S, Fixed>) { // the product would not fit
                knot = last / whole<S>(inner + 1U) * whole<S>(j + 1U);
            }
        } else if (rule == KnotRule::params) {
            knot = parameters[j + 1U];
        } else {
            S sum{};
            for (std::size_t i = 0; i < k; ++i) {
                sum += parameters[first + j + i];
            }
            knot = sum / from_integer<S>(degree);
        }
    }
    return {};
}

template <Scalar S>
Status closed_knots(KnotRule rule, std::span<const S> parameters, int degree, S period, std::span<S> knots) noexcept {
    if (degree < 1 || degree > max_degree) {
        return Error::degree_out_of_range;
    }
    const std::size_t count = parameters.size();
    if (count < 3) {
        return Error::too_few_points;
    }
    if (knots.size() < closed_knot_count(count, degree)) {
        return Error::storage_too_small;
    }
    if (const Status status = check_parameters(parameters, period); !status.ok()) {
        return status;
    }
    if (!(parameters.back() < period)) {
        return Error::parameters_invalid;
    }
    if (rule == KnotRule::average_tangents) {
        return Error::knot_rule_unsuited;
    }
    const PeriodicParameters<S> t{parameters, period};
    std::ptrdiff_t first = 0; // the knot with the smallest value that is not below 0
    while (!(closed_knot(rule, t, degree, first - 1) < S{})) {
        --first;
    }
    const auto k = static_cast<std::size_t>(degree);
    for (std::size_t i = 0; i < count; ++i) {
        knots[k + i] = closed_knot(rule, t, degree, first + static_cast<std::ptrdiff_t>(i));
    }
    for (std::size_t i = k + count; i < count + 2U * k + 1U; ++i) {
        knots[i] = knots[i - count] + period;
    }
    for (std::size_t i = k; i > 0; --i) {
        knots[i - 1U] = knots[i - 1U + count] - period;
    }
    return {};
}

template <Scalar S>
Status check_knots(std::span<const S> knots, int degree) noexcept {
    if (degree < 1 || degree > max_degree) {
        return Error::degree_out_of_range;
    }
    const auto k = static_cast<std::size_t>(degree);
    if (knots.size() < 2U * k + 2U || !finite(knots[0])) {
        return Error::knots_invalid;
    }
    for (std::size_t i = 1; i < knots.size(); ++i) {
        if (!finite(knots[i]) || !(knots[i] >= knots[i - 1U])) {
            return Error::knots_invalid;
        }
        if (i > k && knots[i] == knots[i - k - 1U]) { // k + 2 equal ones
            return Error::knots_invalid;
        }
    }
    if constexpr (std::same_as<S, Fixed>) { // differences must fit
        if (knots.front() < from_integer<S>(-(1 << 29)) || knots.back() > from_integer<S>(1 << 29)) {
            return Error::knots_invalid;
        }
    }
    return knots[k] < knots[knots.size() - k - 1U] ? Status{} : Status{Error::knots_invalid};
}

template <Scalar S>
Status check_closed_knots(std::span<const S> knots, int degree) noexcept {
    if (const Status status = check_knots(knots, degree); !status.ok()) {
        return status;
    }
    const auto k = static_cast<std::size_t>(degree);
    const std::size_t count = knots.size() - 2U * k - 1U;
    const S period = knots[k + count] - knots[k];
    const S tolerance = closed_knot_tolerance(period);
    for (std::size_t i = 0; i + count < knots.size(); ++i) {
        if (!(absolute(knots[i + count] - knots[i] - period) <= tolerance)) {
            return Error::knots_invalid;
        }
    }
    return {};
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template Status open_knots(KnotRule, std::span<const S>, int, bool, std::span<S>) noexcept;                        \
    template Status closed_knots(KnotRule, std::span<const S>, int, S, std::span<S>) noexcept;                         \
    template Status check_knots(std::span<const S>, int) noexcept;                                                     \
    template Status check_closed_knots(std::span<const S>, int) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
