// SPDX-License-Identifier: MIT
//
// The window is planned leg by leg, from a stop (or from where the machine will be) to the next stop (or to the end of
// what is known, at rest). A leg that ends at a stop is final; of one that ends with the window the first half is
// committed. The rest is planned again with more in view. Its old plan is kept: where none can be found from the state
// at the end of what is committed (that can happen, since the sets of states are made smaller to have few corners) the
// old one is travelled to its end, which is at rest.
//
// A straight leg is one move in closed form (straight_move.cpp).
#include "splinefeed/s3_feed_plan/jerk_plan.hpp"

#include "splinefeed/base/assertion.hpp"

namespace splinefeed {

namespace {

// How much larger the third derivative of what fits leave is than the second, times the length. A rest x (1-x) (1-2x)
// of q'' has the slope 1 at the ends and reaches 0.096. That of the inverse, c x^3 (1-x)^3 (x-1/2), makes it 24, but
// five times that rest is allowed for.
constexpr double ripple = 10.4;
// Attempts with other expected speeds: halved beyond the old plan, and at least that part of at_most_sq in it.
constexpr double least_known[] = {0.1, 0.3, 0.5, 1.0, 0.02};
constexpr int attempts = 6;
constexpr double same_cap = 1e-9;
// Rounding of q'', times the length of the cell: a unit vector of Fixed is off by 2^-32, and is taken times the change
// of |dr/dw| in the cell, at most as much as that is.
template <Scalar S>
constexpr double bend_noise = std::same_as<S, double> ? 0x1p-48 : 0x1p-30;

/// What a cell asks of the motion: its shape's derivatives at both ends.
template <Scalar S>
JerkCell jerk_cell_of(const Cell<S>& cell, const MotionLimits<S>& limits, double cap_sq) noexcept {
    JerkCell out;
    out.axes = cell.axes;
    out.length_mm = to_double(cell.length_mm);
    out.cap_sq = cap_sq;
    const double unit = to_double(scale2(from_integer<S>(1), -limits.refinement.shape_log2));
    const double per_length = 1.0 / out.length_mm;
    for (unsigned k = 0; k < static_cast<unsigned>(cell.axes); ++k) {
        const AxisShape<S>& shape = cell.shape[k];
        out.jerk_mm_s3[k] = to_double(limits.jerk_mm_s3[k]);
        for (unsigned e = 0; e < 2; ++e) {
            AxisEnd& at = out.end[e][k];
            at.first = to_double(shape.tangent[e]) * unit;
            at.second = 0.5 * per_length * unit * to_double(shape.bend[2 * e]);
            at.third = per_length * per_length * unit * to_double(shape.bend[1 + e] - shape.bend[e]);
            at.second_spread = 0.5 * per_length * unit * to_double(shape.spread);
            at.third_spread = ripple * at.second_spread * per_length;
            at.most_forward = at.most_backward =
                to_double(smaller(limits.acceleration_mm_s2[k], limits.braking_mm_s2[k]));
        }
    }
    return out;
}

/// The fastest that the acceleration-limited plan is in the cell behind a node.
double fastest_sq(const JerkNode& node, const JerkNode& next) noexcept {
    return larger(node.at_most_sq, next.at_most_sq);
}

/// One move can take them: no bend, and one cap.
bool straight(std::span<const JerkNode> nodes) noexcept {
    const double cap = nodes.front().cell.cap_sq;
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const JerkCell& cell = nodes[i].cell;
        if (!cell.straight(fastest_sq(nodes[i], nodes[i + 1])) || absolute(cell.cap_sq - cap) > same_cap * cap) {
            return false;
        }
    }
    return true;
}

/// What keeps the limits of all cells of a straight leg.
MoveLimits limits_of(std::span<const JerkNode> nodes) noexcept {
    MoveLimits least{square_root(nodes.front().cell.cap_sq), largest<double>(), largest<double>()};
    for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        const MoveLimits limits = nodes[i].cell.move_limits(fastest_sq(nodes[i], nodes[i + 1]));
        least.acceleration_mm_s2 = smaller(least.acceleration_mm_s2, limits.acceleration_mm_s2);
        least.jerk_mm_s3 = smaller(least.jerk_mm_s3, limits.jerk_mm_s3);
    }
    return least;
}

} // namespace

