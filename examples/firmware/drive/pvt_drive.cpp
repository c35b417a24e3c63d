// SPDX-License-Identifier: MIT
#include "drive/pvt_drive.hpp"

#include "drive/axis_stop.hpp"

#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/modbus/pvt_drive/command_states.hpp"
#include "splinefeed/s5_pulse_train/step.hpp"

namespace firmware {

using splinefeed::ticks_per_us;
using splinefeed::hal::modbus::comes_too_late;
using splinefeed::hal::modbus::fits;

namespace {

constexpr std::uint32_t us_per_ms = splinefeed::us_per_ms; // of a word
constexpr std::uint32_t longest_watchdog_us = 65'535 * us_per_ms;

/// How far an instant lies ahead of another one; both wrap.
constexpr std::int32_t ahead_us(std::uint32_t instant, std::uint32_t now) noexcept {
    return static_cast<std::int32_t>(instant - now);
}

} // namespace

// Commands.

PvtRefusal PvtDrive::execute(PvtCommand command, std::uint32_t argument) noexcept {
    if (!fits(command, state_)) {
        return PvtRefusal::state;
    }
    switch (command) {
    case PvtCommand::enable: enable(); return PvtRefusal::none;
    case PvtCommand::disable:
        lose_ring();
        stand(PvtState::disabled);
        return PvtRefusal::none;
    case PvtCommand::start:
    case PvtCommand::resume:
        if (comes_too_late(argument, clock_us(), configuration_.watchdog_ms)) {
            return PvtRefusal::state;
        }
        start_at(argument);
        return PvtRefusal::none;
    case PvtCommand::hold: return hold(argument);
    case PvtCommand::quick_stop: return quick_stop();
    case PvtCommand::end: return path_.end_before(argument) ? PvtRefusal::none : PvtRefusal::state;
    case PvtCommand::fault_reset:
        if (motion_ != Motion::none) {
            return PvtRefusal::state;
        }
        fault_ = PvtFault::none;
        fault_axis_ = 0;
        stand(PvtState::disabled);
        return PvtRefusal::none;
    case PvtCommand::home: return PvtRefusal::state; // there is no switch to find
    default: return PvtRefusal::none;
    }
}

PvtStatus PvtDrive::status() const noexcept {
    PvtStatus status;
    status.state = state_;
    status.fault = static_cast<std::uint16_t>(fault_);
    status.fault_axis = static_cast<std::uint16_t>(fault_axis_);
    status.next = queue_.next();
    status.executed = queue_.executed();
    status.free = queue_.free();
    status.clock_us = clock_us();
    for (unsigned k = 0; k < drive_axes; ++k) {
        status.position[k] = steps_.count(k);
    }
    return status;
}

PvtRefusal PvtDrive::begin(std::uint16_t session, std::uint32_t first) noexcept {
    if (!fits(PvtCommand::begin, state_)) {
        return PvtRefusal::state;
    }
    session_ = session;
    stand(PvtState::standing);
    path_.begin(first, slots_.reference().position);
    fault_ = PvtFault::none;
    return PvtRefusal::none;
}

PvtRefusal PvtDrive::preset_position(std::span<const PvtSegment> segments) noexcept {
    if (segments.size() != 1) {
        return PvtRefusal::malformed;
    }
    if (!fits(PvtCommand::preset_position, state_) || !waits_empty()) {
        return PvtRefusal::state;
    }
    PerAxis<std::int64_t> position{};
    PerAxis<std::int32_t> counts{};
    for (unsigned k = 0; k < drive_axes; ++k) {
        position[k] = segments[0].end[k] * (splinefeed::units_per_count >> PvtSegment::position_bits);
        const std::int64_t step = splinefeed::nearest_step(position[k]);
        counts[k] = static_cast<std::int32_t>(step);
        if (counts[k] != step) {
            return PvtRefusal::malformed;
        }
    }
    steps_.set_counts(counts);
    slots_.stand_at(position);
    path_.begin(queue_.executed(), position);
    return PvtRefusal::none;
}

PvtRefusal PvtDrive::take(std::uint32_t first, std::span<const PvtSegment> segments) noexcept {
    const auto fresh = static_cast<std::int32_t>(first + static_cast<std::uint32_t>(segments.size()) - queue_.next());
    const bool accepts = state_ != PvtState::disabled && state_ != PvtState::fault;
    if (fresh > 0 && !accepts && !segments.empty()) {
        return PvtRefusal::state;
    }
    return queue_.take(first, segments);
}

void PvtDrive::start_at(std::uint32_t clock_us) noexcept {
    start_waits_ = true;
    start_us_ = clock_us;
}

PvtRefusal PvtDrive::hold(std::uint32_t clock_us) noexcept {
    if (motion_ == Motion::each_axis) {
        return PvtRefusal::state;
    }
    if (state_ == PvtState::running) {
        hold_waits_ = true;
        hold_us_ = clock_us;
    }
    start_waits_ = false;
    return PvtRefusal::none;
}

PvtRefusal PvtDrive::quick_stop() noexcept {
    lose_ring();
    if (state_ == PvtState::standing || state_ == PvtState::held) {
        stand(PvtState::standing);
    } else if (motion_ == Motion::ring) {
        stop_axes(PvtState::stopping, PvtState::standing);
    }
    return PvtRefusal::none;
}

/// What an emergency stop did while the drive was off is forgotten; if it is still pressed the next tick says so.
void PvtDrive::enable() noexcept {
    if (state_ == PvtState::disabled) {
        steps_.restart();
        steps_.forgive();
        stand_where_the_motors_are();
        stand(PvtState::standing);
    }
}

// States.

void PvtDrive::stand(PvtState state) noexcept {
    state_ = state;
    motion_ = Motion::none;
    ends_ = false;
    leave_path();
}

void PvtDrive::stand_where_the_motors_are() noexcept {
    PerAxis<std::int64_t> position{};
    for (unsigned k = 0; k < drive_axes; ++k) {
        position[k] = steps_.count(k) * splinefeed::units_per_count;
    }
    slots_.stand_at(position);
    path_.begin(queue_.executed(), position);
}

void PvtDrive::leave_path() noexcept {
    start_waits_ = false;
    hold_waits_ = false;
    path_.leave();
}

/// What the slots that are made already hold is executed.
void PvtDrive::lose_ring() noexcept {
    session_.reset();
    reported_ = pushed_;
    path_.begin(queue_.passed(), slots_.reference().position);
}

void PvtDrive::stop_axes(PvtState meanwhile, PvtState then) noexcept {
    motion_ = Motion::each_axis;
    state_ = meanwhile;
    then_ = then;
    ends_ = false;
    leave_path();
}

void PvtDrive::fail(PvtFault fault, unsigned axis) noexcept {
    lose_ring();
    fault_ = fault;
    fault_axis_ = axis;
    stop_axes(PvtState::fault, PvtState::fault);
}

// Time.

void PvtDrive::poll(bool limit) noexcept {
    notice_inputs(limit);
    const bool done = drained(); // first: what was executed until then is published with the new state
    publish_executed();
    if (ends_ && done) {
        const bool left_path = motion_ == Motion::each_axis;
        stand(then_);
        if (left_path) {
            path_.begin(queue_.passed(), slots_.reference().position);
        }
    }
    fire_events();
    while (motion_ != Motion::none && !ends_ && steps_.room() > 0) {
        make_slot();
    }
}

void PvtDrive::notice_inputs(bool limit) noexcept {
    const bool estop = steps_.stopped() == Stop::estop && powered();
    if (estop) {
        fail(PvtFault::emergency_stop, 0);
    }
    if (fault_ == PvtFault::emergency_stop && motion_ != Motion::none && !steps_.active()) {
        steps_.restart(); // the slots that were made are not executed
        stand_where_the_motors_are();
        stand(PvtState::fault);
    }
    if (limit && !on_limit_) { // axes that stand on a switch, or were stopped by it, may move off it, but not far
        leaving_ = motion_ != Motion::ring;
        for (unsigned k = 0; k < drive_axes; ++k) {
            pressed_at_[k] = steps_.count(k);
        }
    }
    on_limit_ = limit;
    if (limit && motion_ == Motion::ring && !(leaving_ && is_beside(pressed_at_))) {
        fail(PvtFault::limit, 0);
        on_limit_ = false; // it is pressed anew where the axes are stopped
    }
}

bool PvtDrive::is_beside(const PerAxis<std::int32_t>& place) const noexcept {
    for (unsigned k = 0; k < drive_axes; ++k) {
        const auto way = static_cast<std::uint32_t>(steps_.count(k)) - static_cast<std::uint32_t>(place[k]);
        if (way + drive_leaving_steps > 2 * drive_leaving_steps) { // modulo 2^32
            return false;
        }
    }
    return true;
}

/// A segment is executed when the slot in which it ends has been made into steps.
void PvtDrive::publish_executed() noexcept {
    const auto level = static_cast<std::uint32_t>(steps_.level()); // first: what begins now is active then
    const std::uint32_t made = pushed_ - level - (steps_.active() ? 1U : 0U);
    if (static_cast<std::int32_t>(made - reported_) > 0) {
        reported_ = made;
        queue_.set_executed(passed_at_[(made - 1) % passed_at_.size()]);
    }
}

void PvtDrive::fire_events() noexcept {
    const std::uint32_t now = clock_us();
    if (start_waits_ && ahead_us(start_us_, now) < static_cast<std::int32_t>(slot_us)) {
        start_ring();
    }
    if (ahead_us(now, fed_us_) < 0 || now - fed_us_ > longest_watchdog_us) {
        fed_us_ = now - longest_watchdog_us; // long ago, for ever
    }
    const std::uint32_t watchdog_us = configuration_.watchdog_ms * us_per_ms;
    if (state_ == PvtState::running && watchdog_us != 0 && now - fed_us_ >= watchdog_us) {
        fault_ = PvtFault::watchdog;
        hold_waits_ = false;
        slow_down();
    }
}

void PvtDrive::start_ring() noexcept {
    start_waits_ = false;
    if (queue_.empty()) {
        stand(PvtState::held);
        return;
    }
    slot_begin_us_ = clock_us() + drive_tick_us;
    const std::int32_t wait_us = ahead_us(start_us_, slot_begin_us_);
    wait_ticks_ = wait_us > 0 ? static_cast<std::uint32_t>(wait_us) * ticks_per_us : 0;
    path_.set_stop_reserve(configuration_.stop_reserve_ms);
    if (state_ == PvtState::standing) {
        path_.start();
    } else {
        path_.resume();
    }
    if (fault_ == PvtFault::watchdog) {
        fault_ = PvtFault::none;
    }
    state_ = PvtState::running;
    motion_ = Motion::ring;
}

void PvtDrive::slow_down() noexcept {
    path_.hold();
    state_ = PvtState::stopping;
}

/// Of the ticks that the next slot still has: those before the hold that waits.
std::uint32_t PvtDrive::ticks_to_hold(std::uint32_t ticks) const noexcept {
    const std::int32_t us =
        ahead_us(hold_us_, slot_begin_us_ + slot_us) + static_cast<std::int32_t>(ticks / ticks_per_us);
    const std::uint32_t before = us > 0 ? static_cast<std::uint32_t>(us) * ticks_per_us : 0;
    return before < ticks ? before : ticks;
}

/// The places at the end of the next slot. false: there is no slot, because a segment is too fast.
bool PvtDrive::follow_ring(AxisPlaces& to) noexcept {
    std::uint32_t ticks = slot_ticks - wait_ticks_;
    wait_ticks_ = 0;
    PathMotion::Outcome outcome = PathMotion::Outcome::moves;
    if (hold_waits_) {
        const std::uint32_t before = ticks_to_hold(ticks);
        if (before > 0) {
            outcome = path_.pass(before, to);
        }
        if (before < ticks) {
            hold_waits_ = false;
            slow_down();
        }
        ticks -= before;
    }
    if (outcome == PathMotion::Outcome::moves && ticks > 0) {
        outcome = path_.pass(ticks, to);
    }
    ends_ = outcome == PathMotion::Outcome::complete || outcome == PathMotion::Outcome::held;
    then_ = outcome == PathMotion::Outcome::complete ? PvtState::standing : PvtState::held;
    if (outcome == PathMotion::Outcome::too_fast) {
        fail(PvtFault::limit, path_.fast_axis());
    }
    return outcome != PathMotion::Outcome::too_fast;
}

void PvtDrive::make_slot() noexcept {
    if (drained()) {
        slot_begin_us_ = clock_us() + drive_tick_us;
    }
    AxisPlaces to;
    if (motion_ == Motion::ring) {
        if (!follow_ring(to)) {
            return;
        }
    } else {
        ends_ = stands(slots_.reference());
        if (ends_) {
            return;
        }
        to = stopped_slot(slots_.reference());
    }
    if (const std::optional<unsigned> fast = slots_.make(to, ends_ || stands(to), part_)) {
        fail(PvtFault::limit, *fast);
        return;
    }
    steps_.push(part_);
    passed_at_[pushed_ % passed_at_.size()] = queue_.passed();
    ++pushed_;
    slot_begin_us_ += slot_us;
}

} // namespace firmware
