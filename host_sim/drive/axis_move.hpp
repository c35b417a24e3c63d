// SPDX-License-Identifier: MIT
// AxisMove: a single axis with constant accelerations: a stop, or a move from standstill to standstill.
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

} // namespace splinefeed::host
