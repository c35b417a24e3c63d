// SPDX-License-Identifier: MIT
// SetpointTarget: a run on drives that are told by their profiles where to be, period by period.
#pragma once

#include "host_sim/target/modbus/modbus_target.hpp"

#include "splinefeed/hal/modbus/setpoint/setpoint_port.hpp"

namespace splinefeed::host {

/// The drives of a table in the port's form. @pre they do not interpolate; the table must outlive what it is given to
[[nodiscard]] std::vector<hal::modbus::SetpointWiring> target_wiring(const DriveTable& table,
                                                                     const MachineDescription& machine);

/// Lowers the accelerations of axes whose drives are told blocks to a quarter of the drive's ramp, which is that of
/// `ramp=` or else the machine file's own acceleration (BlockSettings::acceleration). Returns what it lowered, in a
/// line; empty: nothing.
[[nodiscard]] std::string fit_to_ramps(const DriveTable& table, MachineDescription& machine);

/// Whether the registers of the drives hold the machine's velocities, ramps and travel. Throws UsageError with the
/// axis, its value and the range.
void check_register_ranges(const DriveTable& table, const MachineDescription& machine, std::uint32_t period_us);

class SetpointTarget final : public ModbusTarget<hal::modbus::SetpointPort> {
public:
    /// Connects to the drives. Throws TargetError, and UsageError where the wires are too slow. @pre they do not
    /// interpolate
    SetpointTarget(DriveTable table, const MachineDescription& machine, bool home);

    // Targets are taken from the path at any instant: segments may be as short as they like.
    [[nodiscard]] double least_segment_us() const noexcept override { return 0.0; }
    [[nodiscard]] bool resamples() const noexcept override { return true; }
    [[nodiscard]] std::string fit(MachineDescription& machine) const override { return fit_to_ramps(table_, machine); }
    void check(const MachineDescription& machine, double /*segment_us*/) const override {
        check_register_ranges(table_, machine, port_.period_us());
    }
    [[nodiscard]] std::string note() const override;
    [[nodiscard]] std::string where() const override;
    void describe(Summary& summary) const override;

private:
    [[nodiscard]] std::string prepare(const FeedSegment& first) override;
    [[nodiscard]] std::string fault() const override;

    [[nodiscard]] std::string sentence(const std::string& trouble) const;
    [[nodiscard]] std::size_t axis_of(std::size_t drive) const noexcept;
};

} // namespace splinefeed::host
