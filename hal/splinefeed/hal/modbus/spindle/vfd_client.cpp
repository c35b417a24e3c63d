// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/spindle/vfd_client.hpp"

#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/modbus/profile/drive_timing.hpp"
#include "splinefeed/hal/modbus/profile/field_codec.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace splinefeed::hal::modbus {

namespace {

constexpr std::size_t most_registers = 4; // of a field

} // namespace

VfdClient::VfdClient(VfdWiring wiring, const MakeWire& make, Clock& clock)
    : wiring_(std::move(wiring)), clock_(&clock), link_(make(wiring_.link, timing_of(wiring_.profile.link), clock)),
      read_(wiring_.profile.fields.size()), speed_(wiring_.profile.index_of(FieldRole::target_velocity)),
      output_(wiring_.profile.index_of(FieldRole::actual_velocity)) {
    for (const RegisterField& field : wiring_.profile.fields) {
        written_.push_back(field.value);
    }
}

bool VfdClient::connected() {
    return link_->connected() || link_->connect();
}

LinkAnswer VfdClient::write_raw(FieldIndex index, std::int64_t raw) {
    if (!connected()) {
        return {.fault = LinkFault::disconnected};
    }
    const RegisterField& field = wiring_.profile.fields[index];
    std::array<std::uint16_t, most_registers> registers{};
    put_raw(field, raw, registers);
    const int unit = wiring_.link.unit;
    const bool single = field.registers() == 1 && wiring_.profile.link.has(6);
    const LinkAnswer answer = field.table == RegisterTable::coils ? link_->write_coil(unit, field.address, raw != 0)
                              : single
                                  ? link_->write_one(unit, field.address, registers[0])
                                  : link_->write(unit, field.address, std::span(registers).first(field.registers()));
    if (answer.ok()) {
        written_[index] = raw;
    }
    return answer;
}

LinkAnswer VfdClient::read_registers(const RegisterField& field, std::span<std::uint16_t> out) {
    const int unit = wiring_.link.unit;
    if (!is_bit(field.table)) {
        return field.table == RegisterTable::input ? link_->read_inputs(unit, field.address, out)
                                                   : link_->read(unit, field.address, out);
    }
    bool on = false;
    const BitTable table = field.table == RegisterTable::coils ? BitTable::coils : BitTable::inputs;
    const LinkAnswer answer = link_->read_bit(unit, table, field.address, on);
    out[0] = on ? 1 : 0;
    return answer;
}

LinkAnswer VfdClient::read_raw(FieldIndex index, std::int64_t& raw) {
    if (!connected()) {
        return {.fault = LinkFault::disconnected};
    }
    const RegisterField& field = wiring_.profile.fields[index];
    std::array<std::uint16_t, most_registers> registers{};
    const std::span<std::uint16_t> out = std::span(registers).first(field.registers());
    const LinkAnswer answer = read_registers(field, out);
    if (answer.ok()) {
        raw = take_raw(field, out);
    }
    return answer;
}

double VfdClient::nearest_hz(double hz) const {
    const RegisterField& field = wiring_.profile.fields[speed_];
    return static_cast<double>(physical_of(field, raw_of(field, std::llround(hz * physical_one)).raw)) / physical_one;
}

LinkAnswer VfdClient::write_speed(double hz) {
    return write_raw(speed_, raw_of(wiring_.profile.fields[speed_], std::llround(hz * physical_one)).raw);
}

LinkAnswer VfdClient::command(DriveCommand command) {
    LinkAnswer answer;
    for (const CommandStep& step : wiring_.profile.steps_of(command)) {
        const std::int64_t mask = step.mask;
        answer = write_raw(step.field, (written_[step.field] & ~mask) | static_cast<std::int64_t>(step.value));
        if (!answer.ok()) {
            break;
        }
        clock_->sleep_us(us_per_ms * step.duration_ms);
    }
    return answer;
}

bool VfdClient::may_read() const {
    return clock_->now_us() >= link_->read_from_us(wiring_.link.unit);
}

// Several tests may be of one field: it is read once.
bool VfdClient::read_once(FieldIndex field, std::int64_t& raw, LinkAnswer& answer) {
    if (!read_[field]) {
        answer = read_raw(field, raw);
        if (!answer.ok()) {
            return false;
        }
        read_[field] = raw;
    }
    raw = *read_[field];
    return true;
}

LinkAnswer VfdClient::read(VfdReading& out) {
    const DriveProfile& profile = wiring_.profile;
    std::fill(read_.begin(), read_.end(), std::nullopt);
    LinkAnswer answer;
    VfdReading reading;
    std::int64_t raw = 0;
    if (!read_once(output_, raw, answer)) {
        return answer;
    }
    reading.output_hz = std::fabs(static_cast<double>(physical_of(profile.fields[output_], raw)) / physical_one);
    if (profile.done) {
        if (!read_once(profile.done->field, raw, answer)) {
            return answer;
        }
        reading.done = holds(*profile.done, raw);
    }
    for (const StateTest& state : profile.states) {
        if (state.state != DriveState::fault) {
            continue;
        }
        if (!read_once(state.test.field, raw, answer)) {
            return answer;
        }
        reading.fault = reading.fault || holds(state.test, raw);
    }
    const FieldIndex code = profile.index_of(FieldRole::fault_code);
    if (reading.fault && code != no_field && profile.fields[code].readable()) {
        if (!read_once(code, reading.fault_code, answer)) {
            return answer;
        }
    }
    out = reading;
    return answer;
}

} // namespace splinefeed::hal::modbus
