// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/setpoint_drive.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace splinefeed::hal::modbus {

SetpointDrive::SetpointDrive(const DriveProfile& profile, ModbusWire& link, int unit)
    : profile_(&profile), link_(&link), unit_(unit), status_(profile) {}

std::string SetpointDrive::trouble(const char* what) const {
    return std::string(what) + ": " + describe(answer_, *link_);
}

bool SetpointDrive::record(const LinkAnswer& answer) noexcept {
    answer_ = answer;
    counts_.count(answer.fault);
    if (answer.ok()) {
        answered_us_ = answer.answered_us;
    }
    return answer.ok();
}

bool SetpointDrive::write(const RegisterWrite& write) noexcept {
    return record(profile_->link.has(16) ? link_->write(unit_, write.address, write.registers())
                                         : link_->write_one(unit_, write.address, write.values[0]));
}

bool SetpointDrive::read(std::uint16_t address, std::span<std::uint16_t> out) noexcept {
    return record(link_->read(unit_, address, out));
}

bool SetpointDrive::write_field(FieldIndex field, std::int64_t raw) {
    return retry([&] { return write(frames().single(field, raw)); });
}

bool SetpointDrive::write_role(FieldRole role, std::int64_t physical_q16) {
    const RegisterField* const field = profile_->field_of(role);
    return field == nullptr || !field->writable() ||
           write_field(static_cast<FieldIndex>(field - profile_->fields.data()), raw_of(*field, physical_q16).raw);
}

bool SetpointDrive::write_initial() {
    return std::all_of(profile_->init.begin(), profile_->init.end(), [&](const DriveProfile::InitialValue& value) {
        const RegisterField& field = profile_->fields[value.field];
        std::array<std::uint16_t, 4> registers{};
        const std::span<std::uint16_t> in = std::span(registers).first(field.registers());
        if (field.flash && field.readable()) {
            if (!retry([&] { return read(field.address, in); })) {
                return false;
            }
            if (take_raw(field, in) == value.value) {
                return true;
            }
        }
        return write_field(value.field, value.value);
    });
}

bool SetpointDrive::read_next() noexcept {
    const std::size_t i = next_read_++ % status_.reads().size();
    const RegisterRead& frame = status_.reads()[i];
    std::array<std::uint16_t, RegisterWrite::most> registers{};
    const std::span<std::uint16_t> in = std::span(registers).first(frame.count);
    if (!read(frame.address, in)) {
        return false;
    }
    status_.take(i, in);
    status_us_[i] = answer_.arrived_us;
    reading_ = status_.reading();
    return true;
}

bool SetpointDrive::read_status() noexcept {
    next_read_ = 0;
    for (std::size_t i = 0; i < status_.reads().size(); ++i) {
        if (!read_next()) {
            return false;
        }
    }
    return true;
}

std::string SetpointDrive::check_setup(const std::vector<DriveProfile::SetupCheck>& checks, bool must_hold,
                                       const char* unread) {
    for (const DriveProfile::SetupCheck& check : checks) {
        const RegisterField& field = profile_->fields[check.test.field];
        std::array<std::uint16_t, 4> registers{};
        const std::span<std::uint16_t> in = std::span(registers).first(field.registers());
        if (!retry([&] { return read(field.address, in); })) {
            return trouble(unread);
        }
        if (holds(check.test, take_raw(field, in)) != must_hold) {
            return check.sentence;
        }
    }
    return {};
}

std::string SetpointDrive::open() {
    if (!link_->connected() && !link_->connect()) {
        return "there is no connection: " + link_->error();
    }
    if (profile_->link.reads_zero_until_written) {
        SetpointFrames neutral(*profile_); // all fields at their defaults: nothing starts
        const RegisterField* const control = profile_->field_of(FieldRole::control);
        const auto index = static_cast<FieldIndex>(control - profile_->fields.data());
        if (control != nullptr && !retry([&] { return write(neutral.single(index, control->value)); })) {
            return trouble("it cannot be written to");
        }
    }
    if (std::string what = check_setup(profile_->identity, true, "its identity cannot be read"); !what.empty()) {
        return what;
    }
    if (std::string what = check_setup(profile_->stays_on, false, "what keeps its motor on cannot be read");
        !what.empty()) {
        return what;
    }
    return retry([&] { return read_status(); }) ? std::string() : trouble("its status cannot be read");
}

std::uint64_t SetpointDrive::status_us() const noexcept {
    return *std::min_element(status_us_.begin(), status_us_.begin() + static_cast<int>(status_.reads().size()));
}

