// SPDX-License-Identifier: MIT
// MachineChoice: which machine a call of the tool is for: a file, and numbers of it to try.
#pragma once

#include "host_sim/config/machine_description.hpp"

#include <string>
#include <vector>

namespace splinefeed::host {

struct MachineChoice {
    std::string file;                    ///< as --machine names it; "default": the default machine; empty: not named
    std::vector<std::string> settings{}; ///< of --set: "axis.x.max_jerk_mm_s3=30000"
    std::string program{};               ///< the input, beside which a machine.toml counts; empty: none
};

/// The machine of the file; if none is named of `machine.toml` beside the program, else of
/// `~/.config/splinefeed/machine.toml` (XDG_CONFIG_HOME), else the default machine; with the settings. Throws
/// InputError, and UsageError for a setting.
[[nodiscard]] MachineDescription choose_machine(const MachineChoice& choice);

/// What a user has to know of the choice: where it is from, and numbers that few machines have; empty: nothing. @param
/// machine  as chosen
[[nodiscard]] std::string note_of(const MachineChoice& choice, const MachineDescription& machine);

} // namespace splinefeed::host
