// SPDX-License-Identifier: MIT
#include "tp_motion.hpp"

#include "splinefeed/number/vector.hpp"
#include "splinefeed/s3_feed_plan/limits/limit_errors.hpp"
#include "splinefeed/s3_feed_plan/limits/machine_path_rules.hpp"

#include <cmath>

namespace splinefeed::linuxcnc {

namespace {

constexpr double least_segment_s = 0.001; // with a jerk limit: a search takes as long, however short the period is
constexpr double steps_per_mm = 1024.0;   // +-2^21 mm; a segment's unit is 3e-13 mm
constexpr int fewest_ahead = 3;           // segments that are ready: two are needed, one is made
constexpr int probing_with_jerk = 20;     // the least that a search for a stop usually needs
constexpr unsigned part = 4;              // steps of planning between two looks at the clock
constexpr double no_limit_mm_s = 65536.0;
constexpr double most_feed_mm_s = 10'000.0; // that MotionLimits accepts
constexpr double at_rest = 0.3;             // of the time without a new move: a stop more costs less there
constexpr double between_changes_s = 0.004; // of an override that changes all the time, as an adaptive feed may
constexpr double with_jerk_s = 0.1;         // a search for each
constexpr unsigned kept_by_path = 2;        // moves: what becomes of a joint depends on two behind it
constexpr unsigned most_pushed = 4;         // moves, between two looks at the clock

MachineSettings settings_of(const tpc_machine& machine) noexcept {
    MachineSettings out;
    out.axes = machine.axes;
    out.max_feed_mm_s = 0.0;
    double segment_s = machine.period_s;
    for (const unsigned k : indices(machine.axes)) {
        AxisSettings& axis = out.axis[k];
        axis.rotary = machine.axis[k] >= 3 && machine.axis[k] <= 5;
        const double mm = axis.rotary ? 1.0 : machine.mm_per_unit;
        axis.max_velocity_mm_s = machine.velocity[k] * mm;
        axis.max_acceleration_mm_s2 = machine.acceleration[k] * mm;
        axis.max_jerk_mm_s3 = machine.jerk[k] * mm;
        axis.steps_per_mm = steps_per_mm;
        segment_s = machine.jerk[k] > 0.0 ? larger(segment_s, least_segment_s) : segment_s;
        out.max_feed_mm_s += axis.max_velocity_mm_s * axis.max_velocity_mm_s;
    }
    out.max_feed_mm_s = smaller(most_feed_mm_s, std::sqrt(out.max_feed_mm_s)); // each axis may be as fast as that
    out.sample_period_us = static_cast<int>(segment_s * 1e6 + 0.5);
    return out;
}

PathMode mode_of(tpc_mode mode) noexcept {
    return mode == TPC_CONTINUOUS   ? PathMode::continuous
           : mode == TPC_EXACT_PATH ? PathMode::exact_path
                                    : PathMode::exact_stop;
}

/// Unit directions at the ends of an arc, in its plane.
void set_directions(const PathElement<double>& element, const Mm& from, QueuedMove& out) noexcept {
    const auto& n = element.arc.normal;
    const double turns = element.arc.sweep_rad < 0.0 ? -1.0 : 1.0;
    for (const bool at_end : {false, true}) {
        std::array<double, 3> r{};
        for (unsigned k = 0; k < 3; ++k) {
            r[k] = (at_end ? out.to[k] : from[k]) - to_mm(element.arc.centre[k]);
        }
        std::array<double, 3> along{n[1] * r[2] - n[2] * r[1], n[2] * r[0] - n[0] * r[2], n[0] * r[1] - n[1] * r[0]};
        const double length = std::sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
        for (unsigned k = 0; k < 3 && length > 0.0; ++k) {
            (at_end ? out.out : out.in)[k] = turns * along[k] / length;
        }
    }
}

} // namespace

void TpMotion::create(const tpc_settings& settings, const tpc_machine& machine) noexcept {
    settings_ = settings;
    settings_.ahead = smaller(larger(settings.ahead, fewest_ahead), most_ahead);
    machine_ = machine;
    rules_ = path_rules(settings_of(machine));
}

Mm TpMotion::mm_of(const double* position) const noexcept {
    return each(machine_.axes, [&](unsigned k) { return position[machine_.axis[k]] * scale(k); });
}

// At standstill; what is queued stays.
void TpMotion::leave_path() noexcept {
    ring_head_ = ring_count_ = 0;
    state_ = State::no_path;
    has_now_ = refills_ = brakes_ = false;
    in_now_s_ = 0.0;
}

void TpMotion::forget() noexcept {
    leave_path();
    first_ = pushed_ = last_;
    failed_ = false;
    end_ = at_;
}

// Whatever the core refuses: the machine brakes on its path, or stays where it is, and nothing else of what is queued
// is travelled. Without that, what comes behind a refused move would begin elsewhere.
void TpMotion::fail(const char* reason) noexcept {
    if (!failed_) {
        error_ = reason;
        failed_ = true;
    }
}

void TpMotion::set(const double* position) noexcept {
    forget();
    at_ = end_ = mm_of(position);
}

// The length of a move from there, and its directions. 0; or -1: it has no length; or the core's error.
int TpMotion::measure(const Mm& from, QueuedMove& out) noexcept {
    Mm straight = difference(out.to, from, machine_.axes);
    const double length_sq = dot(straight, straight, machine_.axes);
    if (length_sq > 0.0) {
        divide(straight, std::sqrt(length_sq), machine_.axes);
    } else {
        straight = {};
    }
    out.in = out.out = straight;
    const PerAxis<Position> start = position_from_mm(from, machine_.axes);
    if (out.element.shape == MoveShape::arc) {
        set_directions(out.element, from, out);
    }
    const Result<double> way = BlendedPath<double>::length_of(start, out.element, machine_.axes);
    if (!way.has_value()) {
        return static_cast<int>(way.error());
    }
    out.length_mm = *way / chord_units_per_mm;
    return *way > 0.0 ? 0 : -1;
}

int TpMotion::add(const tpc_move& from) noexcept {
    QueuedMove& out = move(last_);
    out = {};
    PathElement<double>& element = out.element;
    element.shape = from.arc != 0 ? MoveShape::arc : MoveShape::line;
    element.mode = mode_of(from.mode);
    element.stop_at_end = from.stops != 0;
    element.tolerance_mm = from.tolerance * machine_.mm_per_unit;
    element.chain_tolerance_mm =
        (from.joins > 0.0 ? from.joins * machine_.mm_per_unit : element.tolerance_mm) * rules_.chain_quarters / 4.0;
    out.to = mm_of(from.to);
    for (const unsigned k : indices(machine_.axes)) {
        if (!position_representable(out.to[k]) || !position_representable(end_[k])) {
            return static_cast<int>(Error::position_out_of_range);
        }
        element.to[k] = position_from_mm(out.to[k]);
    }
    for (unsigned k = 0; from.arc != 0 && k < 3; ++k) {
        element.arc.centre[k] = position_from_mm(from.centre[k] * machine_.mm_per_unit);
        element.arc.normal[k] = from.normal[k];
    }
    element.arc.sweep_rad = from.sweep_rad;
    if (const int error = measure(end_, out); error != 0) {
        return error;
    }
    element.feed_mm_s = from.rapid != 0 ? rapid_feed<double> : from.feed * feed_mm(out);
    out.stands_before = from.stands_before != 0;
    out.pitch_mm = from.pitch * machine_.mm_per_unit;
    out.probes = from.probes != 0;
    out.taps = from.taps != 0;
    if (out.taps) {
        out.bottom = out.to;
        out.to = end_;
    }
    end_ = out.to;
    ++last_;
    idle_ = 0;
    return 0;
}

// A path begins at standstill, with the limits of this moment.
void TpMotion::begin(const tpc_machine& machine) noexcept {
    machine_ = machine;
    share_ns_ = static_cast<long long>(settings_.share * machine.period_s * 1e9);
    if (move(first_).pitch_mm > 0.0) {
        state_ = State::sync_waits;
        sync_.start(machine.period_s);
        return;
    }
    if (const char* const reason = begin_path(); reason != nullptr) {
        fail(reason);
    }
}

// What is wrong; nullptr: nothing.
const char* TpMotion::begin_path() noexcept {
    const bool leads = state_ == State::leads;
    leave_path();
    const MachineSettings settings = settings_of(machine_);
    const auto made = MotionLimits<double>::make(settings);
    if (!made.has_value()) {
        return describe(made.error());
    }
    limits_ = *made;
    const double segments = machine_.period_s * ticks_per_s / limits_.segment_ticks;
    per_period_ = larger(1U, static_cast<unsigned>(segments + 0.5));
    rules_ = path_rules(settings);
    rules_.roundest = limits_.jerk_limited ? 1.0 : 2.0;
    const PerAxis<Position> start = position_from_mm(at_, machine_.axes);
    Planner<double>& planner = limits_.jerk_limited ? static_cast<Planner<double>&>(jerk_) : acceleration_;
    stream_.build(limits_, planner, rules_, &curve_);
    if (const Status placed = stream_->place(start); !placed.ok()) {
        return describe(placed.error());
    }
    base_ = floor_ = begun_ = front_ = pushed_;
    begun_at_ = at_;
    if (const Status led = leads ? lead() : Status{}; !led.ok()) {
        return describe(led.error());
    }
    state_ = State::path;
    neared_ = piece_ = pushed_ - 1U;
    sent_abort_ = false;
    ratio_ = rapids_ = PacedValue(1.0);
    most_ = PacedValue(no_limit_mm_s);
    return nullptr;
}

void TpMotion::steer(const tpc_input& input) noexcept {
    const bool abort = input.abort != 0 || failed_;
    if (abort && !sent_abort_) {
        stream_->abort();
        sent_abort_ = true;
    }
    const double pace_s = limits_.jerk_limited ? with_jerk_s : between_changes_s;
    if (pushed_ == first_ && !has_now_) { // nothing is planned
        stepped_ = input.steps != 0;
    }
    const bool parts = input.steps != 0 && !stepped_ && !backs(); // to take it apart, it stands
    const bool stops = input.hold != 0 || !(input.max_feed > 0.0) || parts || brakes_;
    if (ratio_.take(stops ? 0.0 : input.ratio, machine_.period_s, pace_s)) {
        stream_->override_feed(Fixed::from_double(ratio_.value()));
    }
    if (rapids_.take(input.rapids, machine_.period_s, pace_s)) {
        stream_->override_rapids(Fixed::from_double(rapids_.value()));
    }
    const double most = smaller(input.max_feed * machine_.mm_per_unit, no_limit_mm_s);
    if (most > 0.0 && most_.take(most, machine_.period_s, pace_s)) {
        stream_->limit_feed(Fixed::from_double(most_.value()));
    }
}

// Gives the stream one more move; false: none may go now.
bool TpMotion::push_one(bool may_begin) noexcept {
    if (pushed_ == last_ || backs() || (stepped_ && pushed_ != first_)) {
        return false;
    }
    const QueuedMove& next = move(pushed_);
    if (next.stands_before) {
        state_ = stream_->stop() && at_known_end() ? State::path_waits : State::path;
        if (state_ == State::path || !may_begin || next.pitch_mm > 0.0) {
            return false;
        }
        stream_->go_on();
        if (next.element.stop_at_end || move(pushed_ - 1U).element.stop_at_end) {
            curve_.forget(); // an axis is unlocked or locked here
        }
    }
    const Result<bool> taken = stream_->push(next.element);
    if (!taken.has_value()) {
        if (taken.error() != Error::no_room) {
            fail(describe(taken.error())); // never: add() has asked
        }
        return false;
    }
    state_ = State::path;
    ++pushed_;
    if (stepped_) {
        stream_->stop();
    }
    return true;
}

bool TpMotion::push_moves(bool may_begin) noexcept {
    unsigned n = 0;
    while (n < most_pushed && push_one(may_begin)) {
        ++n;
    }
    return n > 0;
}

// No move came for a while: the path ends with the one that was kept. A plan with a jerk limit takes periods to be
// made: half of the ring. The other one waits for moves as long as there are segments.
bool TpMotion::pauses() const noexcept {
    return ring_count_ < (limits_.jerk_limited ? ahead_ / 2U : 1U + per_period_) && stream_->keeps_back() &&
           idle_ * machine_.period_s >= (stands() ? at_rest : 1.0) * settings_.idle_s;
}

// A path begins once its first move may be left as fast as it can be, and the segments that are made at once need not
// slow down: what is known behind them is long enough to brake. Else they would be planned to a stop, and they stay.
bool TpMotion::knows_enough() noexcept {
    double acceleration = largest<double>();
    double jerk = largest<double>();
    double fastest_sq = 0.0;
    for (const unsigned k : indices(machine_.axes)) {
        const double velocity = machine_.velocity[k] * scale(k);
        acceleration = smaller(acceleration, machine_.acceleration[k] * scale(k));
        jerk = machine_.jerk[k] > 0.0 ? smaller(jerk, machine_.jerk[k] * scale(k)) : jerk;
        fastest_sq += velocity * velocity;
    }
    const auto braking_mm = [&](double speed) {
        return 0.5 * speed * (speed / acceleration + acceleration / jerk);
    };
    const QueuedMove& first = move(base_);
    double behind_mm = 0.0;
    const unsigned kept = kept_by_path + (stream_->keeps_back() ? 1U : 0U);
    for (unsigned n = base_ + 1U; static_cast<int>(pushed_ - kept - n) > 0; ++n) {
        behind_mm += move(n).length_mm;
    }
    const double feed = first.element.feed_mm_s;
    const double speed = feed == rapid_feed<double> ? std::sqrt(fastest_sq) : smaller(feed, std::sqrt(fastest_sq));
    const double at_once_s = ahead_ * (static_cast<double>(limits_.segment_ticks) / ticks_per_s);
    const double soon = smaller(speed, at_once_s * smaller(acceleration, 0.5 * jerk * at_once_s));
    const double least_mm = 0.5 * soon * at_once_s + braking_mm(soon);
    return (behind_mm >= smaller(first.length_mm, braking_mm(speed)) && first.length_mm + behind_mm >= least_mm) ||
           !stream_->has_room();
}

// A search of the plan with jerk begins anew where the motion went on without its result. So it gets the time of a full
// ring: until that is full, the motion goes on by the old plan. false: the share of the period was not enough.
bool TpMotion::plan(bool may_begin) noexcept {
    const long long end = settings_.now_ns() + share_ns_;
    const int probing = limits_.jerk_limited ? probing_with_jerk : fewest_ahead;
    const int ahead = move(first_).probes ? smaller(probing, settings_.ahead) : settings_.ahead;
    ahead_ = per_period_ * static_cast<unsigned>(ahead);
    static_cast<void>(push_moves(may_begin));
    Supply supply = Supply::flows;
    while (ring_count_ < ahead_) {
        const bool over = settings_.now_ns() >= end;
        const bool moves = !stream_->at_rest();
        const bool needed = ring_count_ <= per_period_ && moves;
        if (over && !needed) {
            return false;
        }
        refills_ = (refills_ || (over && limits_.jerk_limited)) && moves;
        const bool urgent = over || refills_;
        FeedSegment& out = ring_[(ring_head_ + ring_count_) % ring_size];
        const Supply asked = urgent ? Supply::urgent : backs() ? Supply::late : stream_->early(supply);
        const Pull pull = stream_->next(out, asked, urgent ? 1U : part);
        if (pull == Pull::item) {
            ++ring_count_;
            figures_.urgent += urgent ? 1U : 0U;
            supply = Supply::flows;
        } else if (pull == Pull::busy) {
            ++figures_.busy;
            if (over) { // it has no plan to go on by, so it stands
                return false;
            }
        } else if (pull != Pull::starved) {
            if (const Status path = stream_->status(); !path.ok()) {
                fail(describe(path.error()));
            }
            return true;
        } else if (backs()) {
            state_ = stands() ? State::back_over : state_;
            return true;
        } else if (push_moves(may_begin)) {
            continue;
        } else if (pauses()) {
            supply = Supply::pauses;
        } else if (ring_count_ > per_period_ || supply != Supply::flows || over || (!has_now_ && !knows_enough())) {
            return true; // or there is time for moves to come
        } else {
            supply = Supply::late;
        }
    }
    refills_ = false;
    while (settings_.now_ns() < end && stream_->trajectory().plan_ahead(part)) {
    }
    return true;
}

} // namespace splinefeed::linuxcnc
