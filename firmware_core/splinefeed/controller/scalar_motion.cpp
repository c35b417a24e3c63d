// SPDX-License-Identifier: MIT
#include "splinefeed/controller/scalar_motion.hpp"

#include "splinefeed/number/instantiate.hpp"

namespace splinefeed {

namespace {

template <Scalar S>
S percent(int value) noexcept {
    return from_integer<S>(value) / from_integer<S>(100);
}

} // namespace

template <Scalar S>
ScalarMotion<S>::ScalarMotion(const ControllerSettings& settings, const MotionLimits<S>& limits, Planner<S>& planner,
                              const PathRules<S>& rules, PointCurve<S>* points) noexcept
    : settings_(&settings), limits_(&limits), planner_(&planner), rules_(rules),
      interpreter_(settings.program, nullptr, points) {
    place({});
}

template <Scalar S>
void ScalarMotion<S>::build_path() noexcept {
    path_.build(limits_->axes, rules_);
    guard_.build(*path_, settings_->travel, limits_->axes);
    const Status status = path_->start(here_);
    SPLINEFEED_ASSERT(status.ok());
    static_cast<void>(status);
    pushed_ = reached_ = 0;
    event_count_ = 0;
    line_numbers_.clear();
    item_pending_ = holds_ = waits_ = refused_ = false;
    exhausted_ = at_rest_ = true;
}

template <Scalar S>
void ScalarMotion<S>::place(const PerAxis<Position>& position) noexcept {
    here_ = place_ = position;
    moved_ = false;
    build_path();
    const Result<Trajectory<S>> made = Trajectory<S>::make(*guard_, *limits_, *planner_);
    SPLINEFEED_ASSERT(made.has_value());
    trajectory_ = *made;
    interpreter_.start(here_);
}

template <Scalar S>
void ScalarMotion<S>::restart() noexcept {
    here_ = moved_ ? trajectory_.position() : place_;
    build_path();
    const Status status = trajectory_.start(*guard_);
    SPLINEFEED_ASSERT(status.ok());
    static_cast<void>(status);
    trajectory_.resume();
    interpreter_.start(here_);
}

template <Scalar S>
void ScalarMotion<S>::set_overrides(int feed, int rapids) noexcept {
    trajectory_.override_feed(percent<S>(feed));
    trajectory_.override_rapids(percent<S>(rapids));
}

// The move that waits goes into the path. false: there is no room
template <Scalar S>
bool ScalarMotion<S>::release(bool stops) noexcept {
    if (!holds_) {
        return true;
    }
    if (left_travel()) { // the path gives nothing more, so it may never have room
        holds_ = false;
        return true;
    }
    if (!path_->has_room()) {
        return false;
    }
    held_.stop_at_end = held_.stop_at_end || stops;
    holds_ = false;
    exhausted_ = false;
    if (path_->push(held_).ok()) {
        line_numbers_.add(pushed_++, held_line_);
    } else {
        refused_ = true;
    }
    return true;
}

template <Scalar S>
bool ScalarMotion<S>::needs_rest() const noexcept {
    switch (item_.kind) {
    case ItemKind::move: return item_.move == MoveKind::probe || item_.move == MoveKind::home;
    case ItemKind::dwell: return true;
    case ItemKind::event: break;
    }
    return item_.event.stops;
}

// What does not wait for its place: its text is that of the line, or it is for the operator's records.
template <Scalar S>
bool ScalarMotion<S>::is_due_at_once() const noexcept {
    const EventKind kind = item_.event.kind;
    return item_.kind == ItemKind::event && !item_.event.stops &&
           (kind == EventKind::message || kind == EventKind::print || kind == EventKind::debug ||
            kind == EventKind::offsets_changed);
}

// item_ is the next move to wait.
template <Scalar S>
void ScalarMotion<S>::take_move() noexcept {
    const bool rapid = item_.move == MoveKind::rapid;
    held_ = item_.element;
    held_line_ = item_.line;
    held_.feed_mm_s = rapid ? rapid_feed<S> : held_.feed_mm_s;
    if (!rapid && !(held_.max_feed_mm_s > S{})) {
        held_.max_feed_mm_s = to_scalar<S>(settings_->max_feed_mm_s);
    }
    for (const unsigned k : indices(limits_->axes)) {
        const bool turns = (settings_->program.rotary_axes >> k & 1U) != 0 && held_.to[k] != here_[k];
        held_.tolerance_mm =
            turns ? smaller(held_.tolerance_mm, to_scalar<S>(settings_->rotary_tolerance_deg)) : held_.tolerance_mm;
    }
    here_ = held_.to;
    holds_ = true;
}

template <Scalar S>
bool ScalarMotion<S>::leaves_travel(const PerAxis<Position>& place) const noexcept {
    for (const unsigned k : indices(limits_->axes)) {
        if (!settings_->travel[k].holds(to_decimal(place[k]))) {
            return true;
        }
    }
    return false;
}

template <Scalar S>
LineProgress ScalarMotion<S>::pass_move() noexcept {
    const Result<S> length = BlendedPath<S>::length_of(here_, item_.element, limits_->axes);
    if (!length.has_value()) {
        refused_ = true;
        return LineProgress::done;
    }
    if (!(*length > S{})) { // too short to be a move: what stops there stops before it
        held_.stop_at_end = held_.stop_at_end || item_.element.stop_at_end;
        return LineProgress::done;
    }
    const bool leaves = leaves_travel(item_.element.to);
    if (!release(item_.stops_before || leaves)) {
        return LineProgress::full;
    }
    if (leaves) {
        refused_ = true;
    } else {
        take_move();
    }
    return LineProgress::done;
}

// item_.
template <Scalar S>
LineProgress ScalarMotion<S>::pass_item() noexcept {
    if (left_travel()) { // behind a move that the path does not take, or give
        return LineProgress::done;
    }
    const bool at_once = is_due_at_once();
    if (at_once || needs_rest()) {
        if (!at_once && !release(true)) {
            return LineProgress::full;
        }
        waiting_ = {item_.kind, item_.move, item_.probe, item_.home_axes, item_.dwell_s, item_.event};
        waits_ = true;
        return LineProgress::waits;
    }
    if (item_.kind == ItemKind::move) {
        return pass_move();
    }
    if (event_count_ == most_events) {
        return LineProgress::full;
    }
    events_[event_count_++] = {item_.event, pushed_ + (holds_ ? 1U : 0U)};
    return LineProgress::done;
}

template <Scalar S>
LineProgress ScalarMotion<S>::pass_on() noexcept {
    for (;;) {
        if (waits_) {
            return LineProgress::waits;
        }
        if (!item_pending_ && interpreter_.next(item_) != Pull::item) {
            return LineProgress::done;
        }
        const LineProgress progress = pass_item();
        item_pending_ = progress == LineProgress::full;
        if (progress != LineProgress::done) {
            return progress;
        }
    }
}

template <Scalar S>
void ScalarMotion<S>::leave_out() noexcept {
    while (interpreter_.next(item_) == Pull::item) {
    }
    item_pending_ = false;
}

template <Scalar S>
void ScalarMotion<S>::begin_waiting() noexcept {
    take_move();
    release(true);
}

// The whole way is shortened, so that it keeps its direction.
template <Scalar S>
void ScalarMotion<S>::cut(PathElement<S>& element) const noexcept {
    constexpr int bits = 30;
    constexpr std::int64_t whole = std::int64_t{1} << bits;
    std::int64_t part = whole;
    for (const unsigned k : indices(limits_->axes)) {
        const AxisTravel& travel = settings_->travel[k];
        const std::int64_t way = element.to[k].raw - here_[k].raw;
        if (!travel.limited || way == 0) {
            continue;
        }
        const std::int64_t left = to_position(way > 0 ? travel.high : travel.low).raw - here_[k].raw;
        const bool out = (left > 0) != (way > 0);
        const std::int64_t most = out ? 0 : left;
        if (out || (way > 0 ? most < way : most > way)) {
            const auto magnitude = static_cast<std::uint64_t>(way > 0 ? way : -way);
            const std::int64_t share = product_quotient(most > 0 ? most : -most, whole, magnitude).raw;
            part = share < part ? share : part;
        }
    }
    for (const unsigned k : indices(limits_->axes)) {
        const std::int64_t way = element.to[k].raw - here_[k].raw;
        element.to[k].raw = part == whole ? element.to[k].raw : here_[k].raw + product_quotient(way, part, whole).raw;
    }
}

template <Scalar S>
LineProgress ScalarMotion<S>::pass_jog() noexcept {
    for (;;) {
        if (!item_pending_) {
            if (interpreter_.next(item_) != Pull::item) {
                return LineProgress::done;
            }
            if (item_.kind != ItemKind::move) {
                continue;
            }
            const PerAxis<Position> to = item_.element.to;
            cut(item_.element);
            item_.element.max_feed_mm_s = item_.element.feed_mm_s; // no override makes it faster
            if (item_.element.to != to) {
                interpreter_.start(item_.element.to);
            }
        }
        const LineProgress progress = pass_move();
        item_pending_ = progress == LineProgress::full;
        if (item_pending_) {
            return progress;
        }
    }
}

template <Scalar S>
bool ScalarMotion<S>::take_event(ProgramEvent& out) noexcept {
    if (event_count_ == 0) {
        return false;
    }
    const auto ahead = static_cast<std::int32_t>(events_[0].behind - reached_);
    if (ahead > 0 && !exhausted()) {
        return false;
    }
    out = events_[0].event;
    --event_count_;
    for (std::size_t i = 0; i < event_count_; ++i) {
        events_[i] = events_[i + 1];
    }
    return true;
}

template <Scalar S>
bool ScalarMotion<S>::look_ahead() noexcept {
    const bool full = !path_->has_room();
    trajectory_.measure_ahead(settings_->work_a_call);
    return full && path_->has_room();
}

// The input pauses: a curve ends in its last point, as far as the path has room for it, and a move at rest.
template <Scalar S>
void ScalarMotion<S>::let_go() noexcept {
    interpreter_.end_curve();
    if (interpreter_.has_curve()) {
        static_cast<void>(pass_on());
    }
    release(true); // there is no room for it while the curve has more
}

template <Scalar S>
Pull ScalarMotion<S>::next(FeedSegment& out, Supply supply) noexcept {
    const bool pauses = supply == Supply::pauses;
    if (pauses) {
        let_go();
    }
    const UnderrunPolicy underrun = supply == Supply::flows ? UnderrunPolicy::wait : UnderrunPolicy::drain;
    const Pull pull = trajectory_.next(out, underrun, settings_->work_a_call);
    if (pull == Pull::item) {
        moved_ = true;
        at_rest_ = out.ends_at_rest();
        reached_ = out.waypoint;
    } else if (at_rest_ && !holds_ && pauses && pull != Pull::held && pull != Pull::busy) {
        exhausted_ = true;
        reached_ = pushed_;
    }
    return pull;
}

#if SPLINEFEED_MAX_DEGREE >= 5
SPLINEFEED_INSTANTIATE_CLASS(ScalarMotion)
#endif

} // namespace splinefeed
