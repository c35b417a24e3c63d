// SPDX-License-Identifier: MIT
#include "splinefeed/s1_curve/jet.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

namespace {

template <Scalar S>
S between(S a, S b, S u) noexcept {
    return a + u * (b - a);
}

} // namespace

template <Scalar S>
void evaluate(const CurveSegment<S>& segment, S u, Jet<S>& out) noexcept {
    const auto n = static_cast<unsigned>(segment.degree);
    const S degree = from_integer<S>(static_cast<std::int32_t>(n));
    const S degree2 = from_integer<S>(static_cast<std::int32_t>(n * (n - 1)));
    for (const unsigned k : indices(segment.axes)) {
        const PerDegree<S>& b = segment.control[k];
        // The last three points of the construction hold the value and both derivatives.
        S p0 = b[0];
        S p1 = b[1];
        S p2{};
        if (n == 3) { // the common case, without a loop
            p0 = between(b[0], b[1], u);
            p1 = between(b[1], b[2], u);
            p2 = between(b[2], b[3], u);
        } else if (n > 1) {
            PerDegree<S> row = b;
            for (unsigned step = 1; step + 2 <= n; ++step) {
                for (unsigned i = 0; i + step <= n; ++i) {
                    row[i] = between(row[i], row[i + 1], u);
                }
            }
            p0 = row[0];
            p1 = row[1];
            p2 = row[2];
        }
        if (n > 1) {
            const S d0 = p1 - p0;
            const S d1 = p2 - p1;
            out.second[k] = (d1 - d0) * degree2;
            p0 = p0 + u * d0;
            p1 = p1 + u * d1;
        } else {
            out.second[k] = S{};
        }
        out.first[k] = (p1 - p0) * degree;
        out.position[k] = between(p0, p1, u);
    }
}

#define SPLINEFEED_INSTANTIATE(S) template void evaluate<S>(const CurveSegment<S>&, S, Jet<S>&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
