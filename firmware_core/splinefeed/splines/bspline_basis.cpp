// SPDX-License-Identifier: MIT
//
// Functions of degree d at span i, N_{i-d} ... N_i, from those of degree d - 1:
//
//   N_j^d = (t - u_j) / (u_{j+d} - u_j) N_j^{d-1} + (u_{j+d+1} - t) / (u_{j+d+1} - u_{j+1}) N_{j+1}^{d-1}
//
// Each function of degree d - 1 is split into a left and a right part, in the ratio (u_{j+d} - t) : (t - u_j). In Fixed
// one part is the difference to the whole, so the sum stays exact. With a_j = h d / (u_{j+d} - u_j) N_j^{d-1} and h the
// length of the span, the derivative by the local parameter is a_j - a_{j+1}; h <= u_{j+d} - u_j because the span lies
// within the support.
#include "splinefeed/splines/bspline_basis.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

namespace {

// Replaces functions of degree d - 1 by those of degree d.
template <Scalar S>
void raise_degree(std::span<const S> knots, unsigned d, std::size_t span, S t, PerDegree<S>& n) noexcept {
    S from_left{};
    for (unsigned r = 0; r < d; ++r) {
        const S lower = knots[span + 1U + r - d];
        const S upper = knots[span + 1U + r];
        const S whole = n[r];
        const S to_right = weight_product(weight_ratio(t - lower, upper - lower), whole);
        if constexpr (std::same_as<S, Fixed>) {
            n[r] = from_left + (whole - to_right);
        } else {
            n[r] = from_left + weight_product(weight_ratio(upper - t, upper - lower), whole);
        }
        from_left = to_right;
    }
    n[d] = from_left;
}

// Derivative by the local parameter of a sum of functions of degree d, given as its d values of the degree below. The
// table n (entries 0 ... d-1) becomes entries 0 ... d.
template <Scalar S>
void differentiate(std::span<const S> knots, unsigned d, std::size_t span, PerDegree<S>& n) noexcept {
    const S length = knots[span + 1U] - knots[span];
    const S factor = from_integer<S>(static_cast<std::int32_t>(d));
    S before{};
    for (unsigned r = 0; r < d; ++r) {
        const S support = knots[span + 1U + r] - knots[span + 1U + r - d];
        const S a = weighted(weight_ratio(length, support), n[r]) * factor;
        n[r] = before - a;
        before = a;
    }
    n[d] = before;
}

} // namespace

template <Scalar S>
std::size_t find_span(std::span<const S> knots, int degree, S t) noexcept {
    const auto k = static_cast<std::size_t>(degree);
    std::size_t low = k; // the span lies in [low, high)
    std::size_t high = knots.size() - k - 1U;
    const S end = knots[high];
    if (!(t < end)) { // the last non-empty span is closed
        while (high > k + 1U && !(knots[high - 1U] < end)) {
            --high;
        }
        return high - 1U;
    }
    while (high - low > 1U) {
        const std::size_t middle = low + (high - low) / 2U;
        if (t < knots[middle]) {
            high = middle;
        } else {
            low = middle;
        }
    }
    while (!(knots[low] < knots[low + 1U])) { // only where t lies before the domain
        ++low;
    }
    return low;
}

template <Scalar S>
PerDegree<S> basis_functions(std::span<const S> knots, int degree, std::size_t span, S t) noexcept {
    PerDegree<S> n{};
    n[0] = weight_one<S>();
    for (unsigned d = 1; d <= static_cast<unsigned>(degree); ++d) {
        raise_degree(knots, d, span, t, n);
    }
    return n;
}

template <Scalar S>
BasisDerivatives<S> basis_derivatives(std::span<const S> knots, int degree, std::size_t span, S t) noexcept {
    BasisDerivatives<S> out{};
    const auto k = static_cast<unsigned>(degree);
    out.value[0] = weight_one<S>();
    for (unsigned d = 1; d <= k; ++d) {
        if (d + 1U == k) { // degree k - 2
            out.second = out.value;
            differentiate(knots, d, span, out.second);
            differentiate(knots, k, span, out.second);
        }
        if (d == k) { // degree k - 1
            out.first = out.value;
            differentiate(knots, d, span, out.first);
        }
        raise_degree(knots, d, span, t, out.value);
    }
    return out;
}

template <Scalar S>
Point<S> weighted_sum(const PerDegree<S>& weights, int degree, bool derivative, std::span<const Point<S>> points,
                      std::size_t first, int axes, std::size_t stride) noexcept {
    const std::size_t count = points.size();
    const auto k = static_cast<std::size_t>(degree);
    const Point<S>& middle = points[(first + k / 2U * stride) % count];
    Point<S> out{};
    for (std::size_t j = 0; j <= k; ++j) {
        const Point<S>& point = points[(first + j * stride) % count];
        for (const unsigned a : indices(axes)) {
            out[a] += weighted(weights[j], point[a] - middle[a]);
        }
    }
    if (!derivative) {
        for (const unsigned a : indices(axes)) {
            out[a] += middle[a];
        }
    }
    return out;
}

template <Scalar S>
CurveJet<S> bspline_curve(std::span<const S> knots, int degree, std::span<const Point<S>> controls, int axes,
                          S t) noexcept {
    CurveJet<S> jet{};
    jet.span = find_span(knots, degree, t);
    jet.span_length = knots[jet.span + 1U] - knots[jet.span];
    const std::size_t first = jet.span - static_cast<std::size_t>(degree);
    const BasisDerivatives<S> basis = basis_derivatives(knots, degree, jet.span, t);
    jet.position = weighted_sum(basis.value, degree, false, controls, first, axes);
    jet.first = weighted_sum(basis.first, degree, true, controls, first, axes);
    jet.second = weighted_sum(basis.second, degree, true, controls, first, axes);
    return jet;
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template std::size_t find_span(std::span<const S>, int, S) noexcept;                                               \
    template PerDegree<S> basis_functions(std::span<const S>, int, std::size_t, S) noexcept;                           \
    template BasisDerivatives<S> basis_derivatives(std::span<const S>, int, std::size_t, S) noexcept;                  \
    template Point<S> weighted_sum(const PerDegree<S>&, int, bool, std::span<const Point<S>>, std::size_t, int,        \
                                   std::size_t) noexcept;                                                              \
    template CurveJet<S> bspline_curve(std::span<const S>, int, std::span<const Point<S>>, int, S) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
