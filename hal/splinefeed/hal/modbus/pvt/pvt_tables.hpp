// SPDX-License-Identifier: MIT
// PvtTables: reads and writes the tables of a drive with the map splinefeed-pvt before a run, over a bad line, too.
#pragma once

#include "splinefeed/hal/modbus/link/modbus_wire.hpp"
#include "splinefeed/hal/modbus/pvt/drive_report.hpp"

namespace splinefeed::hal::modbus {

/// Repeats what gets no answer for 1.5 s, and what fails otherwise or loses the connection five times. Identity and
/// configuration have no checksum, and a frame on TCP has none either: a reading is believed when the next one is
/// equal.
class PvtTables {
public:
    /// @param report  counts the exchanges. Both must outlive this object.
    PvtTables(ModbusWire& link, int unit, DriveReport& report) : link_(&link), unit_(unit), report_(&report) {}

    /// Reads at most pvt::identity_registers without a checksum of their own.
    /// @param refused  the problem that an exception as the answer means
    /// @returns none, `refused`, silent, or damaged where no two of 21 readings in a row are equal
    [[nodiscard]] DriveProblem read(int address, std::span<std::uint16_t> registers, DriveProblem refused) noexcept;
    /// Writes, and reads again what was written.
    /// @returns none, refused, silent, damaged, or not_kept where the drive holds something else
    [[nodiscard]] DriveProblem write(int address, std::span<const std::uint16_t> registers) noexcept;
    /// @returns none, silent, or damaged where the checksum is always wrong
    [[nodiscard]] DriveProblem read_status(int axes, PvtStatus& status) noexcept;

private:
    template <class Attempt>
    [[nodiscard]] bool retry(const Attempt& attempt) noexcept;
    [[nodiscard]] DriveProblem no_answer(DriveProblem refused) const noexcept;

    ModbusWire* link_;
    int unit_;
    DriveReport* report_;
};

} // namespace splinefeed::hal::modbus
