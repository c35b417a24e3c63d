// SPDX-License-Identifier: MIT
// AxisMove: one axis on its own, with constant accelerations: a stop, or a move from rest to rest.
#pragma once

#include <array>

namespace splinefeed::host {

class AxisMove {
public:
    struct State {
        double position = 0.0;
        double velocity = 0.0;
    };

    AxisMove() = default;
    /// Down to rest. @pre acceleration > 0
    [[nodiscard]] static AxisMove stop(State from, double acceleration) noexcept;
    /// A trapezoid or triangle of the velocity. @pre velocity > 0, acceleration > 0
    [[nodiscard]] static AxisMove to(double from, double target, double velocity, double acceleration) noexcept;

    /// After that time; behind the end exactly there, at rest.
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

} // namespace splinefeed::host
