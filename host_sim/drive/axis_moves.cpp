// SPDX-License-Identifier: MIT
#include "host_sim/drive/axis_moves.hpp"

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

void AxisMoves::stop(const PvtReference& from, std::span<const PvtAxisParameters> axes) noexcept {
    axes_ = axes.size();
    passed_s_ = 0.0;
    for (std::size_t k = 0; k < axes_; ++k) {
        moves_[k] = AxisMove::stop({from.counts[k], from.counts_s[k]}, axes[k].stop_counts_s2);
    }
}

void AxisMoves::home(const PvtReference& from, std::span<const PvtAxisParameters> axes) noexcept {
    axes_ = axes.size();
    passed_s_ = 0.0;
    for (std::size_t k = 0; k < axes_; ++k) {
        moves_[k] = AxisMove::to(from.counts[k], 0.0, axes[k].homing_counts_s, axes[k].homing_counts_s2);
    }
}

bool AxisMoves::pass(double duration_s, PvtReference& reference) noexcept {
    passed_s_ += duration_s;
    bool arrived = true;
    for (std::size_t k = 0; k < axes_; ++k) {
        const AxisMove::State at = moves_[k].at(passed_s_);
        reference.counts[k] = at.position;
        reference.counts_s[k] = at.velocity;
        arrived = arrived && passed_s_ >= moves_[k].duration_s();
    }
    return arrived;
}

} // namespace splinefeed::host
