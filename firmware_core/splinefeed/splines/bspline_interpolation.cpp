// SPDX-License-Identifier: MIT
//
// Row of point i: sum_j N_j(t_i) d_j = P_i, (4). At a clamped end N_0 = 1, and the derivative of the first span gives k
// (d_1 - d_0) / (u_{k+1} - u_1) = D. With d_0 = P_0 known this is a row of its own, d_1 = P_0 + D (u_{k+1} - u_1) / k.
// So every row sums to 1 and the system stays totally positive.
#include "splinefeed/splines/bspline_interpolation.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/splines/bspline_basis.hpp"

namespace splinefeed {

template <Scalar S>
Status BsplineInterpolation<S>::prepare(const InterpolationKind& kind, std::span<const S> parameters,
                                        std::span<const S> knots, std::span<S> entries,
                                        std::span<std::uint8_t> interchanges) noexcept {
    kind_ = kind;
    points_ = parameters.size();
    shift_ = 0;
    slack_ = S{};
    if (kind.degree < 1 || kind.degree > max_degree || (kind.end_derivatives && (kind.closed || kind.degree < 2))) {
        return Error::degree_out_of_range;
    }
    const auto k = static_cast<std::size_t>(kind.degree);
    if (points_ < (kind.closed ? 3U : 2U) || (!kind.closed && kind.controls(points_) < k + 1U)) {
        return Error::too_few_points;
    }
    const BandShape shape = kind.band(points_);
    if (entries.size() < shape.entries() || interchanges.size() < shape.interchanges()) {
        return Error::storage_too_small;
    }
    if (knots.size() != kind.knots(points_)) {
        return Error::knots_invalid;
    }
    const Status status = kind.closed ? check_closed_knots(knots, kind.degree) : check_knots(knots, kind.degree);
    if (!status.ok()) {
        return status;
    }
    knots_ = knots;
    const S domain_end = knots[knots.size() - k - 1U];
    if (kind.closed && absolute(knots[k]) > scale2(domain_end - knots[k], 2)) {
        return Error::knots_invalid;
    }
    for (std::size_t i = 0; i < points_; ++i) {
        // A closed curve starts anywhere in its period: only the differences of its parameters are limited.
        const bool inside = kind.closed ? parameters[i] - parameters[0] < domain_end - knots[k] &&
                                              absolute(parameters[i]) <= scale2(domain_end - knots[k], 2)
                                        : knots[k] <= parameters[i] && parameters[i] <= domain_end;
        if (!inside || (i > 0 && !(parameters[i] > parameters[i - 1U]))) {
            return Error::parameters_invalid;
        }
    }
    system_ = BandedSystem<S>(shape, entries, interchanges);
    return kind.closed ? prepare_closed(parameters) : prepare_open(parameters);
}

template <Scalar S>
Status BsplineInterpolation<S>::prepare_open(std::span<const S> parameters) noexcept {
    const auto k = static_cast<std::size_t>(kind_.degree);
    const std::size_t last = points_ - 1U;
    const std::size_t controls = kind_.controls(points_);
    // At an end a basis function may be 1 with t on its first (last) knot; everywhere else t lies inside the support.
    bool limited = false;
    for (std::size_t i = 0; i < controls; ++i) {
        const std::size_t lead = kind_.end_derivatives ? 1U : 0U;
        const std::size_t point = i < lead ? 0U : i - lead < last ? i - lead : last;
        const S t = parameters[point];
        const S below = t - knots_[i];
        const S above = knots_[i + k + 1U] - t;
        if ((i == 0 && below == S{} && knots_[0] == knots_[k] && above > S{}) ||
            (i + 1U == controls && above == S{} && knots_[controls] == knots_[controls + k] && below > S{})) {
            continue;
        }
        if (!(below > S{}) || !(above > S{})) {
            // A derivative at a clamped end: the second function starts there, and t_0 stands for both.
            const bool derivative = kind_.end_derivatives && ((i == 1U && point == 0U && above > S{}) ||
                                                              (i + 2U == controls && point == last && below > S{}));
            if (!derivative) {
                return Error::schoenberg_whitney;
            }
            continue;
        }
        const S nearest = smaller(below, above);
        slack_ = limited ? smaller(slack_, nearest) : nearest;
        limited = true;
    }
    if (kind_.end_derivatives) { // a derivative at an end needs a clamped end, and d_0 as the first row
        const bool clamped = knots_[0] == knots_[k] && knots_[controls] == knots_[controls + k] &&
                             parameters[0] == knots_[k] && parameters[last] == knots_[controls];
        if (!clamped) {
            return Error::knots_invalid;
        }
        system_.add(1U, 1U, weight_one<S>());
        system_.add(controls - 2U, controls - 2U, weight_one<S>());
    }
    for (std::size_t i = 0; i <= last; ++i) {
        const S t = parameters[i];
        const std::size_t span = find_span(knots_, kind_.degree, t);
        const PerDegree<S> row = basis_functions(knots_, kind_.degree, span, t);
        for (std::size_t j = 0; j <= k; ++j) {
            if (row[j] != S{}) {
                system_.add(slot(i), span - k + j, row[j]);
            }
        }
    }
    return system_.factor();
}

namespace {

/// The knots of a closed curve, which repeat.
template <Scalar S>
struct Period {
    std::span<const S> knots;
    std::size_t points;
    std::size_t degree;
    S start;
    S length;

