// SPDX-License-Identifier: MIT
// MachineState: where a machine stands and its work offsets, from one run to the next.
#pragma once

#include "splinefeed/number/position.hpp"
#include "splinefeed/s0_program/work_offsets.hpp"

#include <optional>
#include <string>
#include <vector>

namespace splinefeed::host {

struct MachineState {
    WorkOffsets offsets{};
    /// In machine coordinates. Nothing: where this axis stands is not known.
    PerAxis<std::optional<double>> position_mm{};
    std::string unknown_why{}; ///< why a place is not known; empty: all are

    friend bool operator==(const MachineState&, const MachineState&) = default;
};

/// Nothing: there is no such file. Throws InputError where it is another machine's, or no state file, and where it
/// could not be kept: its folder is none.
/// @param axes  the machine's
[[nodiscard]] std::optional<MachineState> read_state_file(const std::string& path,
                                                          const std::vector<std::string>& axes);
/// A crash at any instant leaves the old file or the new one. Throws OutputError.
void write_state_file(const std::string& path, const std::vector<std::string>& axes, const MachineState& state);

} // namespace splinefeed::host
