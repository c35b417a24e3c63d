// SPDX-License-Identifier: MIT
// DrivenDrive: the model of a profile, and a client that knows the profile alone.
#pragma once

#include "host_sim/config/shipped_profiles.hpp"
#include "host_sim/drive/profile_drive.hpp"
#include "splinefeed/hal/modbus/profile/field_codec.hpp"
#include "support/catch.hpp"

#include <array>
#include <cmath>
#include <string>

namespace splinefeed::test {

class DrivenDrive {
public:
    DrivenDrive(hal::modbus::DriveProfile profile, const host::ProfileDriveParameters& parameters)
        : profile_(std::move(profile)), drive_(profile_, parameters), last_(profile_.fields.size()) {
        for (std::size_t i = 0; i < last_.size(); ++i) {
            last_[i] = profile_.fields[i].value;
        }
    }
    explicit DrivenDrive(const std::string& name, double start_counts = 0.0)
        : DrivenDrive(host::find_profile(name), at(start_counts)) {}

    [[nodiscard]] host::ProfileDrive& model() { return drive_; }
    [[nodiscard]] const hal::modbus::DriveProfile& profile() const { return profile_; }
    [[nodiscard]] std::uint64_t now_us() const { return now_us_; }

    void wait_us(std::uint64_t duration_us) { drive_.advance(now_us_ += duration_us); }
    void wait_ms(std::uint64_t duration_ms) { wait_us(1000 * duration_ms); }

    [[nodiscard]] const hal::modbus::RegisterField& field(hal::modbus::FieldRole role) const {
        const hal::modbus::RegisterField* const found = profile_.field_of(role);
        REQUIRE(found != nullptr);
        return *found;
    }

    /// A field of the target group goes out with the whole group.
    void write(const hal::modbus::RegisterField& field, std::int64_t raw) {
        last_[index(field)] = raw;
        const hal::modbus::FieldGroup* const group = profile_.group_for(hal::modbus::GroupUse::target);
        if (group != nullptr && field.address >= group->address && field.address < group->address + group->registers) {
            send_group();
            return;
        }
        std::array<std::uint16_t, 4> registers{};
        put_raw(field, raw, registers);
        REQUIRE(drive_.write(field.address, std::span(registers).first(field.registers())) ==
                host::ModbusException::none);
    }
    void write(hal::modbus::FieldRole role, std::int64_t raw) { write(field(role), raw); }
    void write_physical(hal::modbus::FieldRole role, double physical) {
        write(role, raw_of(field(role), std::llround(physical * 65536.0)).raw);
    }

    [[nodiscard]] std::int64_t raw_read(hal::modbus::FieldRole role) {
        const hal::modbus::RegisterField& wanted = field(role);
        std::array<std::uint16_t, 4> registers{};
        REQUIRE(drive_.read(wanted.address, std::span(registers).first(wanted.registers())) ==
                host::ModbusException::none);
        return take_raw(wanted, registers);
    }
    [[nodiscard]] std::int64_t read(hal::modbus::FieldRole role) {
        if (profile_.link.reads_zero_until_written && !written_) {
            send_group();
        }
        return raw_read(role);
    }
    [[nodiscard]] std::int64_t position() { return read(hal::modbus::FieldRole::actual_position); }
    [[nodiscard]] bool done() { return holds(profile_.done.value(), read(hal::modbus::FieldRole::status)); }

    [[nodiscard]] hal::modbus::DriveState state() {
        const std::int64_t status = read(hal::modbus::FieldRole::status);
        if (profile_.cia402) {
            return hal::modbus::cia402_state(static_cast<std::uint32_t>(status));
        }
        for (const hal::modbus::StateTest& test : profile_.states) {
            if (holds(test.test, status)) {
                return test.state;
            }
        }
        return hal::modbus::DriveState::unknown;
    }

