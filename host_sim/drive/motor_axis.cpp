// SPDX-License-Identifier: MIT
//
// With x = e - f / w^2 and wd = w sqrt(1 - z^2):
//     x(t)  = exp(-z w t) (x0 cos wd t + (x0' + z w x0) / wd sin wd t)
//     x'(t) = exp(-z w t) (x0' cos wd t - (w^2 x0 + z w x0') / wd sin wd t)
#include "host_sim/drive/motor_axis.hpp"

#include <cmath>
#include <numbers>

namespace splinefeed::host {

namespace {
constexpr double nothing_counts = 1e-12; // an error below is none, so that a standing shaft costs nothing
}

MotorAxis::MotorAxis(const MotorAxisParameters& parameters) noexcept
    : frequency_(2.0 * std::numbers::pi * parameters.bandwidth_hz), decay_(parameters.damping * frequency_),
      ringing_(frequency_ * std::sqrt(1.0 - parameters.damping * parameters.damping)),
      not_fed_(1.0 - parameters.feed_forward) {}

void MotorAxis::preset_position(double position_counts) noexcept {
    reference_ = position_counts;
    error_ = 0.0;
    error_rate_ = 0.0;
}

void MotorAxis::refer(double reference_counts) noexcept {
    error_ += reference_counts - reference_;
    reference_ = reference_counts;
}

void MotorAxis::let_go() noexcept {
    preset_position(position_counts());
}

void MotorAxis::prepare(double duration_s) noexcept {
    const double fading = std::exp(-decay_ * duration_s);
    duration_ = duration_s;
    cosine_ = fading * std::cos(ringing_ * duration_s);
    sine_ = fading * std::sin(ringing_ * duration_s) / ringing_;
}

void MotorAxis::step(double duration_s, double reference_counts, double acceleration_counts_s2) noexcept {
    reference_ = reference_counts;
    const double force = not_fed_ * acceleration_counts_s2 + disturbance_;
    if (error_ == 0.0 && error_rate_ == 0.0 && force == 0.0) {
        return;
    }
    if (duration_s != duration_) {
        prepare(duration_s);
    }
    const double rest = force / (frequency_ * frequency_);
    const double x = error_ - rest;
    const double rate = error_rate_;
    error_ = rest + x * cosine_ + (rate + decay_ * x) * sine_;
    error_rate_ = rate * cosine_ - (frequency_ * frequency_ * x + decay_ * rate) * sine_;
    if (force == 0.0 && std::fabs(error_) < nothing_counts && std::fabs(error_rate_) < nothing_counts * frequency_) {
        error_ = 0.0;
        error_rate_ = 0.0;
    }
}

} // namespace splinefeed::host
