// SPDX-License-Identifier: MIT
#include "host_sim/drive/pvt_machine.hpp"

#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/modbus/pvt_drive/command_states.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splinefeed::host {

using hal::modbus::comes_too_late;
using hal::modbus::fits;
using hal::modbus::PvtCommand;
using hal::modbus::PvtConfiguration;
using hal::modbus::PvtFault;
using hal::modbus::PvtRefusal;
using hal::modbus::PvtSegment;
using hal::modbus::PvtState;

namespace {

constexpr std::uint64_t longest_step_us = 125; // a fraction of the loop's time constant, and of a segment
constexpr double errors_per_count = 65536.0;

std::int32_t in_register(double value) noexcept {
    constexpr double most = std::numeric_limits<std::int32_t>::max();
    return static_cast<std::int32_t>(std::clamp(std::nearbyint(value), -most, most));
}

} // namespace

PvtMachine::PvtMachine(std::vector<PvtAxisParameters> axes, std::uint16_t ring, std::uint64_t clock_start_us)
    : axes_(std::move(axes)), path_(static_cast<int>(axes_.size()), ring), clock_start_us_(clock_start_us) {
    for (const PvtAxisParameters& axis : axes_) {
        shafts_.emplace_back(axis.shaft).preset_position(axis.start_counts);
    }
    stand(PvtState::disabled);
}

void PvtMachine::power_cycle(std::uint64_t clock_start_us) {
    clock_start_us_ = clock_start_us - now_us_;
    configuration_ = PvtConfiguration{};
    lose_ring();
    path_.ring().begin(0, {});
    fault_ = PvtFault::none;
    fault_axis_ = 0;
    stand(PvtState::disabled);
}

hal::modbus::PvtStatus PvtMachine::status() const {
    hal::modbus::PvtStatus status;
    status.state = state_;
    status.fault = static_cast<std::uint16_t>(fault_);
    status.fault_axis = static_cast<std::uint16_t>(fault_axis_);
    status.next = ring().next();
    status.executed = ring().executed();
    status.free = ring().free();
    status.clock_us = clock_us();
    for (std::size_t k = 0; k < shafts_.size(); ++k) {
        status.position[k] = in_register(shafts_[k].position_counts());
        status.following_error[k] = in_register(shafts_[k].following_error_counts() * errors_per_count);
    }
    return status;
}

// Commands.

std::uint64_t PvtMachine::time_of(std::uint32_t clock_us) const noexcept {
    const auto ahead = static_cast<std::int32_t>(clock_us - this->clock_us());
    return now_us_ + static_cast<std::uint64_t>(std::max(ahead, 0));
}

PvtRefusal PvtMachine::execute(PvtCommand command, std::uint32_t argument) {
    if (!fits(command, state_)) {
        return PvtRefusal::state;
    }
    switch (command) {
    case PvtCommand::none: return PvtRefusal::none;
    case PvtCommand::enable:
        if (state_ == PvtState::disabled) {
            stand(PvtState::standing);
        }
        return PvtRefusal::none;
    case PvtCommand::disable:
        lose_ring();
        stand(PvtState::disabled);
        return PvtRefusal::none;
    case PvtCommand::start:
    case PvtCommand::resume:
        if (comes_too_late(argument, clock_us(), configuration_.watchdog_ms)) {
            return PvtRefusal::state;
        }
        schedule_.start_at(time_of(argument));
        fire_events();
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
    case PvtCommand::home: return home();
    case PvtCommand::begin:
    case PvtCommand::preset_position: break;
    }
    return PvtRefusal::state;
}

PvtRefusal PvtMachine::begin(std::uint16_t session, std::uint32_t first) {
    if (!fits(PvtCommand::begin, state_)) {
        return PvtRefusal::state;
    }
    session_ = session;
    stand(PvtState::standing);
    path_.begin(first, reference_);
    fault_ = PvtFault::none;
    return PvtRefusal::none;
}

bool PvtMachine::waits_empty() const noexcept {
    return ring().empty() && !schedule_.start_waits();
}

PvtRefusal PvtMachine::preset_position(std::span<const PvtSegment> segments) {
    if (segments.size() != 1) {
        return PvtRefusal::malformed;
    }
    if (!fits(PvtCommand::preset_position, state_) || !waits_empty()) {
        return PvtRefusal::state;
    }
    path_.ring().begin(ring().executed(), segments[0].end);
    for (std::size_t k = 0; k < shafts_.size(); ++k) {
        reference_.counts[k] = ring().start(static_cast<int>(k));
        shafts_[k].preset_position(reference_.counts[k]);
    }
    return PvtRefusal::none;
}

PvtRefusal PvtMachine::take(std::uint32_t first, std::span<const PvtSegment> segments) {
    const auto fresh = static_cast<std::int32_t>(first + static_cast<std::uint32_t>(segments.size()) - ring().next());
    const bool accepts = state_ != PvtState::disabled && state_ != PvtState::fault && state_ != PvtState::homing;
    if (fresh > 0 && !accepts) {
        return PvtRefusal::state;
    }
    return path_.ring().take(first, segments);
}

PvtRefusal PvtMachine::hold(std::uint32_t clock_us) {
    if (motion_ == Motion::each_axis) {
        return PvtRefusal::state;
    }
    if (state_ == PvtState::running) {
        schedule_.hold_at(time_of(clock_us));
    }
    schedule_.call_off_start();
    fire_events();
    return PvtRefusal::none;
}

