// SPDX-License-Identifier: MIT
#include "host_sim/ports/modbus/drive_sentence.hpp"

#include <array>

namespace splinefeed::host {

std::string drive_sentence(const DriveTable& table, const hal::PortFailure& failure) {
    constexpr std::array advice{"", "; mend the cause, then run with --reset", ", and omit --home"}; // by Remedy
    const DriveTable::Drive& drive = table.drives[failure.drive];
    return drive.place + drive.name + ": " + failure.what + advice[static_cast<std::size_t>(failure.remedy)];
}

} // namespace splinefeed::host