template <Scalar S>
JerkPlan<S>::JerkPlan(FeedPlan<S>& source, const MotionLimits<S>& limits, const JerkStorage<S>& storage) noexcept
    : source_(&source), limits_(&limits), storage_(storage) {
    SPLINEFEED_ASSERT(storage.cells.size() >= smallest_window && storage.nodes.size() > storage.cells.size());
}

// Where q'' jumps by d so does the acceleration by d v^2, and a third difference over T^3 sees up to 3/4 of that over
// T. More than the reserve of MotionLimits::make can take is a stop.
template <Scalar S>
bool JerkPlan<S>::bend_jumps(const JerkNode& before, const JerkNode& after) const noexcept {
    const double per_s = 0.75 * to_double(limits_->segments_per_s);
    const double noise = bend_noise<S> / smaller(before.cell.length_mm, after.cell.length_mm);
    for (unsigned k = 0; k < static_cast<unsigned>(after.cell.axes); ++k) {
        const double jump = absolute(after.cell.end[0][k].second - before.cell.end[1][k].second);
        const double reserve = detail::jerk_reserve * after.cell.jerk_mm_s3[k];
        if ((jump - noise) * smaller(after.at_most_sq, after.cell.cap_sq) * per_s > reserve) {
            return true;
        }
    }
    return false;
}

template <Scalar S>
Pull JerkPlan<S>::take(Starvation starvation) noexcept {
    Pull pull = source_->prepare(starvation);
    if (pull != Pull::item) {
        return pull;
    }
    Cell<S>& cell = cell_at(size_);
    cell = source_->cell();
    const double cap_sq = to_double(source_->cap_sq());
    JerkNode& node = storage_.nodes[travelled_ + size_];
    node.cell = jerk_cell_of(cell, *limits_, cap_sq);
    node.travel = Travel::curve;
    if (size_ > 0 && bend_jumps(storage_.nodes[travelled_ + size_ - 1], node)) {
        Cell<S>& before = cell_at(size_ - 1);
        before.stop_at_end = true;
        before.end = cell.origin;
    }
    while (!(source_->passage().stretch.to == from_integer<S>(1))) { // the first half of a crumb
        source_->advance();
        pull = source_->prepare(starvation);
        SPLINEFEED_ASSERT(pull == Pull::item);
    }
    JerkNode& next = storage_.nodes[travelled_ + size_ + 1];
    next.at_most_sq = next.expected_sq = to_double(source_->passage().exit_sq);
    ++size_;
    planned_all_ = false;
    source_->advance();
    return Pull::item;
}

template <Scalar S>
Pull JerkPlan<S>::fill(Starvation starvation) noexcept {
    Pull pull = Pull::item;
    while (size_ < storage_.cells.size() && pull == Pull::item) {
        pull = take(size_ == 0 ? starvation : Starvation::waits);
    }
    return pull;
}

// Moves what is not yet travelled to the front of the nodes.
template <Scalar S>
void JerkPlan<S>::forget_travelled() noexcept {
    for (std::size_t i = 0; travelled_ > 0 && i <= size_; ++i) {
        JerkNode& to = storage_.nodes[i];
        const JerkNode& from = storage_.nodes[travelled_ + i];
        to.cell = from.cell;
        to.at_most_sq = from.at_most_sq;
        to.expected_sq = 2 * i < size_ ? from.expected_sq : from.at_most_sq; // the old plan brakes there for nothing
        to.state = from.state;
        to.travel = from.travel;
    }
    travelled_ = 0;
}

// From stop to stop through every cell: crumbs between cusps, and what could not be planned better.
template <Scalar S>
void JerkPlan<S>::mark_hops(std::size_t first, std::size_t end) noexcept {
    for (std::size_t i = first; i < end; ++i) {
        storage_.nodes[i].travel = Travel::hop;
        storage_.nodes[i + 1].state = {0.0, 0.0};
    }
}

