// SPDX-License-Identifier: MIT
#include "host_sim/drive/profile_drive.hpp"

#include "splinefeed/base/units.hpp"

#include "splinefeed/hal/modbus/profile/field_codec.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

constexpr std::int64_t positioning_mode = 1;
constexpr std::int64_t homing_mode = 6;
constexpr std::int64_t cyclic_mode = 8;
constexpr std::uint32_t acknowledge_bit = 0x1000;

} // namespace

ProfileDrive::ProfileDrive(DriveProfile profile, const ProfileDriveParameters& parameters)
    : profile_(std::move(profile)), parameters_(parameters), registers_(profile_), axis_(parameters.axis),
      target_(parameters.axis.start_counts) {
    constexpr std::uint32_t usual_us = 2000;
    if (parameters_.period_us == 0) {
        parameters_.period_us = profile_.period_us != 0 ? profile_.period_us : usual_us;
    }
    keep_on();
}

std::int64_t ProfileDrive::raw(FieldRole role) const {
    const FieldIndex index = profile_.index_of(role);
    return index == no_field ? 0 : registers_.raw(index);
}

bool ProfileDrive::written(FieldRole role) const {
    const FieldIndex index = profile_.index_of(role);
    return index != no_field && profile_.fields[index].writable() && registers_.was_written(index);
}

double ProfileDrive::physical(FieldRole role, double otherwise) const {
    const FieldIndex index = profile_.index_of(role);
    return index == no_field
               ? otherwise
               : static_cast<double>(physical_of(profile_.fields[index], registers_.raw(index))) / physical_one;
}

void ProfileDrive::show(FieldRole role, double physical) {
    const FieldIndex index = profile_.index_of(role);
    if (index != no_field) {
        registers_.set(index, raw_of(profile_.fields[index], std::llround(physical * physical_one)).raw);
    }
}

// What is written.

ModbusException ProfileDrive::write(int address, std::span<const std::uint16_t> values) {
    std::vector<std::int64_t> before(profile_.fields.size());
    for (FieldIndex i = 0; i < before.size(); ++i) {
        before[i] = registers_.raw(i);
    }
    const ModbusException refused = registers_.write(address, values);
    if (refused != ModbusException::none) {
        return refused;
    }
    exchange_us_ = now_us_;
    watchdog_fired_ = false;
    written_once_ = true;
    take_settings();
    if (profile_.cia402) {
        execute_control();
    } else {
        execute_masks(before);
    }
    keep_on();
    return ModbusException::none;
}

bool ProfileDrive::stays_on() const {
    return std::ranges::any_of(profile_.stays_on, [this](const DriveProfile::SetupCheck& check) {
        return holds(check.test, registers_.raw(check.test.field));
    });
}

void ProfileDrive::keep_on() {
    if (stays_on()) {
        axis_.enable();
    }
}

void ProfileDrive::take_settings() {
    if (written(FieldRole::following_error_window)) {
        axis_.set_following_window(physical(FieldRole::following_error_window, 0.0));
    }
    const FieldIndex display = profile_.index_of(FieldRole::mode_display);
    if (display != no_field && written(FieldRole::mode)) {
        registers_.set(display, raw(FieldRole::mode));
    }
}

MoveLimits ProfileDrive::limits() const {
    constexpr double least = 1e-3; // a ramp of 0 never gets anywhere
    return {std::fabs(physical(FieldRole::profile_velocity, parameters_.velocity_counts_s)),
            std::max(physical(FieldRole::profile_acceleration, parameters_.acceleration_counts_s2), least),
            std::max(physical(FieldRole::profile_deceleration, parameters_.acceleration_counts_s2), least)};
}

void ProfileDrive::start(bool immediately, bool relative) {
    const double target = physical(FieldRole::target_position, 0.0) + (relative ? target_ : 0.0);
    if (!immediately && axis_.moving()) {
        queued_ = target;
        return;
    }
    queued_.reset();
    target_ = target;
    axis_.move(target_, limits());
}

void ProfileDrive::halt() {
    axis_.halt(limits().deceleration);
    halted_ = true;
}

void ProfileDrive::resume() {
    halted_ = false;
    axis_.move(target_, limits());
}

// A drive whose start_move leaves the control word in a state in which each new target counts.
bool ProfileDrive::follows_targets() const {
    const std::vector<CommandStep>& steps = profile_.steps_of(DriveCommand::start_move);
    return !steps.empty() && steps.back().kind == StepKind::level &&
           steps.back().field == profile_.index_of(FieldRole::control) &&
           (machine_.word() & steps.back().mask) == steps.back().value;
}

