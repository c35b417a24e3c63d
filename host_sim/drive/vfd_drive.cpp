// SPDX-License-Identifier: MIT
#include "host_sim/drive/vfd_drive.hpp"

#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/modbus/profile/field_codec.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

constexpr double near_hz = 0.01;

} // namespace

VfdDrive::VfdDrive(DriveProfile profile, const VfdDriveParameters& parameters)
    : profile_(std::move(profile)), parameters_(parameters), registers_(profile_) {}

double VfdDrive::speed_hz() const {
    const FieldIndex field = profile_.index_of(FieldRole::target_velocity);
    return static_cast<double>(physical_of(profile_.fields[field], registers_.raw(field))) / physical_one;
}

void VfdDrive::advance(std::uint64_t now_us) {
    const double passed_s = began_ ? static_cast<double>(now_us - now_us_) / us_per_s : 0.0;
    began_ = true;
    now_us_ = now_us;
    const double wanted_hz = direction_ * speed_hz();
    const double step_hz = parameters_.ramp_hz_s * passed_s;
    const double before_hz = output_hz_;
    output_hz_ += std::clamp(wanted_hz - output_hz_, -step_hz, step_hz);
    periods_ += 0.5 * (before_hz + output_hz_) * passed_s;
}

// All of its steps are in the registers, and the last one was written now.
bool VfdDrive::is_commanded(DriveCommand command) const {
    const std::vector<CommandStep>& steps = profile_.steps_of(command);
    return !steps.empty() && registers_.was_written(steps.back().field) &&
           std::ranges::all_of(steps, [this](const CommandStep& step) {
               return holds({step.field, step.mask, step.value}, registers_.raw(step.field));
           });
}

ModbusException VfdDrive::write(int place, std::span<const std::uint16_t> values) {
    const ModbusException refused = registers_.write(place, values);
    if (refused != ModbusException::none) {
        return refused;
    }
    if (is_commanded(DriveCommand::stop)) {
        direction_ = 0;
    } else if (is_commanded(DriveCommand::forward)) {
        direction_ = faulted_ ? 0 : 1;
    } else if (is_commanded(DriveCommand::reverse)) {
        direction_ = faulted_ ? 0 : -1;
    }
    return ModbusException::none;
}

DriveState VfdDrive::state() const {
    return faulted_                               ? DriveState::fault
           : direction_ != 0 || output_hz_ != 0.0 ? DriveState::moving
                                                  : DriveState::disabled;
}

void VfdDrive::refresh() {
    const FieldIndex output = profile_.index_of(FieldRole::actual_velocity);
    registers_.set(output, raw_of(profile_.fields[output], std::llround(std::fabs(output_hz_) * physical_one)).raw);
    const DriveState now = state();
    for (const StateTest& test : profile_.states) {
        registers_.set(test.test.field, with_test(registers_.raw(test.test.field), test.test, test.state == now));
    }
    if (profile_.done) {
        const bool done = direction_ != 0 && std::fabs(output_hz_ - direction_ * speed_hz()) < near_hz;
        registers_.set(profile_.done->field, with_test(registers_.raw(profile_.done->field), *profile_.done, done));
    }
    if (const FieldIndex code = profile_.index_of(FieldRole::fault_code); code != no_field) {
        registers_.set(code, faulted_ ? 1 : 0);
    }
}

ModbusException VfdDrive::read(int place, std::span<std::uint16_t> out) {
    refresh();
    return registers_.read(place, out);
}

void VfdDrive::power_cycle() {
    registers_.reset();
    direction_ = 0;
    output_hz_ = 0.0;
    faulted_ = false;
}

void VfdDrive::trip() {
    faulted_ = true;
    direction_ = 0;
    output_hz_ = 0.0;
}

} // namespace splinefeed::host
