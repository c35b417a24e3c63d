// SPDX-License-Identifier: MIT
// AxisMoves: moves of all axes of a drive, each by itself and off the path: a quick stop, or homing.
#pragma once

#include "host_sim/drive/axis_move.hpp"
#include "host_sim/drive/pvt_axis.hpp"

#include <span>

namespace splinefeed::host {

class AxisMoves {
public:
    /// Stops each axis as hard as it can. @pre axes.size() <= max_axes
    void stop(const PvtReference& from, std::span<const PvtAxisParameters> axes) noexcept;
    /// Moves each axis to 0, from standstill. @pre axes.size() <= max_axes
    void home(const PvtReference& from, std::span<const PvtAxisParameters> axes) noexcept;
    /// Lets time pass; returns whether all axes have arrived. Axes that do not move stay as they are.
    [[nodiscard]] bool pass(double duration_s, PvtReference& reference) noexcept;

private:
    PerAxis<AxisMove> moves_{};
    std::size_t axes_ = 0;
    double passed_s_ = 0.0;
};

} // namespace splinefeed::host
