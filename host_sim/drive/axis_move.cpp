// SPDX-License-Identifier: MIT
#include "host_sim/drive/axis_move.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

AxisMove AxisMove::stop(State from, double acceleration) noexcept {
    AxisMove move;
    move.from_ = from;
    move.legs_[0] = {std::fabs(from.velocity) / acceleration, -std::copysign(acceleration, from.velocity)};
    move.end_ = from.position + 0.5 * from.velocity * move.legs_[0].duration;
    return move;
}

AxisMove AxisMove::to(double from, double target, double velocity, double acceleration) noexcept {
    AxisMove move;
    move.from_ = {from, 0.0};
    move.end_ = target;
    const double way = std::fabs(target - from);
    const double top = std::min(velocity, std::sqrt(way * acceleration));
    const double signed_acceleration = std::copysign(acceleration, target - from);
    const double ramp = top / acceleration;
    const double level = top > 0.0 ? std::max(way / top - ramp, 0.0) : 0.0;
    move.legs_ = {Leg{ramp, signed_acceleration}, Leg{level, 0.0}, Leg{ramp, -signed_acceleration}};
    return move;
}

AxisMove::State AxisMove::at(double time_s) const noexcept {
    State state = from_;
    for (const Leg& leg : legs_) {
        const double t = std::min(time_s, leg.duration);
        state.position += (state.velocity + 0.5 * leg.acceleration * t) * t;
        state.velocity += leg.acceleration * t;
        if (time_s < leg.duration) {
            return state;
        }
        time_s -= leg.duration;
    }
    return {end_, 0.0};
}

double AxisMove::duration_s() const noexcept {
    return legs_[0].duration + legs_[1].duration + legs_[2].duration;
}

} // namespace splinefeed::host
