// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/cyclic_stream.hpp"

#include <cmath>

namespace splinefeed::hal::modbus {

namespace {

constexpr double us_per_s = 1e6;

} // namespace

CyclicStream::CyclicStream(const DriveProfile& profile, const CyclicSettings& settings)
    : settings_(settings), frames_(profile) {
    if (settings_.interval_us == 0 || settings_.interval_us > settings_.period_us) {
        settings_.interval_us = settings_.period_us;
    }
}

// Peak acceleration of 3 u^2 - 2 u^3 over T: 6 / T^2. If the path moves meanwhile, the drive takes its speed at once,
// as it lost it: with the axis's acceleration it would fall far behind.
void CyclicStream::on_setpoint_timeout(const TrajectoryBuffer& track, const MotionInstant& instant) noexcept {
    offset_q16_ = static_cast<double>(target_q16_ - track.at(settings_.axis, instant.motion_us).position_q16);
    fading_us_ = us_per_s * std::sqrt(6.0 * std::fabs(offset_q16_) / (settings_.acceleration * (1 << physical_bits)));
    elapsed_us_ = 0.0;
}

double CyclicStream::offset_q16(double elapsed_us) const noexcept {
    if (elapsed_us >= fading_us_) {
        return 0.0;
    }
    const double u = elapsed_us / fading_us_;
    return offset_q16_ * (1.0 - u * u * (3.0 - 2.0 * u));
}

std::span<const RegisterWrite> CyclicStream::frame(const TrajectoryBuffer& track,
                                                   const MotionInstant& instant) noexcept {
    std::int64_t here = track.at(settings_.axis, instant.motion_us).position_q16;
    std::int64_t then = track.at(settings_.axis, instant.next_us).position_q16;
    if (fading_us_ > 0.0) {
        here += std::llround(offset_q16(elapsed_us_));
        elapsed_us_ += settings_.interval_us;
        then += std::llround(offset_q16(elapsed_us_));
        fading_us_ = elapsed_us_ < fading_us_ ? fading_us_ : 0.0;
    }
    target_q16_ = here + (then - here) * settings_.period_us / settings_.interval_us;
    clamped_ = frames_.set(FieldRole::target_position, target_q16_).clamped || clamped_;
    return frames_.build();
}

} // namespace splinefeed::hal::modbus
