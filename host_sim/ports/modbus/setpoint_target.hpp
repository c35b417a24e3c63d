// SPDX-License-Identifier: MIT
// SetpointTarget: a run on drives that get a target position or a block in every period, by their profiles.
#pragma once

#include "host_sim/ports/modbus/modbus_target.hpp"

#include "splinefeed/hal/modbus/setpoint/setpoint_port.hpp"

namespace splinefeed::host {

/// Converts the drives of a table to the form of the port. @pre they do not interpolate; the table must outlive the
/// result
[[nodiscard]] std::vector<hal::modbus::SetpointWiring> target_wiring(const DriveTable& table,
                                                                     const MachineDescription& machine);

/// Lowers the accelerations of axes whose drives take positioning blocks to a quarter of the drive's ramp, which is
/// that of `ramp=` or otherwise the machine file's own acceleration (BlockSettings::acceleration). Returns one line
/// that says what was lowered; empty: nothing.
[[nodiscard]] std::string fit_to_ramps(const DriveTable& table, MachineDescription& machine);

/// Checks that the registers of the drives can hold the machine's velocities, ramps and travel. Throws UsageError with
/// the axis, its value and the range.
void check_register_ranges(const DriveTable& table, const MachineDescription& machine, std::uint32_t period_us);

class SetpointTarget final : public ModbusTarget<hal::modbus::SetpointPort> {
public:
    /// Connects to the drives. Throws TargetError, and UsageError if the lines are too slow. @pre they do not
    /// interpolate
    SetpointTarget(DriveTable table, const MachineDescription& machine, const RunOptions& options,
                   const DriveWires& wires = {});

    [[nodiscard]] TargetFacts facts() const override;
    [[nodiscard]] std::string fit(MachineDescription& machine) const override { return fit_to_ramps(table_, machine); }
    void check(const MachineDescription& machine, double /*segment_us*/) const override {
        check_register_ranges(table_, machine, port_.period_us());
    }
    [[nodiscard]] std::vector<AxisPlace> standing() override;
    [[nodiscard]] std::vector<AxisPlace> places() const override;
    void describe(Summary& summary) const override;

private:
    [[nodiscard]] Signs signs() override { return {.least_ahead_us = port_.least_ahead_us()}; }
    [[nodiscard]] std::size_t axis_of(std::size_t drive) const noexcept;
};

} // namespace splinefeed::host
