// SPDX-License-Identifier: MIT
#include "splinefeed/s1_blended_path/chain_line.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

template <Scalar S>
bool is_line(const ChainPoints<S>& points, std::uint64_t from, std::uint64_t to, S within, S& off) noexcept {
    const int axes = points.axes();
    PerAxis<S> chord{};
    points.programmed(from, to, chord);
    const S length = norm(chord, axes);
    if (!(length > S{})) {
        return false;
    }
    divide(chord, length, axes);
    const S rounding = line_rounding(length);
    const S most = larger(rounding, within);
    S before{};
    off = S{};
    for (std::uint64_t i = from + 1; i < to; ++i) {
        PerAxis<S> apart{};
        points.programmed(from, i, apart);
        const S along = dot(apart, chord, axes);
        subtract(apart, along, chord, axes);
        off = larger(off, norm(apart, axes));
        if (!(along > before) || off > most) {
            return false;
        }
        before = along;
    }
    off = off > rounding ? off : S{};
    return before < length;
}

#if SPLINEFEED_MAX_DEGREE >= 5
#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template bool is_line(const ChainPoints<S>&, std::uint64_t, std::uint64_t, S, S&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE
#endif

} // namespace splinefeed
