// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/setpoint_frames.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::hal::modbus {

SetpointFrames::SetpointFrames(const DriveProfile& profile)
    : profile_(profile), group_(profile.group_for(GroupUse::target)), last_(profile.fields.size()),
      sent_(profile.fields.size()), known_(profile.fields.size()) {
    by_role_.fill(no_field);
    for (FieldIndex i = 0; i < profile.fields.size(); ++i) {
        last_[i] = profile.fields[i].value;
        by_role_[static_cast<std::size_t>(profile.fields[i].role)] = i;
    }
}

RawValue SetpointFrames::set(FieldRole role, std::int64_t physical_q16) noexcept {
    const FieldIndex index = by_role_[static_cast<std::size_t>(role)];
    if (index == no_field) {
        return {};
    }
    const RawValue value = raw_of(profile_.fields[index], physical_q16);
    last_[index] = value.raw;
    return value;
}

double SetpointFrames::rounded(FieldRole role, double physical) const noexcept {
    const FieldIndex index = by_role_[static_cast<std::size_t>(role)];
    if (index == no_field) {
        return physical;
    }
    const RegisterField& field = profile_.fields[index];
    return static_cast<double>(physical_of(field, raw_of(field, std::llround(physical * physical_one)).raw)) /
           physical_one;
}

bool SetpointFrames::in_group(FieldIndex field) const noexcept {
    return group_ != nullptr && std::find(group_->fields.begin(), group_->fields.end(), field) != group_->fields.end();
}

void SetpointFrames::append(FieldIndex index, std::int64_t raw) noexcept {
    if (count_ == writes_.size()) {
        return;
    }
    const RegisterField& field = profile_.fields[index];
    RegisterWrite& write = writes_[count_++];
    write.address = field.address;
    write.count = field.registers();
    put_raw(field, raw, write.values);
    last_[index] = raw;
    sent_[index] = raw;
    known_[index] = true;
}

void SetpointFrames::append_group() noexcept {
    for (const CommandStep& step : profile_.steps_of(DriveCommand::start_move)) {
        if (in_group(step.field)) {
            const std::int64_t mask = step.mask;
            const std::int64_t bits = step.value;
            std::int64_t& raw = last_[step.field];
            raw = step.kind == StepKind::toggle ? raw ^ mask : (raw & ~mask) | bits;
        }
    }
    put_group(writes_[count_++]);
}

void SetpointFrames::put_group(RegisterWrite& write) const noexcept {
    write.address = group_->address;
    write.count = group_->registers;
    for (const FieldIndex index : group_->fields) {
        const RegisterField& field = profile_.fields[index];
        put_raw(field, last_[index], std::span(write.values).subspan(std::size_t{field.address} - group_->address));
    }
}

RegisterWrite SetpointFrames::single(FieldIndex field, std::int64_t raw) noexcept {
    RegisterWrite write;
    if (in_group(field)) {
        last_[field] = raw;
        put_group(write);
        return write;
    }
    count_ = 0;
    append(field, raw);
    return writes_[0];
}

// Whether the bits of start_move are set already: such a drive follows each new target without another start.
bool SetpointFrames::started() const noexcept {
    const std::vector<CommandStep>& steps = profile_.steps_of(DriveCommand::start_move);
    if (steps.empty() || in_group(steps.back().field)) {
        return true;
    }
    const CommandStep& step = steps.back();
    return step.kind == StepKind::level && known_[step.field] && last_[step.field] == sent_[step.field] &&
           (static_cast<std::uint64_t>(sent_[step.field]) & step.mask) == step.value;
}

void SetpointFrames::append_start() noexcept {
    for (const CommandStep& step : profile_.steps_of(DriveCommand::start_move)) {
        const std::int64_t mask = step.mask;
        const std::int64_t bits = step.value;
        const std::int64_t others = last_[step.field] & ~mask;
        if (in_group(step.field)) {
            continue;
        }
        if (step.kind == StepKind::toggle) {
            append(step.field, last_[step.field] ^ mask);
            continue;
        }
        if (step.kind == StepKind::edge) {
            append(step.field, others);
        }
        append(step.field, others | bits);
        if (step.kind == StepKind::pulse) {
            append(step.field, others);
        }
    }
}

std::span<const RegisterWrite> SetpointFrames::build() noexcept {
    count_ = 0;
    for (const FieldRole role :
         {FieldRole::profile_velocity, FieldRole::profile_acceleration, FieldRole::profile_deceleration}) {
        const FieldIndex index = by_role_[static_cast<std::size_t>(role)];
        const bool own_frame = index != no_field && profile_.fields[index].writable() && !in_group(index);
        if (own_frame && (!known_[index] || last_[index] != sent_[index])) {
            append(index, last_[index]);
        }
    }
    const FieldIndex target = by_role_[static_cast<std::size_t>(FieldRole::target_position)];
    if (target != no_field && !in_group(target)) {
        append(target, last_[target]);
    }
    if (group_ != nullptr) {
        append_group();
    }
    if (!started()) {
        append_start();
    }
    return std::span(writes_).first(count_);
}

} // namespace splinefeed::hal::modbus
