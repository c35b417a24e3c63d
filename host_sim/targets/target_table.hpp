// SPDX-License-Identifier: MIT
// target_table: the kinds of targets that --target may name, in addition to the simulated machine. A new kind is a row
// here.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/target/run_target.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace splinefeed::host {

struct TargetKind {
    std::string_view names; ///< the forms that a user may write, and the page that explains them
    /// Whether a target has the form of this kind.
    bool (*is)(const std::string& target);
    /// Throws AddressError if the address is wrong, and UsageError if this build does not support it.
    void (*check)(const std::string& target);
    /// Connects to the drives. `machine` must outlive the target. Throws UsageError, InputError, TargetError.
    std::unique_ptr<RunTarget> (*make)(const std::string& target, const MachineDescription& machine,
                                       const RunOptions& wishes);
    /// The text that `splinefeed link` prints. @param any_machine  the user named no machine. Throws like make().
    std::string (*report)(const std::string& target, const MachineDescription& machine, bool any_machine,
                          double seconds);
};

extern const TargetKind modbus_kind;
extern const TargetKind gpio_kind; // in a build without libgpiod: a kind that reports this

/// The text of --help about targets.
inline constexpr const char* target_text =
    "modbus: each axis's drive as the machine file names it; modbus-tcp://HOST:PORT?unit=1 or "
    "modbus-rtu:///dev/ttyUSB0?baud=115200: one drive with all axes; gpio:///dev/gpiochip0?map=FILE.toml: step lines";

/// The kind of a target whose address is right. Throws UsageError, with the option, if there is none.
/// @pre not "sim"
[[nodiscard]] const TargetKind& target_kind(const std::string& target);

/// Checks that --target can have this value: sim, or a target of some kind. Throws UsageError if not.
void check_target(const std::string& target);

} // namespace splinefeed::host
