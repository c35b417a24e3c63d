// SPDX-License-Identifier: MIT
//
// With D_j the third divided difference of the points j-3 to j over the chord length t, sum w_j D_j^2 is smallest in
// x_i at x_i - (sum w_j c_ji D_j) / (sum w_j c_ji^2), c_ji the factor of x_i in D_j. Each D_j is kept in units of the
// power of two above its longest chord: then its factors are between 1 and 2^13, whatever the lengths are.
#include "splinefeed/s1_blended_path/chain_smoothing.hpp"

#include "splinefeed/number/exponent.hpp"
#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

namespace {

constexpr double used = 0.9;                  // of what is left of the tolerance beside the bow
constexpr double shortest_chord = 1.0 / 32.0; // chord, in the unit of a difference: with a shorter one it is not used

// The third difference of the four points that end at `last`.
template <Scalar S>
void measure_difference(ChainPoints<S>& points, std::uint64_t last) noexcept {
    ChainPoint<S>& end = points[last];
    end.weight = S{};
    S longest{};
    for (std::uint64_t j = last - 2; j <= last; ++j) {
        longest = larger(longest, points[j].chord);
    }
    end.exponent = exponent_of(longest) + 1;
    std::array<S, 4> t{};
    for (unsigned m = 1; m < 4; ++m) {
        const S chord = scale2(points[last - 3 + m].chord, -end.exponent);
        if (!(chord > literal<S>(shortest_chord))) {
            return;
        }
        t[m] = t[m - 1] + chord;
    }
    for (unsigned m = 0; m < 4; ++m) {
        S product = from_integer<S>(1);
        for (unsigned l = 0; l < 4; ++l) {
            product = l == m ? product : product * (t[m] - t[l]);
        }
        end.difference[m] = from_integer<S>(1) / product;
    }
    end.weight = literal<S>(1.0 / 3.0) * t[3];
}

} // namespace

template <Scalar S>
void measure_last_point(ChainPoints<S>& points, S tolerance) noexcept {
    const std::uint64_t last = points.last();
    if (last >= 3) {
        measure_difference(points, last);
    }
    if (last < 2) {
        return;
    }
    // The bow of the longer line at the point before: |K| h^2 / 8, K the second divided difference.
    ChainPoint<S>& here = points[last - 1];
    const S behind = here.chord;
    const S ahead = points[last].chord;
    const S both = behind + ahead;
    const S longer = larger(behind, ahead);
    PerAxis<S> in{};
    PerAxis<S> out{};
    points.programmed(last - 2, last - 1, in);
    points.programmed(last - 1, last, out);
    for (const unsigned k : indices(points.axes())) {
        in[k] = (out[k] / ahead - in[k] / behind) * (longer / both) * scale2(longer, -3); // half the bow
    }
    S half_bow = norm(in, points.axes());
    if (half_bow >= tolerance) {
        const S share = smaller(behind, ahead) / longer;
        scale(in, share * share, points.axes());
        half_bow = share * share * half_bow;
    }
    here.centre = half_bow < tolerance ? in : PerAxis<S>{};
    here.radius = literal<S>(used) * (half_bow < tolerance ? tolerance - half_bow : tolerance);
}

template <Scalar S>
void smooth_point(ChainPoints<S>& points, std::uint64_t i) noexcept {
    const std::uint64_t first = i < points.oldest() + 3 ? points.oldest() + 3 : i;
    const std::uint64_t end = smaller(i + 3, points.last());
    int finest = 64; // the least exponent
    for (std::uint64_t j = first; j <= end; ++j) {
        finest = points[j].weight > S{} ? smaller(finest, points[j].exponent) : finest;
    }
    if (finest == 64) {
        return;
    }
    const auto axes = static_cast<unsigned>(points.axes());
    // The points first - 3 to end, from this one as programmed, in units of 2^finest.
    std::array<PerAxis<S>, 7> around; // NOLINT: written before it is read
    ChainPoint<S>& here = points[i];
    for (std::uint64_t j = first - 3; j <= end; ++j) {
        const ChainPoint<S>& there = points[j];
        PerAxis<S>& at = around[static_cast<unsigned>(j - (first - 3))];
        for (unsigned k = 0; k < axes; ++k) {
            at[k] = scale2(distance<S>(here.place[k], there.place[k], chord_unit_log2) + there.moved[k], -finest);
        }
    }
    PerAxis<S> pull{};
    S stiffness{};
    for (std::uint64_t j = first; j <= end; ++j) {
        const ChainPoint<S>& of = points[j];
        const int coarser = of.exponent - finest;
        if (!(of.weight > S{}) || coarser > 8) {
            continue;
        }
        PerAxis<S> difference{};
        for (unsigned m = 0; m < 4; ++m) {
            const PerAxis<S>& at = around[static_cast<unsigned>(j - first) + m];
            add(difference, of.difference[m], at, points.axes());
        }
        // The square of a factor times a length: the fifth power of its unit.
        const S factor = of.difference[static_cast<unsigned>(i - (j - 3))];
        const S share = scale2(of.weight * factor, -5 * coarser);
        stiffness += share * factor;
        add(pull, share, difference, points.axes());
    }
    if (!(stiffness > S{})) {
        return;
    }
    for (unsigned k = 0; k < axes; ++k) {
        here.moved[k] = here.moved[k] - scale2(pull[k] / stiffness, finest) - here.centre[k];
    }
    const S away = norm(here.moved, points.axes());
    for (unsigned k = 0; k < axes; ++k) {
        here.moved[k] = here.centre[k] + (away > here.radius ? here.moved[k] * (here.radius / away) : here.moved[k]);
    }
}

#if SPLINEFEED_MAX_DEGREE >= 5
#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template void measure_last_point(ChainPoints<S>&, S) noexcept;                                                     \
    template void smooth_point(ChainPoints<S>&, std::uint64_t) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE
#endif

} // namespace splinefeed
