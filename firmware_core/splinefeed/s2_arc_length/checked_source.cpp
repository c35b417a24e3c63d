// SPDX-License-Identifier: MIT
#include "splinefeed/s2_arc_length/checked_source.hpp"

#include "splinefeed/number/instantiate.hpp"
#include "splinefeed/number/vector.hpp"

namespace splinefeed {

namespace {

// Largest distance between the start of a program and the position of the machine.
constexpr std::int64_t beside_raw = std::int64_t{1} << (Position::fraction_bits - 26);

} // namespace

template <Scalar S>
PositionRange hull(const PerDegree<S>& control, int degree, Position origin, int unit_log2) noexcept {
    S least = control[0];
    S most = least;
    for (unsigned i = 1; i <= static_cast<unsigned>(degree); ++i) {
        least = smaller(least, control[i]);
        most = larger(most, control[i]);
    }
    return {displaced(origin, least, unit_log2), displaced(origin, most, unit_log2)};
}

template <Scalar S>
bool direction_jumps(const CurveSegment<S>& before, const CurveSegment<S>& after, S most) noexcept {
    const int axes = before.axes;
    const auto m = static_cast<unsigned>(before.degree);
    PerAxis<S> in = leg(before.control, m - 1, m, axes);
    PerAxis<S> out = leg(after.control, 0, 1, axes);
    const S length_in = norm(in, axes);
    const S length_out = norm(out, axes);
    if (length_in < negligible_units<S> || length_out < negligible_units<S>) {
        return true;
    }
    divide(in, length_in, axes);
    divide(out, length_out, axes);
    return largest_size(difference(out, in, axes), axes) > most;
}

template <Scalar S>
bool turns_within(const CurveSegment<S>& segment, S radius_mm) noexcept {
    const int axes = segment.axes;
    PerAxis<S> first{};
    PerAxis<S> side{};
    S length{};
    for (const unsigned i : indices(segment.degree)) {
        side = leg(segment.control, i, i + 1, axes);
        const S part = norm(side, axes);
        length += part;
        if (part > S{}) {
            divide(side, part, axes);
        } else {
            side = {};
        }
        first = i == 0 ? side : first;
    }
    return segment.degree > 1 &&
           scale2(length, segment.unit_log2) < norm(difference(side, first, axes), axes) * radius_mm;
}

// Whether the machine can be where a segment leads: its counters reach the whole segment, and the first segment begins
// where the machine stands.
template <Scalar S>
Status CheckedSource<S>::check(const CurveSegment<S>& segment) const noexcept {
    if (refinement_->axes != 0 && segment.axes != refinement_->axes) {
        return Error::axes_differ;
    }
    for (const unsigned k : indices(segment.axes)) {
        const auto [low, high] = hull(segment.control[k], segment.degree, segment.origin[k], segment.unit_log2);
        if (low < refinement_->countable[k].low || high > refinement_->countable[k].high) {
            return Error::counts_out_of_range;
        }
        if (from_ != nullptr) {
            const std::int64_t beside = segment.start(k).raw - (*from_)[k].raw;
            if (beside > beside_raw || beside < -beside_raw) {
                return Error::start_elsewhere;
            }
        }
    }
    return {};
}

template <Scalar S>
Pull CheckedSource<S>::next(CurveSegment<S>& out) noexcept {
    const Pull pull = status_.ok() ? source_->next(out) : Pull::finished;
    if (pull != Pull::item) {
        return pull;
    }
    status_ = check(out);
    from_ = nullptr;
    return status_.ok() ? Pull::item : Pull::finished;
}

#define SPLINEFEED_INSTANTIATE(S)                                                                                      \
    template class CheckedSource<S>;                                                                                   \
    template PositionRange hull(const PerDegree<S>&, int, Position, int) noexcept;                                     \
    template bool direction_jumps(const CurveSegment<S>&, const CurveSegment<S>&, S) noexcept;                         \
    template bool turns_within(const CurveSegment<S>&, S) noexcept;
SPLINEFEED_EACH_SCALAR(SPLINEFEED_INSTANTIATE)
#undef SPLINEFEED_INSTANTIATE

} // namespace splinefeed
