// SPDX-License-Identifier: MIT
#include "splinefeed/controller/line_motion.hpp"

namespace splinefeed {

void LineMotion::forget() noexcept {
    event_count_ = 0;
    line_numbers_.clear();
    item_pending_ = waits_ = refused_ = false;
    interpreter_.start(stream_->end());
}

void LineMotion::place(const PerAxis<Position>& position) noexcept {
    const Status placed = stream_->place(position);
    SPLINEFEED_ASSERT(placed.ok());
    static_cast<void>(placed);
    forget();
}

void LineMotion::restart() noexcept {
    stream_->restart();
    forget();
}

BlockStatus LineMotion::push(std::string_view text, std::uint32_t line) noexcept {
    bool executes = true;
    if (values_ != nullptr) {
        if (const BlockStatus status = conditions_.take(text, *values_, interpreter_, executes); !status.ok()) {
            return status;
        }
    }
    return executes ? interpreter_.push(text, line) : BlockStatus{};
}

bool LineMotion::needs_rest() const noexcept {
    switch (item_.kind) {
    case ItemKind::move: return item_.move == MoveKind::probe || item_.move == MoveKind::home;
    case ItemKind::dwell: return true;
    case ItemKind::event: break;
    }
    return item_.event.stops;
}

// What does not wait for its place: its text is that of the line, or it is for the operator's records.
bool LineMotion::is_due_at_once() const noexcept {
    const EventKind kind = item_.event.kind;
    return item_.kind == ItemKind::event && !item_.event.stops &&
           (kind == EventKind::message || kind == EventKind::print || kind == EventKind::debug ||
            kind == EventKind::offsets_changed);
}

// item_, as the path takes it.
PathElement<ProgramScalar> LineMotion::element_of_item() const noexcept {
    const bool rapid = item_.move == MoveKind::rapid;
    PathElement<ProgramScalar> out = item_.element;
    out.feed_mm_s = rapid ? rapid_feed<ProgramScalar> : out.feed_mm_s;
    if (!rapid && !(out.max_feed_mm_s > ProgramScalar{})) {
        out.max_feed_mm_s = to_scalar<ProgramScalar>(settings_->max_feed_mm_s);
    }
    for (const unsigned k : indices(settings_->program.axes)) {
        const bool turns = (settings_->program.rotary_axes >> k & 1U) != 0 && out.to[k] != stream_->end()[k];
        out.tolerance_mm = turns ? smaller(out.tolerance_mm, to_scalar<ProgramScalar>(settings_->rotary_tolerance_deg))
                                 : out.tolerance_mm;
    }
    return out;
}

bool LineMotion::leaves_travel(const PerAxis<Position>& place) const noexcept {
    for (const unsigned k : indices(settings_->program.axes)) {
        if (!settings_->travel[k].holds(to_decimal(place[k]))) {
            return true;
        }
    }
    return false;
}

BlockProgress LineMotion::pass_move() noexcept {
    const bool leaves = item_.element.to != stream_->end() && leaves_travel(item_.element.to);
    if ((item_.stops_before || leaves) && !stream_->rest()) {
        return BlockProgress::full;
    }
    if (leaves) {
        refused_ = true;
        return BlockProgress::done;
    }
    const Result<bool> pushed = stream_->push(element_of_item());
    if (!pushed.has_value()) {
        refused_ = pushed.error() != Error::no_room;
        return refused_ ? BlockProgress::done : BlockProgress::full;
    }
    if (*pushed) {
        line_numbers_.add(stream_->moves() - 1U, item_.line);
    }
    return BlockProgress::done;
}

// Passes on item_.
BlockProgress LineMotion::pass_item() noexcept {
    if (left_travel()) { // behind a move that the path does not take, or give
        return BlockProgress::done;
    }
    const bool at_once = is_due_at_once();
    if (at_once || needs_rest()) {
        if (!at_once && !stream_->stop()) {
            return BlockProgress::full;
        }
        waiting_ = {item_.kind, item_.move, item_.probe, item_.home_axes, item_.dwell_s, item_.event};
        waits_ = true;
        return BlockProgress::waits;
    }
    if (item_.kind == ItemKind::move) {
        return pass_move();
    }
    if (event_count_ == most_events) {
        if (events_[0].behind == stream_->moves()) { // all behind one move: it ends at rest, and they happen
            stream_->rest();
        }
        return BlockProgress::full;
    }
    events_[event_count_++] = {item_.event, stream_->moves()};
    return BlockProgress::done;
}

BlockProgress LineMotion::pass_on() noexcept {
    for (;;) {
        if (waits_) {
            return BlockProgress::waits;
        }
        if (!item_pending_ && interpreter_.next(item_) != Pull::item) {
            return BlockProgress::done;
        }
        const BlockProgress progress = pass_item();
        item_pending_ = progress == BlockProgress::full;
        if (progress != BlockProgress::done) {
            return progress;
        }
    }
}

void LineMotion::leave_out() noexcept {
    while (interpreter_.next(item_) == Pull::item) {
    }
    item_pending_ = false;
}

void LineMotion::carried_out() noexcept {
    waits_ = false;
    stream_->go_on();
}

void LineMotion::begin_waiting() noexcept {
    stream_->go_on();
    refused_ = refused_ || !stream_->push(element_of_item()).has_value();
    stream_->stop();
}

// The whole way is shortened, so that it keeps its direction.
void LineMotion::cut(PathElement<ProgramScalar>& element) const noexcept {
    const PerAxis<Position>& here = stream_->end();
    constexpr int bits = 30;
    constexpr std::int64_t whole = std::int64_t{1} << bits;
    std::int64_t part = whole;
    for (const unsigned k : indices(settings_->program.axes)) {
        const AxisTravel& travel = settings_->travel[k];
        const std::int64_t way = element.to[k].raw - here[k].raw;
        if (!travel.limited || way == 0) {
            continue;
        }
        const std::int64_t left = to_position(way > 0 ? travel.high : travel.low).raw - here[k].raw;
        const bool out = (left > 0) != (way > 0);
        const std::int64_t most = out ? 0 : left;
        if (out || (way > 0 ? most < way : most > way)) {
            const auto magnitude = static_cast<std::uint64_t>(way > 0 ? way : -way);
            const std::int64_t share = product_quotient(most > 0 ? most : -most, whole, magnitude).raw;
            part = share < part ? share : part;
        }
    }
    for (const unsigned k : indices(settings_->program.axes)) {
        const std::int64_t way = element.to[k].raw - here[k].raw;
        element.to[k].raw = part == whole ? element.to[k].raw : here[k].raw + product_quotient(way, part, whole).raw;
    }
}

BlockProgress LineMotion::pass_jog() noexcept {
    for (;;) {
        if (!item_pending_) {
            if (interpreter_.next(item_) != Pull::item) {
                return BlockProgress::done;
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
        const BlockProgress progress = pass_move();
        item_pending_ = progress == BlockProgress::full;
        if (item_pending_) {
            return progress;
        }
    }
}

bool LineMotion::take_event(ProgramEvent& out) noexcept {
    if (event_count_ == 0 || !stream_->passed(events_[0].behind)) {
        return false;
    }
    out = events_[0].event;
    --event_count_;
    for (std::size_t i = 0; i < event_count_; ++i) {
        events_[i] = events_[i + 1];
    }
    return true;
}

// The input pauses: a curve ends in its last point, as far as the path has room for it.
void LineMotion::let_go() noexcept {
    interpreter_.end_curve();
    if (interpreter_.has_curve()) {
        static_cast<void>(pass_on());
    }
}

Pull LineMotion::next(FeedSegment& out, Supply supply) noexcept {
    if (supply == Supply::pauses) {
        let_go();
    }
    const bool full = event_count_ == most_events; // no more lines come
    return stream_->next(out, full ? stream_->early(supply) : supply, settings_->work_a_call);
}

} // namespace splinefeed
