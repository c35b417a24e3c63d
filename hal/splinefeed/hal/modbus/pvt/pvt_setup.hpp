// SPDX-License-Identifier: MIT
// PvtSetup: what the drives of a ModbusPort do before the motion: each step by all of them, awaited.
#pragma once

#include "splinefeed/hal/modbus/pvt/drive_problem.hpp"
#include "splinefeed/hal/modbus/pvt/port_drive.hpp"
#include "splinefeed/hal/rt/clock.hpp"

#include <optional>
#include <vector>

namespace splinefeed::hal::modbus {

/// Blocks in each step, until all drives did it or one did not: that one is what it returns, at the latest when the
/// step's time is over. The drives and the clock must outlive it; the drives' buses run.
class PvtSetup {
public:
    static constexpr std::uint64_t command_us = 3'000'000; ///< for a command to be carried out

    PvtSetup(std::vector<PortDrive>& drives, const PortTimes& times, Clock& clock) noexcept
        : drives_(drives), times_(times), clock_(clock) {}

    /// Out of whatever state somebody left them in: what still moves comes to rest by itself, faults are reset.
    /// @param within_us  all of it
    [[nodiscard]] std::optional<DriveFailure> enable(std::uint64_t within_us);
    [[nodiscard]] std::optional<DriveFailure> command(PvtCommand command, std::uint32_t argument = 0);
    /// All at once, each as it is set up; until the last one stands. After a failure the others may still move.
    /// @param interrupted  asked meanwhile, may be null: a failure of a drive that is not there yet
    [[nodiscard]] std::optional<DriveFailure> home(bool (*interrupted)());

    /// Whether no drive has a command that it was told and has not confirmed.
    [[nodiscard]] static bool carried_out(const std::vector<PortDrive>& drives) noexcept;

private:
    void poll() noexcept;

    std::vector<PortDrive>& drives_;
    const PortTimes& times_;
    Clock& clock_;
    std::uint64_t now_us_ = 0;
};

} // namespace splinefeed::hal::modbus
