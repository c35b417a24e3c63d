// SPDX-License-Identifier: MIT
// VfdDrive: a simulated frequency inverter with the registers of a profile, and the spindle behind it.
#pragma once

#include "host_sim/drive/drive_model.hpp"
#include "host_sim/drive/register_file.hpp"

namespace splinefeed::host {

struct VfdDriveParameters {
    double ramp_hz_s = 200.0; ///< of the output, up and down
};

/// Its output follows the speed that was written, along the ramp, while it was told to run. Its spindle turns with the
/// output. Told to run in the other direction, it ramps through zero.
class VfdDrive final : public DriveModel {
public:
    /// @pre profile.stream is speed
    VfdDrive(hal::modbus::DriveProfile profile, const VfdDriveParameters& parameters);

    void advance(std::uint64_t now_us) override;
    [[nodiscard]] ModbusException read(int place, std::span<std::uint16_t> out) override;
    [[nodiscard]] ModbusException write(int place, std::span<const std::uint16_t> values) override;
    void power_cycle() override;
    [[nodiscard]] int axes() const override { return 1; }
    /// Thousandths of a period of the output, summed with the sign of the direction.
    [[nodiscard]] double position_counts(int /*axis*/) const override { return periods_ * 1000.0; }

    [[nodiscard]] const hal::modbus::DriveProfile& profile() const noexcept { return profile_; }
    /// With the sign of the direction. [Hz]
    [[nodiscard]] double output_hz() const noexcept { return output_hz_; }
    /// 1, -1 or 0: as it was told last.
    [[nodiscard]] int direction() const noexcept { return direction_; }
    /// A fault: the output is off, and the state is that of a fault, until power_cycle().
    void trip();

private:
    [[nodiscard]] bool is_commanded(hal::modbus::DriveCommand command) const;
    [[nodiscard]] double speed_hz() const;
    [[nodiscard]] hal::modbus::DriveState state() const;
    void refresh();

    hal::modbus::DriveProfile profile_;
    VfdDriveParameters parameters_;
    RegisterFile registers_;
    std::uint64_t now_us_ = 0;
    bool began_ = false;
    int direction_ = 0;
    bool faulted_ = false;
    double output_hz_ = 0.0;
    double periods_ = 0.0;
};

} // namespace splinefeed::host
