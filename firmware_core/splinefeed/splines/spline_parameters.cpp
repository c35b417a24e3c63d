// SPDX-License-Identifier: MIT
#include "splinefeed/splines/spline_parameters.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"
#include "splinefeed/splines/weight.hpp"

#include <cstddef>

namespace splinefeed {

namespace {

// Differences of coordinates below 2^29 are squared and summed exactly by norm.
template <Scalar S>
bool usable(S coordinate) noexcept {
    if constexpr (std::same_as<S, Fixed>) {
        return absolute(coordinate) < from_integer<S>(1 << 29);
    } else {
        return absolute(coordinate) <= largest<S>(); // false for NaN
    }
}

/// Length of the span from one point to the next, before scaling to the domain.
template <Scalar S>
S span_length(const Point<S>& from, const Point<S>& to, int axes, Parameterization how) noexcept {
    if (how == Parameterization::uniform) {
        return from_integer<S>(1);
    }
    const S length = norm(difference(to, from, axes), axes);
    return how == Parameterization::chordal ? length : square_root(length);
}

template <Scalar S>
Status check_input(std::span<const Point<S>> points, int axes, bool closed, S domain_length,
                   std::size_t room) noexcept {
    if (points.size() < (closed ? 3U : 2U)) {
        return Error::too_few_points;
    }
    if (axes < 1 || axes > max_axes) {
        return Error::axes_out_of_range;
    }
    if (room < points.size()) {
        return Error::storage_too_small;
    }
    if (!(domain_length > S{}) || !usable(domain_length)) {
        return Error::parameters_invalid;
    }
    if constexpr (std::same_as<S, Fixed>) {
        if (domain_length > from_integer<S>(1 << 26)) {
            return Error::parameters_invalid;
        }
    }
    for (const Point<S>& point : points) {
        for (const unsigned k : indices(axes)) {
            if (!usable(point[k])) {
                return Error::position_out_of_range;
            }
        }
    }
    return {};
}

// In Fixed the sum of the spans must fit: the unit is halved as often as the number of spans may double the longest
// one.
template <Scalar S>
int halvings_of(std::span<const Point<S>> points, int axes, Parameterization how, std::size_t spans) noexcept {
    int halvings = 0;
    if constexpr (std::same_as<S, Fixed>) {
        S longest{};
        for (std::size_t i = 0; i < spans; ++i) {
            longest = larger(longest, span_length(points[i], points[(i + 1U) % points.size()], axes, how));
        }
        while (halvings < 40 && scale2(longest, -halvings) >=
                                    from_integer<S>(1 << 29) / from_integer<S>(static_cast<std::int32_t>(spans))) {
            ++halvings;
        }
    }
    return halvings;
}

} // namespace

template <Scalar S>
Status spline_parameters(std::span<const Point<S>> points, int axes, Parameterization how, bool closed, S domain_length,
                         std::span<S> parameters) noexcept {
    const std::size_t count = points.size();
    if (const Status status = check_input(points, axes, closed, domain_length, parameters.size()); !status.ok()) {
        return status;
    }
    const std::size_t spans = closed ? count : count - 1U;
    const int halvings = halvings_of(points, axes, how, spans);
    S sum{};
    for (std::size_t i = 0; i < spans; ++i) {
        S length = span_length(points[i], points[(i + 1U) % count], axes, how);
        if constexpr (std::same_as<S, Fixed>) {
            length = scale2(length, -halvings);
        }
        if (!(length > S{})) {
            return Error::coincident_points;
        }
        parameters[i] = sum;
        sum += length;
    }
    if (!(sum <= largest<S>())) {
        return Error::result_out_of_range;
    }
    for (std::size_t i = 1; i < spans; ++i) {
        parameters[i] = weighted(weight_ratio(parameters[i], sum), domain_length);
        if (!(parameters[i] > parameters[i - 1U])) {
            return Error::coincident_points;
        }
    }
    if (!(parameters[spans - 1U] < domain_length)) {
        return Error::coincident_points;
    }
    if (!closed) {
        parameters[spans] = domain_length;
    }
    return {};
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template Status spline_parameters(std::span<const Point<S>>, int, Parameterization, bool, S, std::span<S>) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