template <Scalar S>
bool JerkPlan<S>::plan_leg(std::size_t first, std::size_t end) noexcept {
    const std::span<JerkNode> nodes = storage_.nodes.subspan(first, end - first + 1);
    const bool moves = nodes.front().state.b > 0.0;
    if (nodes.size() <= JerkLeg::fewest_cells) {
        return false;
    }
    const SpeedState start = nodes.front().state;
    const double end_at_most = nodes.back().at_most_sq;
    nodes.back().at_most_sq = nodes.back().expected_sq = 0.0;
    const std::size_t known = first == 0 && moves ? planned_ : 0;
    bool done = false;
    for (int attempt = 0; attempt < attempts && !done; ++attempt) {
        done = JerkLeg(nodes, moves ? &start : nullptr, known).plan(limits_->jerk_tier);
        for (std::size_t i = 1; i + 1 < nodes.size() && !done && attempt + 1 < attempts; ++i) {
            // Where just the old plan is expected, it is possible once more; but not its braking to the end.
            JerkNode& node = nodes[i];
            node.expected_sq =
                i < known ? larger(node.state.b, least_known[attempt] * node.at_most_sq) : 0.5 * node.expected_sq;
        }
    }
    nodes.back().at_most_sq = nodes.back().expected_sq = end_at_most;
    for (std::size_t i = first; i < end && done; ++i) {
        storage_.nodes[i].travel = Travel::curve;
    }
    return done;
}

template <Scalar S>
void JerkPlan<S>::plan(bool ended) noexcept {
    const std::size_t half = (size_ + 1) / 2;
    std::size_t at = 0;
    while (at < size_ && (at == 0 || at < half)) {
        std::size_t end = at + 1;
        while (end < size_ && !cell_at(end - 1).stop_at_end) {
            ++end;
        }
        const bool stops = cell_at(end - 1).stop_at_end || (ended && end == size_);
        if (!stops && at > 0) {
            break;
        }
        const std::size_t committed = stops ? end : half;
        const bool rests = !(storage_.nodes[at].state.b > 0.0);
        if (stops && rests && straight(storage_.nodes.subspan(at, end - at + 1))) {
            for (std::size_t i = at; i < end; ++i) {
                storage_.nodes[i].travel = Travel::line;
            }
            storage_.nodes[end].state = {0.0, 0.0};
            planned_ = end;
            at = end;
        } else if (plan_leg(at, end)) {
            planned_ = end;
            at = committed;
        } else if (!rests) { // the old plan once more, to its end
            SPLINEFEED_ASSERT(at == 0 && planned_ > 0);
            ++slow_legs_;
            at = planned_;
        } else {
            slow_legs_ += end - at > JerkLeg::fewest_cells ? 1U : 0U;
            mark_hops(at, end);
            planned_ = end;
            at = committed;
        }
    }
    committed_ = at;
    planned_all_ = true;
}

// The next passage of a straight move, as far as it lies in the front cell.
template <Scalar S>
void JerkPlan<S>::choose_on_line() noexcept {
    const double length = storage_.nodes[travelled_].cell.length_mm;
    const double per_length = 1.0 / length;
    const JerkNode& node = storage_.nodes[travelled_];
    const bool last = node.travel == Travel::hop || cell().stop_at_end; // the move ends in this cell
    const LinePiece piece = last ? line_.next() : line_.next(length - on_line_mm_);
    const S from = passage_.stretch.from;
    on_line_mm_ = smaller(on_line_mm_ + piece.length_mm, length);
    const bool to_end = last ? line_.done() : !(on_line_mm_ < length);
    passage_ = {};
    passage_.stretch = {from, to_end ? from_integer<S>(1) : from_double<S>(on_line_mm_ * per_length)};
    passage_.entry_sq = from_double<S>(piece.entry_mm_s * piece.entry_mm_s);
    passage_.exit_sq = from_double<S>(piece.exit_mm_s * piece.exit_mm_s);
    passage_.shape = SpeedShape::cubic;
    passage_.duration_ms = from_double<S>(1e3 * piece.duration_s);
    passage_.linear = from_double<S>(piece.linear);
    passage_.quadratic = from_double<S>(piece.quadratic);
    passage_.stops = to_end && line_.done() && cell().stop_at_end;
}

