// SPDX-License-Identifier: MIT
//
// While the motion is in a cell, the distance from the end of the cell to the average is at most the mean distance over
// the time T after it, and the distance from its start at most the mean over the time before it. No motion goes farther
// in these times than one that is as fast as `bound_sq` at the faster end of each cell: the acceleration-limited plan
// with the largest override, or more.
#include "splinefeed/s3_feed_plan/jerk_filtered/smooth_window.hpp"

#include "splinefeed/base/assertion.hpp"
#include "splinefeed/s2_arc_length/cell_part.hpp"
#include "splinefeed/s3_feed_plan/jerk_filtered/leg_smoothing.hpp"

namespace splinefeed {

namespace {

// Rounding of q'' where two cells meet, times their length (see JerkWindow).
template <Scalar S>
constexpr double bend_noise = std::same_as<S, double>  ? 0x1p-48
                              : std::same_as<S, float> ? 0x1p-20
                                                       : 0x1p-25;

constexpr double crawl_sq = 1e-6; // v^2 if a derivative is beyond the range of the scalar
constexpr double rounding = 1e-3; // part by which a reach is made longer

} // namespace

// A bend that is too sharp for the scalar counts as a jump. Where q'' jumps by d, the acceleration jumps by d v^2, and
// a third difference over T^3 contains up to 3/4 of that over T. A jump above the reserve of MotionLimits::make becomes
// a stop.
template <Scalar S>
bool SmoothWindow<S>::bend_jumps(const Cell<S>& before, const Cell<S>& after, S speed_sq) const noexcept {
    const S per_s = literal<S>(0.75) * limits_->segments_per_s;
    const S noise = quotient_or_max(literal<S>(bend_noise<S>), smaller(before.length_mm, after.length_mm));
    const auto second = [](Ratio<S> bend, S length) { // |q''|
        return quotient_or_max(lengthened<S>(absolute(bend), -1), length);
    };
    for (const unsigned k : indices(limits_->axes)) {
        const S second_before = second(before.shape[k].bend[2], before.length_mm);
        const S second_after = second(after.shape[k].bend[0], after.length_mm);
        if (!(larger(second_before, second_after) < scale2(largest<S>(), -1))) { // their sum must fit
            return true;
        }
        const bool turns = (before.shape[k].bend[2] < Ratio<S>{}) != (after.shape[k].bend[0] < Ratio<S>{});
        const S jump = absolute(second_after - (turns ? -second_before : second_before)) - noise;
        const S reserve = literal<S>(detail::jerk_reserve) * limits_->jerk_mm_s3[k] / per_s;
        if (jump > S{} && quotient_or_max(reserve, jump) < speed_sq) {
            return true;
        }
    }
    return false;
}

// From standstill to standstill: in two halves, so that there is a place where the motion moves.
template <Scalar S>
void SmoothWindow<S>::split_last() noexcept {
    SmoothCell<S>& first = at(size_ - 1);
    SmoothCell<S>& second = at(size_);
    const S half = literal<S>(0.5);
    second = first;
    second.cell = part_of(first.cell, CellInterval<S>{half, from_integer<S>(1)});
    first.cell = part_of(first.cell, CellInterval<S>{S{}, half});
    second.bound_sq = first.own.cap_sq;
    first.own = PathDerivativeBounds<S>::of(first.cell, first.own.cap_sq, first.own.programmed_sq);
    second.own = PathDerivativeBounds<S>::of(second.cell, second.own.cap_sq, second.own.programmed_sq);
    second.start = displaced(first.start, first.cell.length_mm, 0);
    ++size_;
    end_ = displaced(second.start, second.cell.length_mm, 0);
}

template <Scalar S>
void SmoothWindow<S>::append(const Cell<S>& cell, S cap_sq, S programmed_sq, S exit_bound_sq) noexcept {
    SPLINEFEED_ASSERT(has_room());
    if (size_ > prepared_ && end_bound_sq_ > S{}) {
        SmoothCell<S>& before = at(size_ - 1);
        if (bend_jumps(before.cell, cell, smaller(end_bound_sq_, cap_sq))) {
            before.cell.stop_at_end = true;
            before.cell.end = cell.origin;
            end_bound_sq_ = S{};
            if (!(before.bound_sq > S{})) {
                split_last();
            }
        }
    }
    SmoothCell<S>& added = at(size_);
    added.cell = cell;
    added.bound_sq = end_bound_sq_;
    added.own = PathDerivativeBounds<S>::of(cell, cap_sq, programmed_sq);
    added.start = end_;
    end_ = displaced(end_, cell.length_mm, 0);
    end_bound_sq_ = cell.stop_at_end ? S{} : exit_bound_sq;
    ++size_;
    if (!(added.bound_sq > S{}) && !(end_bound_sq_ > S{})) {
        split_last();
    }
}

// The last cell is not prepared, because the path after it is not known. So there is room for its halves.
template <Scalar S>
void SmoothWindow<S>::end_here() noexcept {
    if (size_ == front_ || !(end_bound_sq_ > S{})) {
        return;
    }
    SPLINEFEED_ASSERT(prepared_ < size_ && size_ < storage_.size());
    end_bound_sq_ = S{};
    if (!(at(size_ - 1).bound_sq > S{})) {
        split_last();
    }
}

template <Scalar S>
void SmoothWindow<S>::release() noexcept {
    SPLINEFEED_ASSERT(front_ > 0);
    const auto back = [](std::size_t& i) {
        i = i > 0 ? i - 1 : 0;
    };
    head_ = ring_index(head_ + 1, storage_.size());
    --size_;
    --front_;
    back(prepared_);
    back(low_);
    back(middle_);
    back(high_);
    back(bounded_);
}

template <Scalar S>
void SmoothWindow<S>::clear() noexcept {
    size_ = front_ = prepared_ = low_ = middle_ = high_ = bounded_ = 0;
    end_bound_sq_ = S{};
    joined_ = {};
}

template <Scalar S>
std::uint32_t SmoothWindow<S>::smoothing_of_leg(std::size_t first, bool& in_view) const noexcept {
    LegSmoothing<S> leg(*limits_);
    for (std::size_t i = first; i < size_; ++i) {
        leg.add(at(i).own, at(i).cell.length_mm, larger(at(i).bound_sq, bound_behind(i)));
        if (ends_leg(i)) {
            leg.end_here();
            break;
        }
    }
    const std::uint32_t longest_q8 = leg.longest_q8(in_view);
    // The end may come into view before the motion is there.
    in_view = in_view && (first == front_ || !leg.gains_by_end());
    return longest_q8;
}

// The farthest cell in which the average can be while the motion is in cell i; false: not yet known.
template <Scalar S>
bool SmoothWindow<S>::last_reached(std::size_t i, const Smoothing<S>& smoothing, std::size_t& last) const noexcept {
    const S reach = from_integer<S>(smoothing.ticks());
    S time{};
    S way{};
    S area{}; // ticks mm
    for (std::size_t j = i;; ++j) {
        if (ends_leg(j)) {
            area = area + (reach - time) * way;
            break;
        }
        if (j + 1 == size_) {
            return false;
        }
        const SmoothCell<S>& next = at(j + 1);
        const S length = next.cell.length_mm;
        const S left = reach - time;
        if (!(next.bound_ticks < left)) {
            area = area + left * (way + scale2(length * (left / next.bound_ticks), -1));
            break;
        }
        area = area + next.bound_ticks * (way + scale2(length, -1));
        way = way + length;
        time = time + next.bound_ticks;
    }
    // Over N + f ticks, of which N + 1 were added.
    S mean =
        area / scale2(from_integer<S>(static_cast<std::int32_t>(smoothing.duration_q8)), -Smoothing<S>::fraction_bits);
    mean = mean + mean * literal<S>(rounding);
    last = i;
    while (!ends_leg(last) && mean > S{}) {
        if (last + 1 == size_) {
            return false;
        }
        ++last;
        mean = mean - at(last).cell.length_mm;
    }
    return true;
}

template <Scalar S>
std::size_t SmoothWindow<S>::first_reached(std::size_t i, const Smoothing<S>& smoothing) const noexcept {
    const S reach = from_integer<S>(smoothing.ticks());
    S time{};
    S way{};
    S area{};
    for (std::size_t j = i; time < reach; --j) {
        if (starts_leg(j)) {
            area = area + (reach - time) * way;
            break;
        }
        if (j == 0) {
            return 0; // the machine has passed the part that is no longer known
        }
        const SmoothCell<S>& before = at(j - 1);
        const bool whole = !(reach - time < before.bound_ticks);
        const S left = whole ? before.bound_ticks : reach - time;
        const S length = whole ? before.cell.length_mm : before.cell.length_mm * (left / before.bound_ticks);
        area = area + left * (way + scale2(length, -1));
        way = way + length;
        time = time + left;
    }
    S mean =
        area / scale2(from_integer<S>(static_cast<std::int32_t>(smoothing.duration_q8)), -Smoothing<S>::fraction_bits);
    mean = mean + mean * literal<S>(rounding);
    std::size_t first = i;
    while (first > 0 && !starts_leg(first) && mean > S{}) {
        --first;
        mean = mean - at(first).cell.length_mm;
    }
    return first;
}

// After the start of the cell nothing is faster than the known cells after its end allow.
template <Scalar S>
void SmoothWindow<S>::slow_down(std::size_t first) noexcept {
    S known{};
    for (std::size_t i = first + 1; i < size_; ++i) {
        known = known + at(i).cell.length_mm;
    }
    const S ticks = from_integer<S>(smoothing_.ticks() + 1);
    const S speed = larger(smaller(known * (limits_->segments_per_s / ticks), limits_->path_mm_s), literal<S>(1e-3));
    const S speed_sq = speed * speed;
    for (std::size_t i = first; i < size_; ++i) {
        SmoothCell<S>& here = at(i);
        here.bound_sq = smaller(here.bound_sq, speed_sq);
        here.own.cap_sq = smaller(here.own.cap_sq, speed_sq);
        here.bound_ticks = quotient_or_max(here.cell.length_mm * limits_->segments_per_s, speed);
    }
    end_bound_sq_ = smaller(end_bound_sq_, speed_sq);
}

// Both ends only move forward: a queue of two stacks, amortised two joins per cell.
template <Scalar S>
PathDerivativeBounds<S> SmoothWindow<S>::demand_of(std::size_t first, std::size_t last) noexcept {
    const int axes = limits_->axes;
    for (; high_ <= last; ++high_) {
        joined_.join(at(high_).own, axes);
    }
    low_ = larger(low_, first);
    if (low_ >= middle_) {
        for (std::size_t i = high_ - 1; i-- > low_;) {
            at(i).own.join(at(i + 1).own, axes);
        }
        middle_ = high_;
        joined_ = {};
    }
    PathDerivativeBounds<S> out = at(low_).own;
    out.join(joined_, axes);
    return out;
}

// Bounds of the leg's cells that are not prepared, from the demands of each cell alone: a motion that has to keep
// larger demands is not faster. Once forward, then backward from the end of the known path.
template <Scalar S>
void SmoothWindow<S>::tighten(std::size_t first) noexcept {
    const auto exit_bound = [&](std::size_t i) -> S& {
        return i + 1 < size_ ? at(i + 1).bound_sq : end_bound_sq_;
    };
    std::size_t end = first;
    for (;; ++end) {
        if (end >= bounded_) {
            const SmoothCell<S>& here = at(end);
            const FilteredLimits<S> bound(here.own, *limits_, smoothing_);
            S& exit = exit_bound(end);
            exit = larger(bound.largest_exit(here.bound_sq, exit, here.cell.length_mm, bound.max_path_acceleration()),
                          smaller(exit, literal<S>(crawl_sq)));
        }
        if (end + 1 == size_ || ends_leg(end)) {
            break;
        }
    }
    bounded_ = end + 1;
    for (std::size_t i = end + 1; i-- > first;) {
        SmoothCell<S>& here = at(i);
        if (i > first) {
            const S exit = exit_bound(i);
            // What was joined before is no longer the cell's own.
            const PathDerivativeBounds<S> own =
                i < high_ ? PathDerivativeBounds<S>::of(here.cell, here.own.cap_sq, here.own.programmed_sq) : here.own;
            const FilteredLimits<S> bound(own, *limits_, smoothing_);
            here.bound_sq =
                larger(bound.largest_entry(exit, here.bound_sq, here.cell.length_mm, bound.max_path_acceleration()),
                       smaller(here.bound_sq, literal<S>(crawl_sq)));
        }
        measure(i);
    }
}

template <Scalar S>
void SmoothWindow<S>::prepare(bool force) noexcept {
    const std::size_t enough = force ? (front_ + size_) / 2 : 0;
    if (prepared_ < size_ && !starts_leg(prepared_)) {
        tighten(prepared_);
    }
    while (prepared_ < size_) {
        const std::size_t i = prepared_;
        SmoothCell<S>& here = at(i);
        if (starts_leg(i)) {
            bool in_view = false;
            smoothing_ = Smoothing<S>(smoothing_of_leg(i, in_view), *limits_);
            // T is constant for the whole leg. The motion stands before it; by then more of the leg is known.
            if (!in_view && !(force && i == front_)) {
                break;
            }
            bounded_ = i;
            tighten(i);
        }
        std::size_t last = i;
        if (!last_reached(i, smoothing_, last)) {
            if (i >= enough) {
                break;
            }
            slow_down(larger(i, enough));
            if (!last_reached(i, smoothing_, last)) {
                last = size_ - 1; // not reached
            }
        }
        here.demand = demand_of(first_reached(i, smoothing_), last);
        here.smoothing_q8 = smoothing_.duration_q8;
        const FilteredLimits<S> bound(here.demand, *limits_, smoothing_);
        here.max_path_acceleration = bound.max_path_acceleration();
        const S fastest_sq = smaller(larger(here.bound_sq, bound_behind(i)), here.demand.cap_sq);
        here.max_steady_sq =
            bound.max_steady(here.demand.beyond ? smaller(fastest_sq, literal<S>(crawl_sq)) : fastest_sq);
        here.machine_controllable_sq = here.override_controllable_sq = here.override_reach = S{};
        ++prepared_;
    }
}

template class SmoothWindow<double>;
template class SmoothWindow<float>;
template class SmoothWindow<Fixed>;

} // namespace splinefeed