PvtRefusal PvtMachine::quick_stop() {
    lose_ring();
    switch (state_) {
    case PvtState::disabled:
    case PvtState::fault: break;
    case PvtState::standing:
    case PvtState::held: stand(PvtState::standing); break;
    case PvtState::running:
    case PvtState::stopping:
    case PvtState::homing:
        if (state_ != PvtState::stopping || motion_ != Motion::each_axis) {
            stop_axes(PvtState::stopping, PvtState::standing);
        }
        break;
    }
    return PvtRefusal::none;
}

PvtRefusal PvtMachine::home() {
    if (!waits_empty()) {
        return PvtRefusal::state;
    }
    moves_.home(reference_, axes_);
    move_axes(PvtState::homing, PvtState::standing);
    return PvtRefusal::none;
}

// States.

// The reference stays; without power, and when it comes, it is where the shafts are.
void PvtMachine::stand(PvtState state) {
    const bool follows = state_ != PvtState::disabled && state != PvtState::disabled;
    for (std::size_t k = 0; !follows && k < shafts_.size(); ++k) {
        shafts_[k].let_go();
        reference_.counts[k] = shafts_[k].position_counts();
    }
    reference_.counts_s = {};
    state_ = state;
    motion_ = Motion::none;
    leave_path();
}

void PvtMachine::leave_path() {
    schedule_.call_off_start();
    schedule_.call_off_hold();
    path_.leave();
}

void PvtMachine::move_axes(PvtState meanwhile, PvtState then) {
    motion_ = Motion::each_axis;
    state_ = meanwhile;
    after_moves_ = then;
}

void PvtMachine::stop_axes(PvtState meanwhile, PvtState then) {
    moves_.stop(reference_, axes_);
    move_axes(meanwhile, then);
    leave_path();
}

void PvtMachine::lose_ring() {
    session_.reset();
    path_.ring().begin(ring().executed(), {});
}

void PvtMachine::fail(PvtFault fault, int axis) {
    lose_ring();
    fault_ = fault;
    fault_axis_ = axis;
    stop_axes(PvtState::fault, PvtState::fault);
}

// Time.

bool PvtMachine::idle() const noexcept {
    return motion_ == Motion::none &&
           (state_ == PvtState::disabled ||
            std::ranges::all_of(shafts_, [](const MotorAxis& shaft) { return shaft.settled(); }));
}

void PvtMachine::advance(std::uint64_t now_us) {
    fire_events();
    while (now_us_ < now_us) {
        const std::uint64_t event = schedule_.next_us(now_us_, configuration_.watchdog_ms, now_us);
        const std::uint64_t duration = idle() ? event - now_us_ : std::min(longest_step_us, event - now_us_);
        if (!idle()) {
            step(duration);
        }
        now_us_ += duration;
        fire_events();
    }
}

void PvtMachine::fire_events() {
    if (schedule_.take_start(now_us_)) {
        start_ring();
    }
    if (schedule_.take_hold(now_us_)) {
        slow_down();
    }
    check_watchdog();
}

void PvtMachine::start_ring() {
    if (ring().empty()) {
        stand(PvtState::held);
        return;
    }
    path_.set_stop_reserve(configuration_.stop_reserve_ms * 1e-3);
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

void PvtMachine::slow_down() {
    path_.hold();
    state_ = PvtState::stopping;
}

void PvtMachine::check_watchdog() {
    if (!schedule_.starves(now_us_, configuration_.watchdog_ms)) {
        return;
    }
    if (state_ == PvtState::running) {
        fault_ = PvtFault::watchdog;
        schedule_.call_off_hold();
        slow_down();
    } else if (state_ == PvtState::homing) {
        fail(PvtFault::watchdog, 0);
    }
}

void PvtMachine::step(std::uint64_t duration_us) {
    const double duration_s = static_cast<double>(duration_us) / us_per_s;
    const PerAxis<double> before = reference_.counts_s;
    if (motion_ == Motion::ring) {
        follow_ring(duration_s);
    } else if (motion_ == Motion::each_axis) {
        follow_moves(duration_s);
    }
    PerAxis<double> acceleration{};
    for (std::size_t k = 0; k < shafts_.size(); ++k) {
        acceleration[k] = (reference_.counts_s[k] - before[k]) / duration_s;
        shafts_[k].step(duration_s, reference_.counts[k], acceleration[k]);
    }
    check_axes(acceleration);
}

void PvtMachine::follow_ring(double duration_s) {
    switch (path_.pass(now_us_, duration_s, reference_)) {
    case RingMotion::Outcome::moves: break;
    case RingMotion::Outcome::complete: stand(PvtState::standing); break;
    case RingMotion::Outcome::held: stand(PvtState::held); break;
    case RingMotion::Outcome::underflow: fail(PvtFault::underflow, reference_.fastest()); break;
    }
}

void PvtMachine::follow_moves(double duration_s) {
    if (moves_.pass(duration_s, reference_)) {
        stand(after_moves_);
        path_.begin(ring().executed(), reference_);
    }
}

void PvtMachine::check_axes(const PerAxis<double>& acceleration) {
    if (state_ == PvtState::fault) {
        return;
    }
    for (std::size_t k = 0; k < shafts_.size(); ++k) {
        const PvtAxisStep step{.following_error_counts = shafts_[k].following_error_counts(),
                               .counts_s = reference_.counts_s[k],
                               .counts_s2 = acceleration[k],
                               .on_ring = motion_ == Motion::ring};
        if (const PvtFault fault = fault_of(axes_[k], step, configuration_.following_window); fault != PvtFault::none) {
            fail(fault, static_cast<int>(k));
            return;
        }
    }
}

} // namespace splinefeed::host
