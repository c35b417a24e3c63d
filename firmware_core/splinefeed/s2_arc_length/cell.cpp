// SPDX-License-Identifier: MIT
#include "splinefeed/s2_arc_length/cell.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

template <Scalar S>
S Cell<S>::parameter_at(S x) const noexcept {
    const auto fraction = shortened<Ratio<S>>(x);
    Ratio<S> deviation = inverse[5];
    for (unsigned i = 5; i-- > 0;) {
        deviation = deviation * fraction + inverse[i];
    }
    return x + lengthened<S>(deviation * fraction, -2);
}

template <Scalar S>
void Cell<S>::position_at(S x, PerAxis<Position>& out) const noexcept {
    const S w = parameter_at(x);
    for (const unsigned k : indices(axes)) {
        S offset = power[k][static_cast<unsigned>(degree)];
        for (int i = degree - 1; i >= 0; --i) {
            offset = offset * w + power[k][static_cast<unsigned>(i)];
        }
        out[k] = displaced(origin[k], offset, unit_log2);
    }
}

template <Scalar S>
void Cell<S>::direction_at(S x, PerAxis<S>& out) const noexcept {
    const S w = parameter_at(x);
    for (const unsigned k : indices(axes)) {
        S slope{};
        for (int i = degree; i > 0; --i) {
            slope = slope * w + from_integer<S>(i) * power[k][static_cast<unsigned>(i)];
        }
        out[k] = slope;
    }
    const S sigma = norm(out, axes);
    for (const unsigned k : indices(axes)) {
        out[k] = sigma > S{} ? out[k] / sigma : S{};
    }
}

#define SPLINEFEED_INSTANTIATE(S) template struct Cell<S>;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
