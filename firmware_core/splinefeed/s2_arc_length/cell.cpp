// SPDX-License-Identifier: MIT
#include "splinefeed/s2_arc_length/cell.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

template <Scalar S>
template <Scalar X>
X Cell<S>::parameter_at(X x) const noexcept {
    const auto fraction = shortened<Ratio<X>>(x);
    auto deviation = converted<Ratio<X>>(inverse[5]);
    for (unsigned i = 5; i-- > 0;) {
        deviation = deviation * fraction + converted<Ratio<X>>(inverse[i]);
    }
    return x + lengthened<X>(deviation * fraction, -2);
}

template <Scalar S>
template <Scalar X>
void Cell<S>::position_at(X x, PerAxis<Position>& out) const noexcept {
    const X w = parameter_at(x);
    for (const unsigned k : indices(axes)) {
        auto offset = converted<X>(power[k][static_cast<unsigned>(degree)]);
        for (int i = degree - 1; i >= 0; --i) {
            offset = offset * w + converted<X>(power[k][static_cast<unsigned>(i)]);
        }
        out[k] = displaced(origin[k], offset, unit_log2);
    }
}

template <Scalar S>
template <Scalar X>
void Cell<S>::direction_at(X x, PerAxis<X>& out) const noexcept {
    const X w = parameter_at(x);
    for (const unsigned k : indices(axes)) {
        X slope{};
        for (int i = degree; i > 0; --i) {
            slope = slope * w + from_integer<X>(i) * converted<X>(power[k][static_cast<unsigned>(i)]);
        }
        out[k] = slope;
    }
    const X sigma = norm(out, axes);
    if (sigma > X{}) {
        divide(out, sigma, axes);
    } else {
        out = {};
    }
}

#define SPLINEFEED_INSTANTIATE(S, X)                                                                                   \
    template X Cell<S>::parameter_at(X) const noexcept;                                                                \
    template void Cell<S>::position_at(X, PerAxis<Position>&) const noexcept;                                          \
    template void Cell<S>::direction_at(X, PerAxis<X>&) const noexcept;
SPLINEFEED_EACH_SAMPLED(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
