// SPDX-License-Identifier: MIT
// In place of drives on Modbus: a page has no line to them.
#include "host_sim/base/input_error.hpp"
#include "host_sim/ports/modbus/modbus_outputs.hpp"
#include "host_sim/ports/target_table.hpp"

namespace splinefeed::host {

extern const TargetKind modbus_kind{
    .names = "modbus",
    .help = "",
    .is = [](const std::string& target) { return target.rfind("modbus", 0) == 0; },
    .check = [](const std::string& /*target*/) { throw UsageError("a page has no line to drives"); },
    .make = nullptr, // nobody comes so far
    .report = nullptr,
};

OutputParts make_modbus_outputs(const MachineDescription& /*machine*/, const std::string& /*target*/) {
    return {};
}

} // namespace splinefeed::host