void ProfileDrive::execute_control() {
    const bool follows = written(FieldRole::target_position) && follows_targets();
    Cia402Orders orders;
    if (written(FieldRole::control)) {
        orders = machine_.control(static_cast<std::uint16_t>(raw(FieldRole::control)), axis_);
    }
    if (!machine_.in_operation()) {
        halted_ = false;
        queued_.reset();
        return;
    }
    const std::int64_t mode = raw(FieldRole::mode);
    if (orders.halt) {
        halt();
    } else if (orders.go_on && mode == positioning_mode) {
        resume();
    }
    halted_ = machine_.halted();
    if (halted_) {
        return;
    }
    if (mode == cyclic_mode && written(FieldRole::target_position)) {
        target_ = physical(FieldRole::target_position, 0.0);
        axis_.follow(target_, us_to_s(parameters_.period_us));
    } else if (mode == homing_mode && orders.start) {
        axis_.home();
    } else if (mode == positioning_mode && (orders.start || follows)) {
        start(orders.immediately || follows, orders.relative && !follows);
    }
}

bool ProfileDrive::is_commanded(DriveCommand command, const std::vector<std::int64_t>& before) const {
    const std::vector<CommandStep>& steps = profile_.steps_of(command);
    if (steps.empty() || !registers_.was_written(steps.front().field)) {
        return false;
    }
    const CommandStep& step = steps.front();
    const FieldTest test{step.field, step.mask, step.value};
    const std::int64_t now = registers_.raw(step.field);
    switch (step.kind) {
    case StepKind::level: return holds(test, now);
    case StepKind::edge:
    case StepKind::pulse: return holds(test, now) && !holds(test, before[step.field]);
    case StepKind::toggle: break;
    }
    return ((now ^ before[step.field]) & static_cast<std::int64_t>(step.mask)) != 0;
}

void ProfileDrive::execute_masks(const std::vector<std::int64_t>& before) {
    constexpr std::array<DriveCommand, 8> by_priority{
        DriveCommand::disable, DriveCommand::enable, DriveCommand::fault_reset, DriveCommand::quick_stop,
        DriveCommand::halt,    DriveCommand::resume, DriveCommand::home,        DriveCommand::start_move};
    bool stopped = false;
    for (const DriveCommand command : by_priority) {
        if (is_commanded(command, before) && !(stopped && command == DriveCommand::halt)) {
            execute(command);
            stopped = stopped || command == DriveCommand::quick_stop;
        }
    }
}

void ProfileDrive::execute(DriveCommand command) {
    const bool blocked = quick_stopped_ || halted_;
    switch (command) {
    case DriveCommand::enable: axis_.enable(); break;
    case DriveCommand::disable:
        if (stays_on()) {
            break;
        }
        axis_.disable();
        halted_ = quick_stopped_ = false;
        break;
    case DriveCommand::fault_reset:
        axis_.reset_fault();
        quick_stopped_ = false;
        break;
    case DriveCommand::quick_stop:
        axis_.quick_stop();
        quick_stopped_ = axis_.power() == AxisPower::on && reports(DriveState::quick_stop);
        break;
    case DriveCommand::halt:
        halt();
        halted_ = axis_.power() == AxisPower::on && reports(DriveState::halted);
        break;
    case DriveCommand::resume:
        if (halted_) {
            resume();
        }
        break;
    case DriveCommand::home:
        if (!blocked) {
            axis_.home();
        }
        break;
    case DriveCommand::start_move:
        if (!blocked) {
            start(profile_.change_on_the_fly, false);
        }
        break;
    case DriveCommand::forward:
    case DriveCommand::reverse:
    case DriveCommand::stop: break; // of spindles
    }
}

void ProfileDrive::stop_by_itself() {
    constexpr std::uint16_t quick_stop_word = 0x0002;
    if (profile_.cia402) {
        static_cast<void>(machine_.control(quick_stop_word, axis_));
    } else if (reports(DriveState::quick_stop)) {
        execute(DriveCommand::quick_stop);
    } else {
        axis_.trip(AxisFault::following_error);
    }
}

void ProfileDrive::power_cycle() {
    registers_.reset();
    axis_.power_cycle();
    machine_.reset();
    written_once_ = halted_ = quick_stopped_ = watchdog_fired_ = false;
    queued_.reset();
    target_ = axis_.shaft().position_counts();
    keep_on();
}

// What is read.

ModbusException ProfileDrive::read(int address, std::span<std::uint16_t> out) {
    refresh();
    const ModbusException refused = registers_.read(address, out);
    if (refused == ModbusException::none) {
        exchange_us_ = now_us_;
        watchdog_fired_ = false;
        if (profile_.link.reads_zero_until_written && !written_once_) {
            std::ranges::fill(out, std::uint16_t{0});
        }
    }
    return refused;
}

