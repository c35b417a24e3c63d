// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/stream_cost.hpp"

#include <algorithm>

namespace splinefeed::hal::modbus {

namespace {

class BusWire {
public:
    BusWire(const DriveProfile& profile, const LinkAddress& address) : profile_(profile), address_(address) {
        int nearest = 0;
        for (const LinkSettings::Exchange& exchange : profile.link.exchanges) {
            if (address.wire == Wire::rtu && exchange.baud <= address.baud && exchange.baud > nearest) {
                nearest = exchange.baud;
                least_us_ = exchange.duration_us;
            }
        }
    }
    [[nodiscard]] std::uint32_t write(std::size_t registers) const { return exchange(registers, 0); }
    [[nodiscard]] std::uint32_t arrival(std::size_t registers) const {
        return frame_us(address_, exchange_bytes(address_, registers, 0).request);
    }
    [[nodiscard]] std::uint32_t read(std::size_t registers) const { return exchange(0, registers); }

private:
    [[nodiscard]] std::uint32_t exchange(std::size_t written, std::size_t read) const {
        const std::uint32_t turnaround_us = profile_.link.turnaround_us;
        return std::max(exchange_us(address_, written, read) + silence() + turnaround_us, least_us_);
    }
    [[nodiscard]] std::uint32_t silence() const {
        return address_.wire == Wire::rtu ? profile_.link.silence_before_us + profile_.link.silence_after_us : 0;
    }

    const DriveProfile& profile_;
    const LinkAddress& address_;
    std::uint32_t least_us_ = 0;
};

} // namespace

StreamCost stream_cost(const DriveProfile& profile, const LinkAddress& address) noexcept {
    const BusWire wire(profile, address);
    StreamCost cost;
    const FieldGroup* const target = profile.group_for(GroupUse::target);
    const auto within = [](const FieldGroup* group, const RegisterField& field) {
        return group != nullptr && field.address >= group->address && field.address < group->address + group->registers;
    };
    const auto append = [&](std::size_t registers) {
        cost.arrival_us = cost.target_us + wire.arrival(registers);
        cost.target_us += wire.write(registers);
    };
    if (target != nullptr) {
        append(target->registers);
    }
    for (const FieldRole role : {FieldRole::profile_velocity, FieldRole::target_position}) {
        const RegisterField* const field = profile.field_of(role);
        const bool needed = role == FieldRole::target_position || profile.stream == StreamWay::blocks;
        if (field != nullptr && needed && !within(target, *field)) {
            append(field->registers());
        }
    }
    const auto add_read = [&](std::size_t registers) {
        cost.status_us += wire.read(registers);
        cost.read_us = std::max(cost.read_us, wire.read(registers));
    };
    const FieldGroup* const status = profile.group_for(GroupUse::status);
    if (status != nullptr) {
        add_read(status->registers);
    }
    for (const FieldRole role : {FieldRole::status, FieldRole::actual_position}) {
        const RegisterField* const field = profile.field_of(role);
        if (field != nullptr && !within(status, *field)) {
            add_read(field->registers());
        }
    }
    return cost;
}

} // namespace splinefeed::hal::modbus