template <Scalar S>
void JerkPlan<S>::choose() noexcept {
    const JerkNode& from = storage_.nodes[travelled_];
    const JerkNode& to = storage_.nodes[travelled_ + 1];
    if (!line_.done()) {
        choose_on_line();
        return;
    }
    passage_ = {};
    on_line_mm_ = 0.0;
    if (from.travel != Travel::curve) {
        std::size_t cells = 1;
        while (from.travel == Travel::line && !cell_at(cells - 1).stop_at_end) {
            ++cells;
        }
        const std::span<const JerkNode> nodes = storage_.nodes.subspan(travelled_, cells + 1);
        double length = 0.0;
        for (const JerkNode& node : nodes.first(cells)) {
            length += node.cell.length_mm;
        }
        line_ = LineTravel(StraightMove(length, from.travel == Travel::line ? limits_of(nodes)
                                                                            : from.cell.move_limits(from.cell.cap_sq)));
        choose_on_line();
        return;
    }
    const auto scalar = [](double x) {
        return from_double<S>(x);
    };
    passage_.entry_sq = scalar(from.state.b);
    passage_.exit_sq = scalar(to.state.b);
    const bool starts = !(passage_.entry_sq > S{});
    const bool stops = !(passage_.exit_sq > S{});
    passage_.stops = stops && cell().stop_at_end;
    if (starts || stops) { // constant jerk, t = 3 L / v
        passage_.shape = SpeedShape::cubic;
        passage_.duration_ms = scalar(3e3 * from.cell.length_mm / square_root(starts ? to.state.b : from.state.b));
        passage_.linear = from_integer<S>(starts ? 0 : 3);
        passage_.quadratic = from_integer<S>(starts ? 0 : -3);
    } else {
        passage_.shape = SpeedShape::parabola;
        passage_.middle_sq = scalar(from.state.b + 0.5 * from.state.slope * from.cell.length_mm);
    }
}

template <Scalar S>
Pull JerkPlan<S>::prepare(Starvation starvation) noexcept {
    if (chosen_) {
        return Pull::item;
    }
    if (committed_ == 0) {
        forget_travelled();
        const Pull pull = fill(starvation);
        if (size_ == 0 || (pull == Pull::starved && starvation == Starvation::waits)) {
            return pull;
        }
        if (planned_all_ && planned_ > 0) {
            committed_ = planned_;
        } else {
            plan(pull == Pull::finished);
        }
    }
    choose();
    chosen_ = true;
    return Pull::item;
}

template <Scalar S>
void JerkPlan<S>::advance() noexcept {
    SPLINEFEED_ASSERT(chosen_);
    chosen_ = false;
    if (!(passage_.stretch.to == from_integer<S>(1))) {
        passage_.stretch.from = passage_.stretch.to;
        return;
    }
    passage_.stretch.from = S{};
    on_line_mm_ = 0.0;
    head_ = (head_ + 1) % storage_.cells.size();
    ++travelled_;
    --size_;
    --committed_;
    --planned_;
}

template <Scalar S>
void JerkPlan<S>::rest_at(S /*fraction*/) noexcept {
    SPLINEFEED_ASSERT(false); // only a steered plan stops anywhere
}

template <Scalar S>
void JerkPlan<S>::steer(S /*fraction*/, S /*speed_sq*/) noexcept {
    SPLINEFEED_ASSERT(false);
}

template <Scalar S>
bool JerkPlan<S>::standing() const noexcept {
    return !chosen_ && line_.done() && !(storage_.nodes[travelled_].state.b > 0.0);
}

template <Scalar S>
void JerkPlan<S>::clear() noexcept {
    SPLINEFEED_ASSERT(standing());
    source_->clear();
    size_ = committed_ = planned_ = travelled_ = 0;
    storage_.nodes[0].state = {0.0, 0.0};
}

template class JerkPlan<double>;
template class JerkPlan<float>;
template class JerkPlan<Fixed>;

} // namespace splinefeed