    void command(hal::modbus::DriveCommand command) {
        using hal::modbus::StepKind;
        REQUIRE_FALSE(profile_.steps_of(command).empty());
        for (const hal::modbus::CommandStep& step : profile_.steps_of(command)) {
            const hal::modbus::RegisterField& target = profile_.fields[step.field];
            const std::int64_t mask = step.mask;
            const std::int64_t others = last_[step.field] & ~mask;
            const std::int64_t bits = step.value;
            if (step.kind == StepKind::toggle) {
                write(target, last_[step.field] ^ mask);
                continue;
            }
            if (step.kind == StepKind::edge) {
                write(target, others);
            }
            write(target, others | bits);
            wait_ms(step.duration_ms);
            if (step.kind == StepKind::pulse) {
                write(target, others);
            }
        }
    }

    /// Mode, following-error window, watchdog, enable.
    void begin() {
        using hal::modbus::FieldRole;
        if (profile_.stream_mode) {
            write(FieldRole::mode, *profile_.stream_mode);
        }
        if (profile_.following_error_window_counts) {
            write_physical(FieldRole::following_error_window,
                           static_cast<double>(*profile_.following_error_window_counts));
        }
        if (profile_.watchdog_timeout_ms > 0) {
            write(FieldRole::watchdog, profile_.watchdog_timeout_ms);
        }
        command(hal::modbus::DriveCommand::enable);
    }

    void set_physical(hal::modbus::FieldRole role, double physical) {
        if (profile_.field_of(role) != nullptr) {
            last_[index(field(role))] = raw_of(field(role), std::llround(physical * 65536.0)).raw;
        }
    }

    /// A positioning move, or a cyclic target.
    void move(double target, double velocity, double acceleration) {
        using hal::modbus::FieldRole;
        const std::array<std::pair<FieldRole, double>, 4> values{{{FieldRole::profile_velocity, velocity},
                                                                  {FieldRole::profile_acceleration, acceleration},
                                                                  {FieldRole::profile_deceleration, acceleration},
                                                                  {FieldRole::target_position, target}}};
        for (const auto& [role, value] : values) {
            set_physical(role, value);
        }
        send_move();
    }

    /// What was set: in the frame of the target group with its trigger, or field by field and the trigger behind.
    void send_move() {
        using hal::modbus::FieldRole;
        if (profile_.group_for(hal::modbus::GroupUse::target) == nullptr) {
            for (const FieldRole role : {FieldRole::profile_velocity, FieldRole::profile_acceleration,
                                         FieldRole::profile_deceleration, FieldRole::target_position}) {
                if (profile_.field_of(role) != nullptr) {
                    write(role, last_[index(field(role))]);
                }
            }
        } else if (profile_.steps_of(hal::modbus::DriveCommand::start_move).empty()) {
            send_group();
        }
        const std::vector<hal::modbus::CommandStep>& steps = profile_.steps_of(hal::modbus::DriveCommand::start_move);
        if (steps.empty() || (started_ && profile_.cia402)) {
            return; // it follows each target by itself
        }
        command(hal::modbus::DriveCommand::start_move);
        started_ = true;
    }

private:
    static host::ProfileDriveParameters at(double start_counts) {
        host::ProfileDriveParameters parameters;
        parameters.axis.start_counts = start_counts;
        return parameters;
    }
    [[nodiscard]] std::size_t index(const hal::modbus::RegisterField& field) const {
        return static_cast<std::size_t>(&field - profile_.fields.data());
    }
    void send_group() {
        const hal::modbus::FieldGroup& group = *profile_.group_for(hal::modbus::GroupUse::target);
        std::vector<std::uint16_t> registers(group.registers);
        for (const std::size_t i : group.fields) {
            put_raw(profile_.fields[i], last_[i],
                    std::span(registers).subspan(profile_.fields[i].address - std::size_t{group.address}));
        }
        REQUIRE(drive_.write(group.address, registers) == host::ModbusException::none);
        written_ = true;
    }

    hal::modbus::DriveProfile profile_;
    host::ProfileDrive drive_;
    std::vector<std::int64_t> last_; // raw, as written last
    std::uint64_t now_us_ = 0;
    bool written_ = false;
    bool started_ = false;
};

} // namespace splinefeed::test
