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
    static constexpr std::uint64_t homing_us = 300'000'000;
    /// A drive that is silent for this long while it homes is not waited for: the others would home on.
    static constexpr std::uint64_t silent_us = 1'000'000;

    PvtSetup(std::vector<PortDrive>& drives, const PortTimes& times, Clock& clock) noexcept
        : drives_(drives), times_(times), clock_(clock), resets_(drives.size(), Reset::none) {}

    /// Enables the drives from any state, within times.away_us: waits for moving drives to stop.
    /// @param reset  resets faults, once each
    [[nodiscard]] std::optional<DriveFailure> enable(bool reset);
    /// @param interrupted  as of home(); nothing is waited for any more
    /// @param axes  of the machine, by bits: drives that move none of them do not get it
    [[nodiscard]] std::optional<DriveFailure> command(PvtCommand command, std::uint32_t argument = 0,
                                                      bool (*interrupted)() = nullptr, std::uint32_t axes = UINT32_MAX);
    /// Homes the drives that move these axes at the same time, each by its own settings, and waits until the last one
    /// stands. After a failure other drives may still move.
    /// @param axes  of the machine, by bits
    /// @param interrupted  polled meanwhile, may be null; true: a failure of a drive that is still homing
    [[nodiscard]] std::optional<DriveFailure> home(std::uint32_t axes, bool (*interrupted)());

    /// Whether no drive has an unconfirmed command.
    [[nodiscard]] static bool carried_out(const std::vector<PortDrive>& drives) noexcept;

private:
    void update() noexcept;
    [[nodiscard]] std::optional<DriveFailure> look_at_enabling(bool reset);
    template <class Problem>
    [[nodiscard]] std::optional<DriveFailure> first_with(const Problem& problem) const;
    template <class Done>
    [[nodiscard]] bool await(std::uint64_t bound_us, const Done& done);

    std::vector<PortDrive>& drives_;
    const PortTimes& times_;
    Clock& clock_;
    enum class Reset : std::uint8_t { none, sent, executed };
    std::vector<Reset> resets_;
};

} // namespace splinefeed::hal::modbus
