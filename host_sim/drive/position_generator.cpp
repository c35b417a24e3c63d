// SPDX-License-Identifier: MIT
#include "host_sim/drive/position_generator.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::host {

namespace {
constexpr double same_counts = 1e-9; // rounding of positions up to 2^31 counts is 5e-7 of it per step
}

void PositionGenerator::preset_position(double position_counts) noexcept {
    course_ = Course::rest;
    position_ = position_counts;
    velocity_ = 0.0;
}

void PositionGenerator::move(double target_counts, const MoveLimits& limits) noexcept {
    course_ = Course::move;
    target_ = target_counts;
    limits_ = limits;
}

void PositionGenerator::follow(double target_counts, double duration_s) noexcept {
    course_ = Course::line;
    target_ = target_counts;
    line_left_s_ = duration_s;
    velocity_ = (target_ - position_) / duration_s;
}

void PositionGenerator::stop(double deceleration_counts_s2) noexcept {
    course_ = velocity_ == 0.0 ? Course::rest : Course::stop;
    limits_.deceleration = deceleration_counts_s2;
}

// With D ahead, the speed w towards the target and the speed p at which acceleration a turns into deceleration d:
// p^2 / (2 d) + (p^2 - w^2) / (2 a) = D.
PositionGenerator::Phase PositionGenerator::move_phase() const noexcept {
    const double ahead = target_ - position_;
    const double sense = ahead != 0.0 ? std::copysign(1.0, ahead) : -std::copysign(1.0, velocity_);
    const double distance = std::fabs(ahead);
    const double speed = sense * velocity_;
    const double a = limits_.acceleration;
    const double d = limits_.deceleration;
    const double braking = speed * speed / (2.0 * d);
    if (speed < 0.0 || braking > distance + same_counts || limits_.velocity <= 0.0) { // away from it, or past it
        return {std::fabs(speed) / d, speed < 0.0 ? sense * d : -sense * d, 0.0, false};
    }
    if (braking >= distance - same_counts) {
        return speed == 0.0 ? Phase{0.0, 0.0, 0.0, true}
                            : Phase{2.0 * distance / speed,
                                    distance == 0.0 ? 0.0 : -sense * speed * speed / (2.0 * distance), 0.0, true};
    }
    if (speed > limits_.velocity) {
        return {(speed - limits_.velocity) / d, -sense * d, sense * limits_.velocity, false};
    }
    if (speed == limits_.velocity) {
        return {(distance - braking) / speed, 0.0, velocity_, false};
    }
    const double peak = std::sqrt((distance + speed * speed / (2.0 * a)) / (0.5 / a + 0.5 / d));
    const double end = std::max(std::min(peak, limits_.velocity), speed);
    return {(end - speed) / a, sense * a, sense * end, false};
}

PositionGenerator::Phase PositionGenerator::phase() const noexcept {
    switch (course_) {
    case Course::move: return move_phase();
    case Course::line: return {line_left_s_, 0.0, 0.0, true};
    case Course::stop:
        return {std::fabs(velocity_) / limits_.deceleration, -std::copysign(limits_.deceleration, velocity_), 0.0,
                false};
    case Course::rest: break;
    }
    return {};
}

void PositionGenerator::end(const Phase& ended) noexcept {
    velocity_ = ended.end_velocity;
    if (ended.at_target) {
        position_ = target_;
    }
    const bool stands = course_ == Course::stop || (course_ == Course::move && limits_.velocity <= 0.0);
    if (ended.at_target || stands) {
        course_ = Course::rest;
    }
}

void PositionGenerator::advance(double duration_s) noexcept {
    constexpr int most_phases = 16; // turn round, overshoot, come back; the rest is rounding
    for (int i = 0; i < most_phases && duration_s > 0.0 && course_ != Course::rest; ++i) {
        const Phase now = phase();
        const double step = std::min(duration_s, now.duration_s);
        position_ += step * (velocity_ + 0.5 * step * now.acceleration);
        velocity_ += step * now.acceleration;
        line_left_s_ -= step;
        duration_s -= step;
        if (step == now.duration_s) {
            end(now);
        }
    }
}

} // namespace splinefeed::host
