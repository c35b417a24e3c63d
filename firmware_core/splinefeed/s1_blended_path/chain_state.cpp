// SPDX-License-Identifier: MIT
//
// The moments M (second derivatives) of a cubic spline with the chords D of length l solve
//     l_k / (l_k + l_k+1) M_k-1 + 2 M_k + l_k+1 / (l_k + l_k+1) M_k+1 = 6 (D_k+1 / l_k+1 - D_k / l_k) / (l_k + l_k+1).
// What is left out beyond five points counts less than 0.27^5 there.
#include "splinefeed/s1_blended_path/chain_state.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

namespace {

constexpr unsigned reach = 5;
constexpr unsigned most = 2 * reach + 1;

} // namespace

template <Scalar S>
void chain_state(const ChainPoints<S>& points, std::uint64_t at, PathState<S>& out) noexcept {
    const std::uint64_t first = at < points.oldest() + reach ? points.oldest() : at - reach;
    const std::uint64_t end = smaller(at + reach, points.last());
    const auto count = static_cast<unsigned>(end - first); // chords
    const auto place = static_cast<unsigned>(at - first);
    const auto axes = static_cast<unsigned>(points.axes());
    std::array<PerAxis<S>, most> chord{}; // [i]: the one that ends at first + i, as a unit vector
    std::array<S, most> length{};
    for (unsigned i = 1; i <= count; ++i) {
        points.smoothed(first + i - 1, first + i, chord[i]);
        length[i] = norm(chord[i], points.axes());
        for (unsigned k = 0; k < axes; ++k) {
            chord[i][k] = chord[i][k] / length[i];
        }
    }
    std::array<S, most> factor{};
    std::array<PerAxis<S>, most> moment{};
    const S one = from_integer<S>(1);
    for (unsigned i = 1; i < count; ++i) {
        const S both = length[i] + length[i + 1];
        const S before = length[i] / both;
        const S pivot = one / (from_integer<S>(2) - before * factor[i - 1]);
        factor[i] = (one - before) * pivot;
        for (unsigned k = 0; k < axes; ++k) {
            const S turn = scale2(from_integer<S>(6) * (chord[i + 1][k] - chord[i][k]), bend_log2) / both;
            moment[i][k] = (turn - before * moment[i - 1][k]) * pivot;
        }
    }
    for (unsigned i = count - 1; i > 0 && i + 1 > place; --i) {
        for (unsigned k = 0; k < axes; ++k) {
            moment[i][k] = moment[i][k] - factor[i] * moment[i + 1][k];
        }
    }
    out = {};
    const bool behind = place > 0; // the chord that ends there, or the one that begins
    const unsigned chosen = behind ? place : 1;
    for (unsigned k = 0; k < axes; ++k) {
        const S twice = scale2(moment[place][k], 1) + moment[behind ? place - 1 : 1][k];
        const S part = literal<S>(1.0 / 6.0) * scale2(length[chosen] * twice, -bend_log2);
        out.tangent[k] = chord[chosen][k] + (behind ? part : -part);
    }
    const S speed = norm(out.tangent, points.axes());
    S along{};
    for (unsigned k = 0; k < axes; ++k) {
        out.tangent[k] = out.tangent[k] / speed;
        along += out.tangent[k] * moment[place][k];
    }
    for (unsigned k = 0; k < axes; ++k) {
        out.bend[k] = (moment[place][k] - along * out.tangent[k]) / speed / speed;
    }
}

#if SPLINEFEED_MAX_DEGREE >= 5
#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template void chain_state(const ChainPoints<S>&, std::uint64_t, PathState<S>&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE
#endif

} // namespace splinefeed
