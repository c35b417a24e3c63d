// SPDX-License-Identifier: MIT
// PvtSetup: prepares the drives of a ModbusPort for the motion. Each step waits for all drives.
#pragma once

#include "splinefeed/hal/modbus/pvt/drive_problem.hpp"
#include "splinefeed/hal/modbus/pvt/port_drive.hpp"
#include "splinefeed/hal/rt/clock.hpp"

#include <optional>
#include <vector>

namespace splinefeed::hal::modbus {

/// Each step blocks until all drives have completed it, one has failed or the time is over, and returns the failure.
/// Drives and clock must outlive the object. @pre the buses of the drives run
class PvtSetup {
public:
    static constexpr std::uint64_t command_us = 3'000'000; ///< time limit of a command

    PvtSetup(std::vector<PortDrive>& drives, const PortTimes& times, Clock& clock) noexcept
        : drives_(drives), times_(times), clock_(clock) {}

    /// Enables the drives from any state: waits for moving drives to stop, resets faults.
    /// @param within_us  time limit of all drives together [us]
    [[nodiscard]] std::optional<DriveFailure> enable(std::uint64_t within_us);
    [[nodiscard]] std::optional<DriveFailure> command(PvtCommand command, std::uint32_t argument = 0);
    /// Homes all drives at the same time, each by its own settings, and waits until the last one stands. After a
    /// failure other drives may still move.
    /// @param interrupted  polled meanwhile, may be null; true: a failure of a drive that is still homing
    [[nodiscard]] std::optional<DriveFailure> home(bool (*interrupted)());

    /// Whether no drive has an unconfirmed command.
    [[nodiscard]] static bool carried_out(const std::vector<PortDrive>& drives) noexcept;

private:
    void poll() noexcept;

    std::vector<PortDrive>& drives_;
    const PortTimes& times_;
    Clock& clock_;
    std::uint64_t now_us_ = 0;
};

} // namespace splinefeed::hal::modbus
