// SPDX-License-Identifier: MIT
#include "splinefeed/s1_blended_path/chain_line.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

template <Scalar S>
S off_line(const ChainPoints<S>& points, std::uint64_t from, std::uint64_t to, PerAxis<S>& chord) noexcept {
    points.programmed(from, to, chord);
    const S length = norm(chord, points.axes());
    if (!(length > S{})) {
        return largest<S>();
    }
    S off{};
    S before{};
    for (std::uint64_t i = from + 1; i < to; ++i) {
        PerAxis<S> apart{};
        points.programmed(from, i, apart);
        S along{};
        for (const unsigned k : indices(points.axes())) {
            along += apart[k] * (chord[k] / length);
        }
        if (!(along > before)) {
            return largest<S>();
        }
        before = along;
        for (const unsigned k : indices(points.axes())) {
            apart[k] = apart[k] - along * (chord[k] / length);
        }
        off = larger(off, norm(apart, points.axes()));
    }
    return before < length ? off : largest<S>();
}

#if SPLINEFEED_MAX_DEGREE >= 5
#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template S off_line(const ChainPoints<S>&, std::uint64_t, std::uint64_t, PerAxis<S>&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE
#endif

} // namespace splinefeed
