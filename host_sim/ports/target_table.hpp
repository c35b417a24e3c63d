// SPDX-License-Identifier: MIT
// target_table: the kinds of targets that --target may name, the simulated machine first. A new one is a row in
// target_table.cpp.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/ports/run_target.hpp"

#include <memory>
#include <string>
#include <string_view>

namespace splinefeed::host {

/// What `splinefeed link` says of a target.
struct LinkReport {
    std::string text;    ///< lines for standard output
    std::string trouble; ///< why the machine cannot run as it stands, and the way out; empty: it can
};

struct TargetKind {
    std::string_view names; ///< what a user may write, and the page that says more
    std::string_view help;  ///< what --help says
    bool is_real = true;    ///< false: nothing but numbers moves
    /// Whether a target is meant to be one of these.
    bool (*is)(const std::string& target);
    /// Before all that follows. Throws AddressError if the address is wrong, and UsageError if this build does not
    /// support it.
    void (*check)(const std::string& target);
    /// Connects to the drives. `machine` must outlive the target. Throws UsageError, InputError, TargetError.
    std::unique_ptr<RunTarget> (*make)(const std::string& target, const MachineDescription& machine,
                                       const RunOptions& options);
    /// What `splinefeed link` says; null: there is nothing to measure.
    /// @param any_machine  the user named no machine. Throws like make().
    LinkReport (*report)(const std::string& target, const MachineDescription& machine, bool any_machine,
                         double seconds);
};

/// What --help says of all kinds, or of all that are real.
[[nodiscard]] std::string target_help(bool real);

/// The kind of a target whose address is right. Throws UsageError, with the option, if there is none.
[[nodiscard]] const TargetKind& target_kind(const std::string& target);

} // namespace splinefeed::host
