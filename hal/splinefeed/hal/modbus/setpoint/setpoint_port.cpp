// SPDX-License-Identifier: MIT
//
// A drive counts its own positions: its position at the start of the motion becomes a constant offset, so that nothing
// jumps. If a drive is in fault or offline, the motion's clock slows down for all others, which stay on the path. The
// offline drive stops by itself and leaves the path.
#include "splinefeed/hal/modbus/setpoint/setpoint_port.hpp"

#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/rt/wait_until.hpp"

#include <algorithm>

namespace splinefeed::hal::modbus {

namespace {

constexpr std::uint64_t lead_us = 50'000;
constexpr std::uint64_t retain_us = 100'000;      // of past segments: bus threads may still read them
constexpr std::uint64_t spare_us = 50'000;        // of the buffer: a poll may be late
constexpr std::uint64_t settle_us = 50'000;       // settling time of the shafts
constexpr std::uint64_t slowest = 4;              // A motion may take so many times its own time,
constexpr std::uint64_t patience_us = 10'000'000; // and this more, while late targets stop all drives.
constexpr std::uint64_t poll_interval_us = 1000;
constexpr std::uint64_t longest_poll_us = 100'000; // a process that stood still tells nothing about a line
constexpr unsigned stop_turns = 10;                // periods of a bus until a command and its status have passed

} // namespace

SetpointPort::SetpointPort(const std::vector<SetpointWiring>& wiring, const SetpointPortSettings& settings)
    : settings_(settings), motion_(std::make_unique<SetpointMotion>(0, settings.reserve_us)), group_(wiring, settings_),
      facts_(wiring.size()), stop_(wiring.size(), {}) {
    order(settings.orders);
}

PortFailure SetpointPort::open() {
    return trouble_ = group_.open();
}

PortFailure SetpointPort::await_standstill() {
    return trouble_ = group_.await_standstill(orders());
}

LinkAnswer SetpointPort::probe(std::size_t drive) noexcept {
    static_cast<void>(group_.drive(drive).read_next());
    return group_.drive(drive).last_answer();
}

PortFailure SetpointPort::prepare(const FeedSegment& first) {
    return begin_motion(first, false);
}

// The drives keep the meaning of their positions: each stop would add what a shaft dithers.
PortFailure SetpointPort::renew(const FeedSegment& first) {
    return begin_motion(first, true);
}

// The threads of the motion before end first: they use what is made anew.
PortFailure SetpointPort::begin_motion(const FeedSegment& first, bool placed) {
    group_.reset();
    motion_ = std::make_unique<SetpointMotion>(0, settings_.reserve_us);
    stop_.reset();
    trouble_ = {};
    phases_ = SetpointPhases(setpoint_table(), Phase::filling);
    stood_since_us_ = arrived_since_us_ = time_us_ = bounded_time_us_ = lag_us_ = submitted_ = 0;
    late_ = false;
    PortFailure trouble = group_.make_ready(first, placed ? PortOrders{} : orders(), placed);
    set_times();
    make_room(first);
    group_.start(*motion_);
    began_us_ = bounded_us_ = settings_.clock->now_us();
    referenced_ = !trouble;
    if (referenced_) {
        return {};
    }
    fail(std::move(trouble));
    for (std::size_t i = 0; i < group_.size(); ++i) {
        if (group_.homing(i)) {
            stop_.request(i, StopRequest::quick_stop, began_us_);
        }
    }
    await_stop();
    return trouble_;
}

void SetpointPort::set_times() {
    motion_->ahead_us = group_.ahead_us();
    const std::uint64_t turns_us = stop_turns * std::uint64_t{period_us()} * group_.size() + standstill_us;
    stop_times_.hold_us = lead_us + std::uint64_t{2} * settings_.reserve_us + turns_us + group_.answers_us();
    stop_times_.quick_stop_us += turns_us;
    stop_times_.disable_us += turns_us;
    stop_.set_times(stop_times_);
    phases_.set_bounds(setpoint_bounds({settings_.reserve_us, settings_.away_us, longest_stop_us()}));
}

// The buffer has room for what it has to hold ahead, in segments as short as the first one.
void SetpointPort::make_room(const FeedSegment& first) {
    segment_ticks_ = std::max<std::uint64_t>(1, first.duration_ticks);
    const auto ahead_us = static_cast<std::uint32_t>(motion_->ahead_us);
    settings_.buffer_us = std::max(settings_.buffer_us, 2 * (settings_.reserve_us + ahead_us));
    const std::uint64_t held_us = retain_us + settings_.buffer_us + period_us() + spare_us;
    motion_->trajectory.reset(held_us * ticks_per_us / segment_ticks_ + 2);
}

void SetpointPort::complete() noexcept {
    {
        const std::lock_guard lock(motion_->mutex);
        motion_->complete = motion_->trajectory.ends_at_rest();
    }
    if (!motion_->complete && !stop_.requested()) {
        begin_stop(StopRequest::hold);
    }
}

void SetpointPort::close() noexcept {
    if (began_us_ != 0 && phases_.phase() != Phase::done) {
        if (!stop_.requested()) {
            begin_stop(StopRequest::hold);
        }
        await_stop();
    }
    began_us_ = 0;
    group_.stop();
}

int SetpointPort::room() const noexcept {
    if (!accepts_segments()) {
        return 0;
    }
    const std::lock_guard lock(motion_->mutex);
    const std::uint64_t now = motion_->clock.time(settings_.clock->now_us());
    const std::uint64_t held = motion_->trajectory.end_us() - std::min(now, motion_->trajectory.end_us());
    const std::uint64_t most = settings_.buffer_us + period_us();
    const std::uint64_t room = held < most ? (most - held) * ticks_per_us / segment_ticks_ + 1 : 0;
    return static_cast<int>(std::min<std::uint64_t>(room, motion_->trajectory.room()));
}

// The clock is looked at a period ahead, and the caller may be late by a poll or two.
std::uint64_t SetpointPort::least_ahead_us() const noexcept {
    constexpr std::uint64_t late_us = 20'000;
    return settings_.reserve_us + group_.ahead_us() + period_us() + late_us;
}

bool SetpointPort::submit(const FeedSegment& segment) noexcept {
    if (!accepts_segments()) {
        return false;
    }
    FeedSegment moved = segment;
    if (const std::optional<std::size_t> drive = group_.convert(moved)) { // no drive gets any of it
        fail({AxisFrame::out_of_range, *drive});                          // stops on the path
        return false;
    }
    const std::lock_guard lock(motion_->mutex);
    const bool taken = motion_->trajectory.push(moved);
    submitted_ += taken ? 1U : 0U;
    return taken;
}

// All drives slow down on the path; a drive that is not on the path stops by itself.
void SetpointPort::begin_stop(StopRequest request, Event reason) noexcept {
    const std::uint64_t now = settings_.clock->now_us();
    if (!stop_.requested()) {
        stop_began_us_ = now;
    }
    stop_.request(request, now);
    const std::lock_guard lock(motion_->mutex);
    motion_->stop_requested = true;
    if (phases_.phase() != Phase::filling && !motion_->clock.stopping()) { // otherwise the clock was never started
        motion_->clock.stop(now);
    }
    static_cast<void>(phases_.take(reason, now));
    phases_.progress(now);
}

void SetpointPort::fail(PortFailure&& trouble) noexcept {
    trouble_ = std::move(trouble);
    begin_stop(StopRequest::hold, Event::trouble);
}

// The sequence decides when the stop is over. A host that paused may be late for each of its requests, so the phase's
// bound counts from the last one.
void SetpointPort::follow_stop(std::uint64_t now_us) noexcept {
    bool together = true;
    for (std::size_t i = 0; i < group_.size(); ++i) {
        const SetpointReport last = report(i);
        facts_[i] = stop_facts(last, *motion_, stop_began_us_);
        together = together && stands_on_path(last, *motion_, group_.wiring(i).axis, group_.tolerance_counts(i));
    }
    for (StopFacts& facts : facts_) {
        facts.on_path = together;
    }
    if (stop_.update(now_us, facts_)) {
        phases_.progress(now_us);
    }
    for (std::size_t i = 0; i < group_.size(); ++i) {
        if (const StopRequest request = stop_.to_send(i); request > StopRequest::hold) {
            group_.stop_drive(i, request);
        }
    }
    if (stop_.settled()) {
        static_cast<void>(phases_.take(trouble_ ? Event::fails : Event::settles, now_us));
    }
}

// Estimated by the clock.
std::uint64_t SetpointPort::executed() const noexcept {
    const std::lock_guard lock(motion_->mutex);
    return std::min(motion_->clock.time(settings_.clock->now_us()) * ticks_per_us / segment_ticks_, submitted_);
}

// Any bus may have stopped the clock for all drives.
SetpointPort::Facts SetpointPort::facts(std::uint64_t now_us) noexcept {
    Facts out{};
    const auto fact = [&out](Event event) -> bool& {
        return out[static_cast<std::size_t>(event)];
    };
    {
        const std::lock_guard lock(motion_->mutex);
        time_us_ = motion_->time_us(now_us);
        const std::uint64_t end_us = motion_->trajectory.end_us();
        // A full buffer is filled, whatever the lengths of its segments: no more fits.
        fact(Event::filled) =
            !motion_->trajectory.empty() &&
            (motion_->complete || end_us >= time_us_ + settings_.buffer_us || motion_->trajectory.room() == 0);
        fact(Event::slows) = motion_->clock.stopping();
        fact(Event::stands) = motion_->clock.at_standstill(now_us);
        fact(Event::ran_out) = motion_->complete && !motion_->trajectory.empty() && time_us_ >= end_us;
    }
    stood_since_us_ = !fact(Event::stands) ? 0 : stood_since_us_ == 0 ? now_us : stood_since_us_;
    if (fact(Event::stands)) {
        const std::optional<std::size_t> drive = group_.not_ready(stood_since_us_);
        awaited_ = drive.value_or(awaited_);
        fact(Event::ready) = !drive;
    }
    if (fact(Event::ran_out)) {
        const std::optional<std::size_t> drive = group_.not_arrived(*motion_);
        awaited_ = drive.value_or(awaited_);
        arrived_since_us_ = drive ? 0 : arrived_since_us_ == 0 ? now_us : arrived_since_us_;
    }
    fact(Event::arrived) = arrived_since_us_ != 0 && now_us > arrived_since_us_ + settle_us &&
                           group_.heard_since(arrived_since_us_ + settle_us); // where they stand is known
    return out;
}

void SetpointPort::start_clock(std::uint64_t now_us) noexcept {
    const std::lock_guard lock(motion_->mutex);
    if (motion_->clock.stopping()) { // its rate rises from 0: a target that does not know of it yet does no harm
        motion_->runs_from_us = now_us + period_us();
        motion_->clock.resume(motion_->runs_from_us);
        ++resumes_;
    } else {
        motion_->runs_from_us = now_us + lead_us;
        motion_->clock.start(motion_->runs_from_us);
    }
}

// One change of the phase at a poll: the facts are those of the phase before.
void SetpointPort::follow_clock(std::uint64_t now_us) noexcept {
    const std::uint64_t before_us = time_us_;
    const Facts now = facts(now_us);
    for (const Event event :
         {Event::filled, Event::slows, Event::stands, Event::ready, Event::ran_out, Event::arrived}) {
        if (now[static_cast<std::size_t>(event)] && phases_.take(event, now_us)) {
            if (phases_.phase() == Phase::running) {
                start_clock(now_us);
            } else if (event == Event::slows) {
                find_late();
            }
            break;
        }
    }
    if (phases_.phase() == Phase::running) {
        const std::lock_guard lock(motion_->mutex);
        motion_->trajectory.release(time_us_ > retain_us ? time_us_ - retain_us : 0);
        if (time_us_ > before_us) {
            phases_.progress(now_us);
        }
    }
}

// Whether late targets began this stop, and of which drive most did so far.
void SetpointPort::find_late() noexcept {
    std::uint32_t stops = 0;
    for (std::size_t i = 0; i < group_.size(); ++i) {
        stops += group_.late_stops(i);
        latest_ = group_.late_stops(i) > group_.late_stops(latest_) ? i : latest_;
    }
    late_ = stops != late_stops_;
    late_stops_ = stops;
}

// A phase that lasts too long, and a motion that late targets stop again and again, so that it hardly advances. What
// the program takes is its own matter.
void SetpointPort::follow_bounds(std::uint64_t now_us) noexcept {
    const Phase phase = phases_.phase();
    const bool moves = phase == Phase::running || phase == Phase::stopping || phase == Phase::returning;
    lag_us_ += late_ && moves ? std::min(now_us - bounded_us_, longest_poll_us) : 0;
    const std::uint64_t reached_us = std::max(time_us_, bounded_time_us_); // a stop begins at an earlier instant
    lag_us_ -= std::min(lag_us_, slowest * (reached_us - bounded_time_us_));
    bounded_us_ = now_us;
    bounded_time_us_ = reached_us;
    const char* const late = phases_.overdue(now_us);
    if (late != nullptr && phase == Phase::ending) {
        if (!trouble_) { // a fault without a sentence would be a run that ended well
            trouble_ = {late, stop_.unconfirmed()};
        }
        static_cast<void>(phases_.take(Event::fails, now_us));
    } else if (late != nullptr) {
        fail({late, awaited_});
    } else if (moves && lag_us_ > patience_us) {
        const auto milliseconds = [](std::uint64_t time_us) {
            return std::to_string(time_us / 1000) + " ms";
        };
        fail({"its line is too slow for targets: " + std::to_string(group_.late_stops(latest_)) +
                  " times one was late by more than " + milliseconds(SetpointBus::allowed_late_us + period_us()) +
                  ", by " + milliseconds(report(latest_).late_us) +
                  " at worst, and all drives stopped; look for a busy host, a slow gateway, bad wiring or another "
                  "master, or use drives that take segments",
              latest_});
    }
}

PortState SetpointPort::poll() noexcept {
    const std::uint64_t now = settings_.clock->now_us();
    if (!stop_.requested() && phases_.phase() != Phase::done) {
        if (PortFailure trouble = group_.watch(began_us_)) {
            fail(std::move(trouble));
        }
    }
    follow_clock(now);
    if (stop_.requested()) {
        follow_stop(now);
    }
    follow_bounds(now);
    const Phase at = phases_.phase();
    const PortPhase phase = at == Phase::fault    ? PortPhase::fault
                            : at == Phase::halted ? PortPhase::halted
                            : at == Phase::done   ? PortPhase::idle
                                                  : PortPhase::running;
    return {phase, executed()};
}

void SetpointPort::halt() noexcept {
    if (accepts_segments() || phases_.phase() == Phase::arriving) {
        begin_stop(StopRequest::hold);
    }
}

void SetpointPort::quick_stop() noexcept {
    begin_stop(StopRequest::quick_stop);
}

void SetpointPort::power_off() noexcept {
    begin_stop(StopRequest::disable);
    await_stop();
}

void SetpointPort::await_stop() noexcept {
    const auto over = [this] {
        follow_stop(settings_.clock->now_us());
        return phases_.phase() != Phase::ending || phases_.overdue(settings_.clock->now_us()) != nullptr;
    };
    // The phase's bound ends the wait: it counts anew from each request.
    constexpr std::uint64_t any_us = std::uint64_t{1} << 62U;
    static_cast<void>(wait_until(*settings_.clock, over, any_us, "", poll_interval_us));
    if (phases_.phase() == Phase::ending) {
        static_cast<void>(phases_.take(Event::fails, settings_.clock->now_us()));
    }
}

} // namespace splinefeed::hal::modbus
