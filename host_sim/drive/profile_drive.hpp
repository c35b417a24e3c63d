// SPDX-License-Identifier: MIT
// ProfileDrive: a simulated drive of one axis that behaves as a drive profile states: CiA 402, or states and commands
// by masks; positioning moves that may change on the fly, or cyclic targets.
//
// Some behaviour is not in a profile and is assumed: a command takes effect when its first step is seen; commands that
// the profile does not distinguish (halt and quick stop by the same bit) are one. While a test of stays_on holds, its
// motor has power, from the start and whatever it is told, as that of a drive whose enable input is normally closed.
#pragma once

#include "host_sim/drive/cia402_machine.hpp"
#include "host_sim/drive/drive_model.hpp"
#include "host_sim/drive/positioning_axis.hpp"
#include "host_sim/drive/register_file.hpp"
#include "splinefeed/hal/modbus/profile/drive_profile.hpp"

#include <optional>
#include <vector>

namespace splinefeed::host {

struct ProfileDriveParameters {
    PositioningAxisParameters axis;
    double velocity_counts_s = 1e5;      ///< speed of moves, if the profile has no field for it
    double acceleration_counts_s2 = 1e6; ///< acceleration of moves and of a halt, if the profile has no field for it
    std::uint32_t period_us = 0;         ///< time in which a cyclic target is approached; 0: that of the profile, or 2
                                         ///< ms
};

class ProfileDrive final : public DriveModel {
public:
    /// @pre the profile does not stream pvt
    ProfileDrive(hal::modbus::DriveProfile profile, const ProfileDriveParameters& parameters);

    void advance(std::uint64_t now_us) override;
    [[nodiscard]] ModbusException read(int address, std::span<std::uint16_t> out) override;
    [[nodiscard]] ModbusException write(int address, std::span<const std::uint16_t> values) override;
    void power_cycle() override;
    void swap_words() override { registers_.swap_words(); }
    [[nodiscard]] int axes() const override { return 1; }
    [[nodiscard]] double position_counts(int /*axis*/) const override { return axis_.shaft().position_counts(); }

    [[nodiscard]] PositioningAxis& axis() noexcept { return axis_; }
    /// Acts like an input of the drive itself: a quick stop or, if its profile has no such state, a fault.
    void stop_by_itself();

private:
    [[nodiscard]] std::int64_t raw(hal::modbus::FieldRole role) const;
    [[nodiscard]] bool written(hal::modbus::FieldRole role) const;
    [[nodiscard]] double physical(hal::modbus::FieldRole role, double otherwise) const;
    void show(hal::modbus::FieldRole role, double physical);

    void take_settings();
    void execute_control();
    void execute_masks(const std::vector<std::int64_t>& before);
    [[nodiscard]] bool is_commanded(hal::modbus::DriveCommand command, const std::vector<std::int64_t>& before) const;
    void execute(hal::modbus::DriveCommand command);
    [[nodiscard]] bool follows_targets() const;
    [[nodiscard]] bool stays_on() const;
    void keep_on();
    void start(bool immediately, bool relative);
    void halt();
    void resume();
    [[nodiscard]] MoveLimits limits() const;

    void refresh();
    [[nodiscard]] hal::modbus::DriveState state() const;
    [[nodiscard]] std::int64_t status_by_masks() const;
    [[nodiscard]] std::int64_t status_by_cia402() const;
    [[nodiscard]] bool reports(hal::modbus::DriveState state) const;
    [[nodiscard]] std::int64_t with_tests(std::int64_t status) const;
    void check_watchdog();

    hal::modbus::DriveProfile profile_;
    ProfileDriveParameters parameters_;
    RegisterFile registers_;
    PositioningAxis axis_;
    Cia402Machine machine_;
    std::uint64_t now_us_ = 0;
    std::uint64_t exchange_us_ = 0; // time of the last exchange
    bool watchdog_fired_ = false;
    bool written_once_ = false;
    bool halted_ = false;
    bool quick_stopped_ = false;
    double target_ = 0.0;          // of the present move
    std::optional<double> queued_; // the target after it
};

} // namespace splinefeed::host
