// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/status_frames.hpp"

namespace splinefeed::hal::modbus {

StatusFrames::StatusFrames(const DriveProfile& profile) : profile_(profile), raw_(profile.fields.size()) {
    if (const FieldGroup* const group = profile.group_for(GroupUse::status)) {
        reads_[count_++] = {group->address, group->registers};
    }
    for (const FieldRole role :
         {FieldRole::status, FieldRole::actual_position, FieldRole::following_error, FieldRole::fault_code}) {
        if (const RegisterField* const field = profile.field_of(role); field != nullptr && field->readable()) {
            const std::size_t read = append(static_cast<FieldIndex>(field - profile.fields.data()));
            position_read_ = role == FieldRole::actual_position ? read : position_read_;
        }
    }
}

// Returns the frame that has the field.
std::size_t StatusFrames::append(FieldIndex index) noexcept {
    const RegisterField& field = profile_.fields[index];
    for (std::size_t i = 0; i < count_; ++i) {
        const RegisterRead& read = reads_[i];
        if (field.address >= read.address && field.address + field.registers() <= read.address + read.count) {
            return i;
        }
    }
    reads_[count_] = {field.address, field.registers()};
    return count_++;
}

void StatusFrames::take(std::size_t i, std::span<const std::uint16_t> registers) noexcept {
    const RegisterRead& read = reads_[i];
    for (FieldIndex index = 0; index < raw_.size(); ++index) {
        const RegisterField& field = profile_.fields[index];
        if (field.readable() && field.address >= read.address &&
            field.address + field.registers() <= read.address + read.count) {
            raw_[index] = take_raw(field, registers.subspan(std::size_t{field.address} - read.address));
        }
    }
}

bool StatusFrames::holds_now(const std::optional<FieldTest>& test, bool otherwise) const noexcept {
    return test ? holds(*test, raw_[test->field]) : otherwise;
}

DriveState StatusFrames::state() const noexcept {
    if (profile_.cia402) {
        const RegisterField* const status = profile_.field_of(FieldRole::status);
        const DriveState reported = status == nullptr
                                        ? DriveState::unknown
                                        : cia402_state(static_cast<std::uint32_t>(
                                              raw_[static_cast<std::size_t>(status - profile_.fields.data())]));
        return reported == DriveState::enabled && !holds_now(profile_.done, true) ? DriveState::moving : reported;
    }
    for (const StateTest& test : profile_.states) {
        if (holds(test.test, raw_[test.test.field])) {
            return test.state;
        }
    }
    return DriveState::unknown;
}

DriveReading StatusFrames::reading() const noexcept {
    DriveReading out;
    out.state = state();
    out.done = holds_now(profile_.done, out.state == DriveState::enabled);
    out.homed = holds_now(profile_.homed, false);
    for (FieldIndex index = 0; index < raw_.size(); ++index) {
        const RegisterField& field = profile_.fields[index];
        if (!field.readable()) {
            continue;
        }
        if (field.role == FieldRole::actual_position) {
            out.position_q16 = physical_of(field, raw_[index]);
        } else if (field.role == FieldRole::following_error) {
            out.following_error_q16 = physical_of(field, raw_[index]);
        } else if (field.role == FieldRole::fault_code) {
            out.fault_code = raw_[index];
        }
    }
    return out;
}

} // namespace splinefeed::hal::modbus
