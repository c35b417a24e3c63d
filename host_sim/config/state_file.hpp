// SPDX-License-Identifier: MIT
// MachineState: where a machine stands and its work offsets, from one run to the next. StateFile: the one user of such
// a file.
#pragma once

#include "host_sim/base/resource_claim.hpp"

#include "splinefeed/number/position.hpp"
#include "splinefeed/s0_program/words/work_offsets.hpp"

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

/// Whose state it is.
struct StateOwner {
    std::vector<std::string> axes{};
    std::string machine{}; ///< its name
    std::string target{};  ///< what moves: the kind of the target
};

/// Nothing: there is no such file. Throws InputError where it is no state file or that of a machine with other axes,
/// and where it could not be kept: its folder is none.
[[nodiscard]] std::optional<MachineState> read_state_file(const std::string& path,
                                                          const std::vector<std::string>& axes);
/// A crash at any instant leaves the old file or the new one. Throws OutputError.
void write_state_file(const std::string& path, const StateOwner& owner, const MachineState& state);

/// While an object exists, no other process keeps a state in that file. Make it before the file is read.
class StateFile {
public:
    /// Throws InputError where another process has the file, or where it is the state of another machine, or of the
    /// same one that something else moves: places of a simulation are nowhere in the world.
    StateFile(std::string path, StateOwner owner);

    void write(const MachineState& state) const { write_state_file(path_, owner_, state); }
    [[nodiscard]] const std::string& path() const noexcept { return path_; }

private:
    std::string path_;
    StateOwner owner_;
    ResourceClaim claim_;
};

} // namespace splinefeed::host
