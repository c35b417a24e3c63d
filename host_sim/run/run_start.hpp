// SPDX-License-Identifier: MIT
// RunStart: where a machine stands when its run begins, where the program begins, and what to do where these differ.
#pragma once

#include "host_sim/config/machine_description.hpp"
#include "host_sim/config/state_file.hpp"
#include "host_sim/ports/run_target.hpp"

#include <optional>
#include <string>
#include <vector>

namespace splinefeed::host {

class RunStart {
public:
    /// @param machine  must outlive the object
    /// @param standing  RunTarget::standing()
    RunStart(const MachineDescription& machine, const RunOptions& options,
             const std::vector<RunTarget::AxisPlace>& standing);

    /// Where a program in G-code begins: where the user or the state file says that the machine stands, else where the
    /// drives do. What is told of axes whose drives do not know it counts from now on.
    void settle(PerAxis<std::optional<double>>& begins) noexcept;
    /// What the user should know: axes of which nobody knows where they stand. Empty: nothing.
    [[nodiscard]] std::string note() const;
    /// Where the machine has to move from, to the begin of its program; nothing: it stands there. Throws UsageError if
    /// it stands elsewhere and shall not move.
    /// @param begin  of the program [mm]
    [[nodiscard]] std::optional<PerAxis<double>> move_from(const PerAxis<double>& begin) const;

private:
    [[nodiscard]] std::string names_of_unknown() const;

    const MachineDescription* machine_;
    StartWay way_;
    PerAxis<std::optional<double>> place_{};
};

} // namespace splinefeed::host
