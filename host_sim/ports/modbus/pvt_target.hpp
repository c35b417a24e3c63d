// SPDX-License-Identifier: MIT
// PvtTarget: a run on drives that interpolate: which drives answer, whether the line carries the plan, and the results
// of the run.
#pragma once

#include "host_sim/ports/modbus/modbus_target.hpp"

#include "splinefeed/hal/modbus/pvt/modbus_port.hpp"

namespace splinefeed::host {

/// Converts the drives of a table to the form of the port. @pre they interpolate
[[nodiscard]] std::vector<hal::modbus::DriveWiring> pvt_wiring(const DriveTable& table,
                                                               const MachineDescription& machine);

/// Checks that segments of this duration can carry the machine's velocities. Throws UsageError with the axis, its value
/// and the range.
void check_pvt_range(const MachineDescription& machine, double segment_us);

class PvtTarget final : public ModbusTarget<hal::modbus::ModbusPort> {
public:
    /// Connects to the drives. Throws TargetError. @pre they interpolate
    PvtTarget(DriveTable table, const MachineDescription& machine, const RunOptions& options,
              const DriveWires& wires = {});

    [[nodiscard]] TargetFacts facts() const override;
    void check(const MachineDescription& machine, double segment_us) const override {
        check_pvt_range(machine, segment_us);
    }
    [[nodiscard]] std::vector<AxisPlace> standing() override;
    [[nodiscard]] std::vector<AxisPlace> places() const override;
    void describe(Summary& summary) const override;

private:
    [[nodiscard]] Signs signs() override { return {.least_ahead_us = port_.least_ahead_us()}; }
    [[nodiscard]] int counts_of(std::size_t drive, std::size_t drive_axis) const;

    const hal::Clock* clock_;
    double least_segment_us_ = 0.0;
};

} // namespace splinefeed::host
