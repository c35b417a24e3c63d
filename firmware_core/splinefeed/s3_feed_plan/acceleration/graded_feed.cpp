// SPDX-License-Identifier: MIT
//
// A jerk-limited plan has one pseudo-jerk u for each cell, with |u| <= 2 J / sqrt(b) for the largest b in the cell. So
// in a cell of length L beside a bend the speed v can change much only where L is not longer than the way in which a
// jerk J changes v by itself, sqrt(v^3 / J), or an acceleration A does, v^2 / (2 A). A motion from rest needs no such
// parts: ArcLength grades the cells near a stop.
#include "splinefeed/s3_feed_plan/acceleration/graded_feed.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

namespace {

constexpr double shortest_mm = 4e-6;   // a shorter part is not cut: Fixed has no digits for its halves
constexpr double least_share = 0x1p-8; // of the cell: a smaller part is not cut

} // namespace

// The front cell of the plan, with its profile segment to the end.
template <Scalar S>
Pull GradedFeed<S>::prepare(UnderrunPolicy underrun, WorkBudget& work) noexcept {
    Pull pull = source_->prepare(underrun, work);
    while (pull == Pull::item && !(source_->profile_segment().stretch.to == from_integer<S>(1))) {
        source_->advance(); // the first half of a degenerate cell
        pull = source_->prepare(underrun, work);
        SPLINEFEED_ASSERT(pull == Pull::item || pull == Pull::busy);
    }
    return pull;
}

// b is linear in s.
template <Scalar S>
S GradedFeed<S>::speed_sq_at(S fraction) const noexcept {
    const ProfileSegment<S>& segment = source_->profile_segment();
    return fraction == from_integer<S>(1) ? segment.exit_sq
                                          : segment.entry_sq + (segment.exit_sq - segment.entry_sq) * fraction;
}

// How long a part may be: the slower of its ends decides, of those in motion; between stops, the largest number.
template <Scalar S>
S GradedFeed<S>::longest_of(const CellInterval<S>& part, S jerk, S acceleration) const noexcept {
    const S from_sq = speed_sq_at(part.from);
    const S to_sq = speed_sq_at(part.to);
    const S slower_sq = smaller(from_sq, to_sq);
    const S speed_sq = slower_sq > S{} ? slower_sq : larger(from_sq, to_sq);
    const S speed = square_root(speed_sq);
    return speed > S{} ? longest_ * larger(speed * square_root(speed / jerk), scale2(speed_sq, -1) / acceleration)
                       : largest<S>();
}

template <Scalar S>
CellInterval<S> GradedFeed<S>::next_part(const Cell<S>& cell) const noexcept {
    CellInterval<S> part{from_, from_integer<S>(1)};
    if (!source_->profile_segment().stretch.whole()) {
        return part;
    }
    S jerk = largest<S>();
    S acceleration = largest<S>();
    for (const unsigned k : indices(cell.axes)) {
        const S tangent = lengthened<S>(cell.tangent_max[k]);
        const S most = smaller(limits_->acceleration_mm_s2[k], limits_->braking_mm_s2[k]);
        jerk = smaller(jerk, quotient_or_max(limits_->jerk_mm_s3[k], tangent));
        acceleration = smaller(acceleration, quotient_or_max(most, tangent));
    }
    const auto too_long = [&] {
        const S length = cell.length_mm * part.length();
        return length > literal<S>(shortest_mm) && part.length() > literal<S>(least_share) &&
               length > longest_of(part, jerk, acceleration);
    };
    while (too_long()) {
        part.to = part.from + scale2(part.length(), -1);
    }
    return part;
}

template <Scalar S>
void GradedFeed<S>::leave(const CellInterval<S>& part) noexcept {
    if (part.to == from_integer<S>(1)) {
        from_ = S{};
        source_->advance();
    } else {
        from_ = part.to;
    }
}

SPLINEFEED_INSTANTIATE_CLASS(GradedFeed)

} // namespace splinefeed
