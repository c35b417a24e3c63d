// SPDX-License-Identifier: MIT
// target_table: the kinds of targets that --target may name, beside the simulated machine. A new one is a row here.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/target/run_target.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace splinefeed::host {

struct TargetKind {
    std::string_view names; ///< what a user may write, and the page that says more
    /// Whether a target is meant to be one of these.
    bool (*is)(const std::string& target);
    /// Throws AddressError where the address is wrong, and UsageError where this build cannot.
    void (*check)(const std::string& target);
    /// Connects to the drives. `machine` must outlive the target. Throws UsageError, InputError, TargetError.
    std::unique_ptr<RunTarget> (*make)(const std::string& target, const MachineDescription& machine,
                                       const RunOptions& options);
    /// What `splinefeed link` prints. @param any_machine  the user named none. Throws as make().
    std::string (*report)(const std::string& target, const MachineDescription& machine, bool any_machine,
                          double seconds);
};

extern const TargetKind modbus_kind;
extern const TargetKind gpio_kind; // of a build without libgpiod: one that says so

/// What --help says of targets.
inline constexpr const char* target_text =
    "modbus: each axis's drive as the machine file names it; modbus-tcp://HOST:PORT?unit=1 or "
    "modbus-rtu:///dev/ttyUSB0?baud=115200: one drive with all axes; gpio:///dev/gpiochip0?map=FILE.toml: step lines";

/// The kind of a target, whose address is right. Throws UsageError, with the option, where there is none.
/// @pre not "sim"
[[nodiscard]] const TargetKind& target_kind(const std::string& target);

/// Whether --target can be that: sim, or one of a kind. Throws UsageError where not.
void check_target(const std::string& target);

} // namespace splinefeed::host
