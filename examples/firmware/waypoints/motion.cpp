// SPDX-License-Identifier: MIT
#include "waypoints/motion.hpp"

namespace firmware {

using splinefeed::Error;
using splinefeed::Position;
using splinefeed::Pull;
using splinefeed::Status;

namespace {

/// The step nearest to a position.
PerAxis<std::int32_t> counts_at(const PerAxis<Position>& position) {
    PerAxis<std::int32_t> counts{};
    for (unsigned k = 0; k < axes; ++k) {
        counts[k] =
            static_cast<std::int32_t>(scaled(position[k], limits->steps_per_mm_q32[k], 32 + Position::fraction_bits));
    }
    return counts;
}

} // namespace

Status Motion::begin(const splinefeed::Waypoint<Real>& first) noexcept {
    const PerAxis<std::int32_t> counts = counts_at(first.position);
    for (unsigned k = 0; k < axes; ++k) {
        if (counts[k] != steps_.count(k)) {
            return Error::start_elsewhere;
        }
    }
    splinefeed::CurveOptions<Real> options;
    options.axes = static_cast<int>(axes);
    splinefeed::G2Spline<Real>& curve = curve_.build(options);
    if (const Status pushed = curve.push(first); !pushed.ok()) {
        return pushed;
    }
    if (!make_trajectory(curve)) {
        return Error::window_too_small;
    }
    trajectory_.override_feed(feed_ratio_);
    loader_ = splinefeed::DdaLoader(static_cast<int>(axes), tick_ticks);
    steps_.restart();
    program_ = Program::open;
    moved_ = finished_ = hold_asked_ = false;
    energise_drives();
    return {};
}

/// Apart: what it needs on the stack is not below the deepest call. false: the window is too small.
[[gnu::noinline]] bool Motion::make_trajectory(splinefeed::CurveSource<Real>& curve) noexcept {
    const splinefeed::Result<splinefeed::Trajectory<Real>> made =
        splinefeed::Trajectory<Real>::make(curve, *limits, planner_);
    if (made.has_value()) {
        trajectory_ = *made;
    }
    return made.has_value();
}

Status Motion::push(const splinefeed::Waypoint<Real>& waypoint) noexcept {
    if (program_ == Program::none) {
        return begin(waypoint);
    }
    return program_ == Program::open ? curve_->push(waypoint) : Error::no_room; // the next program waits
}

Status Motion::finish() noexcept {
    if (program_ != Program::open) {
        return Error::too_few_waypoints;
    }
    const Status status = curve_->finish();
    if (status.ok()) {
        program_ = Program::closed;
    }
    return status;
}

void Motion::hold() noexcept {
    if (has_program()) {
        trajectory_.hold();
        hold_asked_ = true;
    }
}

void Motion::resume() noexcept {
    if (has_program()) {
        trajectory_.resume();
        hold_asked_ = false;
    }
}

void Motion::abort() noexcept {
    if (has_program()) {
        trajectory_.abort();
        program_ = Program::aborted;
    }
}

void Motion::override_feed(Real ratio) noexcept {
    feed_ratio_ = ratio;
    if (has_program()) {
        trajectory_.override_feed(ratio);
    }
}

bool Motion::set_position(const PerAxis<Position>& position) noexcept {
    if (has_program() || steps_.stopped() != Stop::none || !stands()) {
        return false;
    }
    steps_.set_counts(counts_at(position));
    return true;
}

bool Motion::reset() noexcept {
    if (steps_.stopped() == Stop::none || steps_.active()) {
        return false;
    }
    program_ = Program::none;
    stopped_ = Stop::none;
    steps_.restart();
    steps_.forgive();
    return true;
}

void Motion::plan() noexcept {
    using splinefeed::UnderrunPolicy;
    if (!has_program() || finished_ || steps_.stopped() != Stop::none) {
        return;
    }
    if (steps_.room() == 0) {
        trajectory_.measure_ahead(work_a_call);
        return;
    }
    Pull pull = trajectory_.next(segment_, UnderrunPolicy::wait, work_a_call);
    if (pull == Pull::starved && !trajectory_.at_rest() && steps_.level() <= 1U << lookahead.reserve_log2) {
        pull = trajectory_.next(segment_, UnderrunPolicy::drain, work_a_call);
    }
    if (pull == Pull::item) {
        emit();
    }
    finished_ = pull == Pull::finished;
}

void Motion::emit() noexcept {
    loader_.take(segment_);
    if (loader_.next(part_.ticks)) {
        part_.rest = trajectory_.at_rest();
        part_.end = loader_.end_count();
        steps_.push(part_);
        moved_ = true;
    }
}

Event Motion::next_event() noexcept {
    if (const Stop stop = steps_.stopped(); stop != stopped_) {
        stopped_ = stop;
        return stop == Stop::estop ? Event::estop : Event::limit;
    }
    if (steps_.underruns() != underruns_) {
        underruns_ = steps_.underruns();
        return Event::late;
    }
    if (!has_program() || stopped_ != Stop::none || !stands()) {
        return Event::none;
    }
    if (finished_) {
        const Event event = program_ == Program::aborted ? Event::aborted : Event::done;
        program_ = Program::none;
        return event;
    }
    if (hold_asked_ && trajectory_.state() == Pull::held) {
        hold_asked_ = false;
        return Event::held;
    }
    if (moved_ && trajectory_.state() == Pull::starved) {
        moved_ = false;
        return Event::underrun;
    }
    return Event::none;
}

} // namespace firmware
