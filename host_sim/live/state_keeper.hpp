// SPDX-License-Identifier: MIT
// StateKeeper: keeps the state file of a machine true while a run moves it.
#pragma once

#include "host_sim/config/state_file.hpp"
#include "host_sim/ports/run_target.hpp"

#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace splinefeed::host {

/// From the first motion on, the file says that no place is known; a run that is killed leaves that behind. Only the
/// end of the run, which knows where the axes stand, writes places again. For any thread. Each function but the
/// constructor may wait for the disk and throws OutputError.
class StateKeeper {
public:
    /// @param begins  offsets and places as the run begins
    StateKeeper(std::string file, std::vector<std::string> axes, MachineState begins);

    /// Something is about to move. If this throws, it must not: nobody could be told where it then stands.
    void moves();
    /// The program has come to other offsets.
    void offsets(const WorkOffsets& offsets);
    /// The axes stand at these places. [mm]
    void stands(const PerAxis<double>& mm);
    /// The run has ended, and the target says where its axes stand. Without places nothing has moved: the file becomes
    /// what it was.
    void ends(std::span<const RunTarget::AxisPlace> places);

private:
    void write();

    std::mutex mutex_; // protects the members below
    std::string file_;
    std::vector<std::string> axes_;
    MachineState kept_;
    bool moves_ = false;
    std::optional<std::string> before_; // text of the file before it was written; nothing: there was none
};

} // namespace splinefeed::host
