// SPDX-License-Identifier: MIT
// AxisMove: a single axis with constant accelerations: a stop, or a move from standstill to standstill. AxisMoves:
// moves of all axes of a drive, each by itself and off the path: a quick stop, or homing.
#pragma once

#include "host_sim/drive/pvt_axis.hpp"

#include <array>
#include <span>

namespace splinefeed::host {

class AxisMove {
public:
    struct State {
        double position = 0.0;
        double velocity = 0.0;
    };

    AxisMove() = default;
    /// Brakes to standstill. @pre acceleration > 0
    [[nodiscard]] static AxisMove stop(State from, double acceleration) noexcept;
    /// A trapezoid or triangle of the velocity. @pre velocity > 0, acceleration > 0
    [[nodiscard]] static AxisMove to(double from, double target, double velocity, double acceleration) noexcept;

    /// The state after that time; after the end of the move exactly its end, at standstill.
    [[nodiscard]] State at(double time_s) const noexcept;
    [[nodiscard]] double duration_s() const noexcept;

private:
    struct Leg {
        double duration = 0.0;
        double acceleration = 0.0;
    };

    State from_;
    double end_ = 0.0;
    std::array<Leg, 3> legs_{};
};

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