bool SetpointDrive::stop(StopRequest request) noexcept {
    for (const DriveCommand way : {DriveCommand::quick_stop, DriveCommand::halt, DriveCommand::disable}) {
        const bool suits = request != StopRequest::disable || way == DriveCommand::disable;
        if (suits && !profile_->steps_of(way).empty()) {
            return command(way, 0);
        }
    }
    return false;
}

bool SetpointDrive::command(DriveCommand command, int failures, const CommandPause& pause) noexcept {
    CommandSequence sequence(*profile_, frames());
    if (!sequence.begin(command)) {
        return false;
    }
    int failed = 0;
    while (!sequence.finished()) {
        if (pause && !pause(sequence.due_us())) {
            return false;
        }
        link_->clock().sleep_until_us(sequence.due_us());
        if (write(sequence.next())) {
            sequence.on_sent(link_->clock().now_us());
        } else if (++failed > failures) {
            return false;
        }
    }
    return true;
}

void SetpointDrive::configure(const SetpointSettings& settings) {
    standstill_counts_ = settings.standstill_counts;
    if (profile_->stream == StreamWay::blocks) {
        block_.emplace(*profile_, BlockSettings{.axis = settings.axis,
                                                .period_us = settings.period_us,
                                                .acceleration = settings.ramp_counts_s2,
                                                .fastest = settings.fastest_counts_s});
    } else {
        cyclic_.emplace(*profile_, CyclicSettings{settings.axis, profile_->period_us, settings.period_us,
                                                  settings.acceleration_counts_s2, settings.fastest_counts_s});
    }
}

bool SetpointDrive::prime() {
    if (!block_) {
        cyclic_->begin(reading_.position_q16);
        return true;
    }
    block_->begin(static_cast<double>(reading_.position_q16) / (1 << physical_bits));
    prepared_ = block_->prime();
    return retry([&] { return send(); });
}

void SetpointDrive::prepare_frames(const TrajectoryBuffer& track, const MotionInstant& instant) noexcept {
    prepared_ = block_ ? block_->block(track, instant) : cyclic_->frame(track, instant);
}

// Retries lost frames: values that do not change are not sent with the next target.
bool SetpointDrive::send() noexcept {
    counts_.segments += prepared_.empty() ? 0U : 1U;
    const auto write_retried = [this](const RegisterWrite& frame) {
        for (int i = 0; i <= profile_->link.retries; ++i) {
            if (write(frame)) {
                return true;
            }
        }
        return false;
    };
    bool sent = std::all_of(prepared_.begin(), prepared_.end(), write_retried);
    if (sent && delivery_unknown_ && block_ && !prepared_.empty()) {
        prepared_ = block_->repeat();
        sent = std::all_of(prepared_.begin(), prepared_.end(), write_retried);
    }
    delivery_unknown_ = prepared_.empty() ? delivery_unknown_ : !sent;
    if (!sent) {
        frames().forget();
    }
    return sent;
}

bool SetpointDrive::at_target() const noexcept {
    constexpr double window_counts = 64.0; // wider than the window in which drives report `in position`
    const double reported_counts = static_cast<double>(reading_.position_q16) / (1 << physical_bits);
    return !block_ || std::fabs(reported_counts - block_->target_counts()) <= window_counts;
}

void SetpointDrive::on_setpoint_timeout(const TrajectoryBuffer& track, const MotionInstant& instant) noexcept {
    if (cyclic_) {
        cyclic_->on_setpoint_timeout(track, instant);
    }
}

void SetpointDrive::resync_position() noexcept {
    constexpr double rounding_counts = 1.5; // of the report and of the model
    const double reported_counts = static_cast<double>(reading_.position_q16) / (1 << physical_bits);
    if (block_ &&
        std::fabs(reported_counts - block_->position_counts()) > std::max(rounding_counts, standstill_counts_)) {
        block_->begin(reported_counts);
    }
}

void SetpointDrive::on_arrival(std::uint64_t earliest_us, std::uint64_t latest_us) noexcept {
    if (block_ && !prepared_.empty()) {
        block_->on_arrival(latest_us == UINT64_MAX ? UINT64_MAX : std::midpoint(answer_.arrived_us, latest_us));
    } else if (cyclic_) {
        cyclic_->on_arrival(earliest_us, latest_us);
    }
}

bool SetpointDrive::end_sent(const TrajectoryBuffer& track, std::uint64_t motion_us) const noexcept {
    return block_ ? block_->end_sent() : cyclic_->end_sent(track, motion_us);
}

bool SetpointDrive::clamped() const noexcept {
    return block_ ? block_->clamped() : cyclic_->clamped();
}

} // namespace splinefeed::hal::modbus
