// SPDX-License-Identifier: MIT
// DriveReport: what a client knows of its drive.
#pragma once

#include "splinefeed/hal/modbus/link/link_counts.hpp"
#include "splinefeed/hal/modbus/pvt/clock_estimate.hpp"
#include "splinefeed/hal/modbus/pvt/drive_problem.hpp"
#include "splinefeed/hal/modbus/pvt/pvt_map.hpp"

namespace splinefeed::hal::modbus {

/// State of a drive at its last valid answer.
struct DriveReport {
    PvtIdentity identity;
    PvtStatus status;
    ClockEstimate clock;
    LinkCounts counts;
    DriveProblem problem = DriveProblem::none;
    LinkFault last_fault = LinkFault::none;
    std::uint8_t exception = 0;    ///< with LinkFault::exception
    bool command_pending = false;  ///< the last command is not answered yet
    bool command_refused = false;  ///< the drive refused it in its present state
    std::uint64_t answered_us = 0; ///< when the last valid answer was complete, line's clock
    std::uint64_t status_us = 0;   ///< earliest instant at which the drive had this status

    void count(const LinkAnswer& answer) noexcept {
        last_fault = answer.fault;
        exception = answer.exception;
        counts.count(answer.fault);
    }
};

} // namespace splinefeed::hal::modbus