    /// A parameter in the domain of the knots.
    [[nodiscard]] S inside(S t) const noexcept {
        while (t < start) {
            t += length;
        }
        while (!(t < start + length)) {
            t -= length;
        }
        return t;
    }

    /// Least distance of a parameter from an end of its basis function, where that of point i is `first` + i. 0: one
    /// lies beyond.
    [[nodiscard]] S least_support(std::span<const S> parameters, std::size_t first) const noexcept {
        S least{};
        for (std::size_t i = 0; i < points; ++i) {
            const S t = inside(parameters[i]);
            std::size_t control = first + i; // its support is knots[control] ... knots[control + degree + 1]
            S turns = t < inside(parameters[0]) ? length : S{}; // in the next period
            while (control >= points) {
                control -= points;
                turns -= length;
            }
            const S below = t + turns - knots[control];
            const S above = knots[control + degree + 1U] - t - turns;
            const S nearest = smaller(below, above);
            if (!(nearest > S{})) {
                return S{};
            }
            least = i == 0 ? nearest : smaller(least, nearest);
        }
        return least;
    }
};

} // namespace

template <Scalar S>
Status BsplineInterpolation<S>::prepare_closed(std::span<const S> parameters) noexcept {
    const auto k = static_cast<std::size_t>(kind_.degree);
    const Period<S> period{knots_, points_, k, knots_[k], knots_[k + points_] - knots_[k]};
    if (kind_.degree % 2 == 0 && points_ % 2U == 0) {
        bool all_at_knots = true;
        for (std::size_t i = 0; i < points_ && all_at_knots; ++i) {
            const S t = period.inside(parameters[i]);
            const std::size_t span = find_span(knots_, kind_.degree, t);
            all_at_knots = smaller(t - knots_[span], knots_[span + 1U] - t) <= closed_knot_tolerance(period.length);
        }
        if (all_at_knots) {
            return Error::even_degree_closed;
        }
    }
    // The span of point i without taking it modulo the period: it increases with i.
    const std::size_t first_span = find_span(knots_, kind_.degree, period.inside(parameters[0]));
    slack_ = S{};
    for (std::size_t candidate = first_span - k; candidate <= first_span; ++candidate) {
        if (const S least = period.least_support(parameters, candidate); least > slack_) {
            slack_ = least;
            shift_ = candidate % points_;
        }
    }
    if (!(slack_ > S{})) {
        return Error::schoenberg_whitney;
    }
    for (std::size_t i = 0; i < points_; ++i) {
        const S t = period.inside(parameters[i]);
        const std::size_t span = find_span(knots_, kind_.degree, t);
        const PerDegree<S> row = basis_functions(knots_, kind_.degree, span, t);
        for (std::size_t j = 0; j <= k; ++j) {
            if (row[j] != S{}) {
                system_.add(slot(i), (span - k + j) % points_, row[j]);
            }
        }
    }
    return system_.factor();
}

template <Scalar S>
std::size_t BsplineInterpolation<S>::slot(std::size_t point) const noexcept {
    if (kind_.closed) {
        return (point + shift_) % points_;
    }
    if (!kind_.end_derivatives || point == 0) {
        return point;
    }
    return point + 1U < points_ ? point + 1U : point + 2U;
}

template <Scalar S>
Point<S> BsplineInterpolation<S>::derivative_value(const Point<S>& end_point, const Point<S>& derivative, int axes,
                                                   bool at_end) const noexcept {
    const auto k = static_cast<std::size_t>(kind_.degree);
    const std::size_t controls = kind_.controls(points_);
    const S reach = at_end ? knots_[controls - 1U] - knots_[controls + k - 1U] : knots_[k + 1U] - knots_[1];
    Point<S> value{};
    for (const unsigned a : indices(axes)) {
        value[a] = end_point[a] + derivative[a] * reach / from_integer<S>(kind_.degree);
    }
    return value;
}

template <Scalar S>
Status BsplineInterpolation<S>::interpolate(std::span<const Point<S>> points, const EndDerivatives<S>* ends, int axes,
                                            std::span<Point<S>> controls) const noexcept {
    const std::size_t count = kind_.controls(points_);
    if (controls.size() < count) {
        return Error::storage_too_small;
    }
    SPLINEFEED_ASSERT(points.size() == points_ && (ends != nullptr) == kind_.end_derivatives);
    for (std::size_t i = 0; i < points_; ++i) {
        controls[slot(i)] = points[i];
    }
    if (kind_.end_derivatives) {
        if constexpr (std::same_as<S, Fixed>) {
            const S period = knots_[count] - knots_[0];
            for (const unsigned a : indices(axes)) {
                const S size = larger(absolute(ends->start[a]), absolute(ends->end[a]));
                if (quotient_or_max(from_integer<S>(1 << 28), period) <= size) {
                    return Error::result_out_of_range;
                }
            }
        }
        controls[1] = derivative_value(points.front(), ends->start, axes, false);
        controls[count - 2U] = derivative_value(points.back(), ends->end, axes, true);
    }
    return system_.solve(controls.first(count), axes);
}

SPLINEFEED_INSTANTIATE_CLASS(BsplineInterpolation)

} // namespace splinefeed
