// SPDX-License-Identifier: MIT
//
// AccelerationBound::change says by how much R v^2 may change along the whole cell, and by x R along a part x of it,
// wherever that part lies. Speeding up from b0 and braking to b1 meet at
//
//     x = (b1 - b0 + x_end R_braking) / (R_speeding + R_braking),     b = b0 + x R_speeding
//
// from the start of what is left. On a line R is what the axes have, so no motion is faster anywhere: from b0 none
// gains more on its way there, and none may have more on its way to b1.
#include "splinefeed/s3_feed_plan/acceleration/peaked_segment.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

namespace {

constexpr double least_length_mm = 1e-3;      // a shorter cell has few digits
constexpr std::int32_t most_change = 1 << 29; // v^2 over a cell: sums of two fit
constexpr double kept = 1.0 - 0x1p-20;        // of a change, for the rounding of places

// Of the cell: a part has digits for its length.
template <Scalar S>
constexpr S least_part = literal<S>(std::same_as<S, float> ? 0x1p-10 : 0x1p-13);

// The part of the cell for a change of v^2; 0: it is left to the part beside it.
template <Scalar S>
S part_for(S change, S change_of_cell, S peak_sq) noexcept {
    const S part = change / change_of_cell;
    return part > least_part<S> ? part : change > scale2(peak_sq, -9) ? least_part<S> : S{};
}

} // namespace

template <Scalar S>
bool has_parts(const Cell<S>& cell) noexcept {
    return !(cell.stop_before && cell.degree == 1) && cell.length_mm > literal<S>(least_length_mm);
}

template <Scalar S>
ProfileSegment<S> peaked_segment(const Cell<S>& cell, const MotionLimits<S>& limits,
                                 const PeakTarget<S>& target) noexcept {
    const AccelerationBound<S> bound(cell, limits);
    const S ends = larger(target.entry_sq, target.exit_sq);
    const S speeding = literal<S>(kept) * bound.change(true, ends, from_integer<S>(most_change));
    const S braking = literal<S>(kept) * bound.change(false, ends, from_integer<S>(most_change));
    const S rest = from_integer<S>(1) - target.from;
    const S entry = target.entry_sq;
    const S exit = target.exit_sq;
    ProfileSegment<S> out{{target.from}, entry, exit, false};
    if (!(speeding > S{} && braking > S{}) || exit > target.most_sq) {
        return out;
    }
    const S meet = (exit - entry + braking * rest) / (speeding + braking);
    const S peak = smaller(target.most_sq, entry + speeding * meet);
    const S up = part_for<S>(peak - entry, speeding, peak);
    const S down = part_for<S>(peak - exit, braking, peak);
    if (up > S{} && rest - up > least_part<S>) {
        out.stretch.to = target.from + up;
        out.exit_sq = peak;
    } else if (!(up > S{}) && down > S{} && rest - down > least_part<S>) {
        out.stretch.to = from_integer<S>(1) - down;
        out.exit_sq = entry;
    }
    return out;
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template bool has_parts(const Cell<S>&) noexcept;                                                                  \
    template ProfileSegment<S> peaked_segment(const Cell<S>&, const MotionLimits<S>&, const PeakTarget<S>&) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
