// SPDX-License-Identifier: MIT
// ExactStopTime: how long a program takes if the machine stops at the end of every move: an estimate in closed form.
#pragma once

#include "host_sim/config/machine_description.hpp"

#include "splinefeed/s1_blended_path/path_element.hpp"

namespace splinefeed::host {

/// Time of a move of this length from standstill to standstill.
/// @param jerk  0: no limit
[[nodiscard]] double rest_to_rest_s(double length, double speed, double acceleration, double jerk) noexcept;

/// Lines are exact, but for the pieces of the machine's time. On arcs and Bezier segments every direction gets the
/// limits of the slowest axis, the acceleration over the root of two, and the speed also what that allows at the
/// smallest radius; so for them the sum is too long, rather than too short.
class ExactStopTime {
public:
    explicit ExactStopTime(const MachineSettings& settings) : settings_(&settings) {}

    void start(const PerAxis<Position>& position) noexcept { here_ = position; }
    void move(const PathElement<double>& move) noexcept;
    [[nodiscard]] double seconds() const noexcept { return seconds_; }

private:
    [[nodiscard]] double straight_s(const PathElement<double>& move) const noexcept;
    [[nodiscard]] double bent_s(const PathElement<double>& move) const noexcept;
    /// @param feed  where the move states none, and the most
    [[nodiscard]] static double feed_of(const PathElement<double>& move, double feed) noexcept;

    const MachineSettings* settings_;
    PerAxis<Position> here_{};
    double seconds_ = 0.0;
};

} // namespace splinefeed::host
