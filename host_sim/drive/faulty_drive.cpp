// SPDX-License-Identifier: MIT
#include "host_sim/drive/faulty_drive.hpp"

#include "splinefeed/hal/modbus/profile/field_codec.hpp"

#include <algorithm>
#include <array>

namespace splinefeed::host {

using namespace hal::modbus;

namespace {

constexpr std::size_t longest_field = 4; // registers
constexpr std::array stop_commands{DriveCommand::quick_stop, DriveCommand::halt, DriveCommand::stop};

bool lies_in(const RegisterField& field, int place, std::size_t count) {
    return field.place() >= place &&
           field.place() + static_cast<int>(field.registers()) <= place + static_cast<int>(count);
}

} // namespace

FaultyDrive::FaultyDrive(std::unique_ptr<DriveModel> drive, DriveProfile profile)
    : drive_(std::move(drive)), profile_(std::move(profile)), told_(profile_.fields.size()) {}

bool FaultyDrive::is_state(FieldIndex index) const {
    return profile_.fields[index].role == FieldRole::status ||
           std::ranges::any_of(profile_.states, [index](const StateTest& test) { return test.test.field == index; });
}

ModbusException FaultyDrive::read(int place, std::span<std::uint16_t> out) {
    const ModbusException refused = drive_->read(place, out);
    if (refused != ModbusException::none) {
        return refused;
    }
    for (FieldIndex i = 0; i < told_.size(); ++i) {
        const RegisterField& field = profile_.fields[i];
        if (!field.readable() || !lies_in(field, place, out.size())) {
            continue;
        }
        const std::span<std::uint16_t> in_frame =
            out.subspan(static_cast<std::size_t>(field.place() - place), field.registers());
        const bool state = is_state(i);
        const bool located = field.role == FieldRole::actual_position || field.role == FieldRole::actual_velocity;
        const bool stuck = (state && faults_.stuck_state) || (located && faults_.stuck_place);
        told_[i] = stuck ? told_[i] : state && faults_.state ? *faults_.state : take_raw(field, in_frame);
        const bool dithers = field.role == FieldRole::actual_position;
        const std::int64_t noise_q16 =
            std::int64_t{noise_.next(dithers ? faults_.dither_counts : 0)} * (std::int64_t{1} << physical_bits);
        put_raw(field, noise_q16 == 0 ? told_[i] : raw_of(field, physical_of(field, told_[i]) + noise_q16).raw,
                in_frame);
    }
    return ModbusException::none;
}

// A frame that has all bits of the first step of a stop, and is no step of `disable`: 0 in a control word is both.
bool FaultyDrive::stops(int place, std::span<const std::uint16_t> values) const {
    const auto has = [&](const CommandStep& step) {
        const RegisterField& field = profile_.fields[step.field];
        return lies_in(field, place, values.size()) &&
               holds({step.field, step.mask, step.value},
                     take_raw(field, values.subspan(static_cast<std::size_t>(field.place() - place))));
    };
    const std::vector<CommandStep>& off = profile_.steps_of(DriveCommand::disable);
    return std::ranges::none_of(off, has) && std::ranges::any_of(stop_commands, [&](DriveCommand command) {
               const std::vector<CommandStep>& steps = profile_.steps_of(command);
               return !steps.empty() && has(steps.front());
           });
}

ModbusException FaultyDrive::write(int place, std::span<const std::uint16_t> values) {
    return faults_.refuses_stops && stops(place, values) ? ModbusException::device_failure
                                                         : drive_->write(place, values);
}

void FaultyDrive::swap_words() {
    for (RegisterField& field : profile_.fields) {
        field.word_order =
            field.word_order == Significance::high_first ? Significance::low_first : Significance::high_first;
    }
    drive_->swap_words();
}

// Written field by field: what a profile groups may be written alone, too.
void FaultyDrive::second_master() {
    for (const DriveCommand command : stop_commands) {
        for (const CommandStep& step : profile_.steps_of(command)) {
            const RegisterField& field = profile_.fields[step.field];
            std::array<std::uint16_t, longest_field> in_frame{};
            put_raw(field, step.value, in_frame);
            static_cast<void>(drive_->write(field.place(), std::span(in_frame).first(field.registers())));
        }
        if (!profile_.steps_of(command).empty()) {
            return;
        }
    }
}

} // namespace splinefeed::host