void ProfileDrive::refresh() {
    machine_.update(axis_);
    show(FieldRole::actual_position, axis_.shaft().position_counts());
    show(FieldRole::actual_velocity, axis_.reference().velocity_counts_s());
    show(FieldRole::following_error, axis_.shaft().following_error_counts());
    const FieldIndex status = profile_.index_of(FieldRole::status);
    registers_.set(status, profile_.cia402 ? status_by_cia402() : status_by_masks());
    if (const FieldIndex code = profile_.index_of(FieldRole::fault_code); code != no_field) {
        // CiA 402's codes of a following error and of a lost bus; a maker's own are not known.
        constexpr std::array<std::int64_t, 3> standard{0, 0x8611, 0x8130};
        const auto fault = static_cast<std::size_t>(axis_.fault());
        registers_.set(code, profile_.cia402 ? standard[fault] : static_cast<std::int64_t>(fault));
    }
}

bool ProfileDrive::reports(DriveState state) const {
    return std::ranges::any_of(profile_.states, [state](const StateTest& test) { return test.state == state; });
}

DriveState ProfileDrive::state() const {
    switch (axis_.power()) {
    case AxisPower::fault:
    case AxisPower::stopping_fault: return DriveState::fault;
    case AxisPower::off: return DriveState::disabled;
    case AxisPower::on: break;
    }
    if (quick_stopped_ || halted_) {
        return quick_stopped_ ? DriveState::quick_stop : DriveState::halted;
    }
    if (axis_.homing() && reports(DriveState::homing)) {
        return DriveState::homing;
    }
    return axis_.moving() && reports(DriveState::moving) ? DriveState::moving : DriveState::enabled;
}

std::int64_t ProfileDrive::with_tests(std::int64_t status) const {
    const FieldIndex index = profile_.index_of(FieldRole::status);
    if (profile_.done && profile_.done->field == index) {
        status = with_test(status, *profile_.done, axis_.arrived() && !queued_);
    }
    const bool shared = profile_.cia402 && profile_.homed && profile_.homed->mask == acknowledge_bit;
    if (profile_.homed && profile_.homed->field == index && !shared) {
        status = with_test(status, *profile_.homed, axis_.homed());
    }
    return status;
}

std::int64_t ProfileDrive::status_by_masks() const {
    const DriveState now = state();
    std::int64_t status = 0;
    for (const StateTest& test : profile_.states) {
        if (test.state == now && test.test.field == profile_.index_of(FieldRole::status)) {
            status = with_test(status, test.test, true);
            break;
        }
    }
    return with_tests(status);
}

std::int64_t ProfileDrive::status_by_cia402() const {
    std::int64_t status = with_tests(machine_.status());
    const std::int64_t mode = raw(FieldRole::mode);
    const bool acknowledged = mode == positioning_mode ? (machine_.word() & Cia402Machine::start_bit) != 0
                              : mode == homing_mode    ? axis_.homed()
                                                       : mode == cyclic_mode && !halted_;
    if (machine_.in_operation() && acknowledged) {
        status |= acknowledge_bit;
    }
    return status;
}

// Time.

void ProfileDrive::advance(std::uint64_t now_us) {
    constexpr std::uint64_t longest_us = 250;
    while (now_us_ < now_us) {
        const bool watching = axis_.power() == AxisPower::on && raw(FieldRole::watchdog) != 0 && !watchdog_fired_;
        if (axis_.idle() && !queued_ && !watching) {
            now_us_ = now_us;
            break;
        }
        const std::uint64_t step = std::min(longest_us, now_us - now_us_);
        axis_.advance(static_cast<double>(step) / us_per_s);
        now_us_ += step;
        if (queued_ && !axis_.moving() && !halted_) {
            target_ = *queued_;
            queued_.reset();
            axis_.move(target_, limits());
        }
        check_watchdog();
        machine_.update(axis_);
    }
    machine_.update(axis_);
}

void ProfileDrive::check_watchdog() {
    const double timeout_ms = physical(FieldRole::watchdog, 0.0);
    if (timeout_ms <= 0.0 || watchdog_fired_ || axis_.power() != AxisPower::on ||
        static_cast<double>(now_us_ - exchange_us_) <= timeout_ms * us_per_ms) {
        return;
    }
    watchdog_fired_ = true;
    switch (profile_.watchdog_reaction) {
    case WatchdogReaction::stop: axis_.halt(limits().deceleration); break;
    case WatchdogReaction::quick_stop: axis_.quick_stop(); break;
    case WatchdogReaction::disable: axis_.disable(); break;
    case WatchdogReaction::fault: axis_.trip(AxisFault::watchdog); break;
    case WatchdogReaction::none: break;
    }
}

} // namespace splinefeed::host
