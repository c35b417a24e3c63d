// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/cyclic_stream.hpp"

#include <algorithm>
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

void CyclicStream::begin(std::int64_t position_q16) noexcept {
    from_q16_ = acknowledged_q16_ = target_q16_ = position_q16;
    arrival_us_ = 0;
    away_ = false;
    fading_us_ = 0.0;
}

// The drive moves straight from where a target reaches it, and stands at the target.
std::int64_t CyclicStream::where_q16(std::uint64_t now_us) const noexcept {
    const double passed = now_us > arrival_us_ ? static_cast<double>(now_us - arrival_us_) : 0.0;
    const double share = std::min(1.0, passed / settings_.period_us);
    return from_q16_ + std::llround(static_cast<double>(acknowledged_q16_ - from_q16_) * share);
}

// Its speed above the path's is its distance from it by its period.
bool CyclicStream::reaches(std::int64_t path_q16, std::uint64_t now_us) const noexcept {
    constexpr double spare = 0.25; // of the fastest speed, for late targets
    constexpr double rounding_counts = 2.0;
    const double most_counts = spare * settings_.fastest * settings_.period_us / us_per_s + rounding_counts;
    return settings_.fastest <= 0.0 ||
           std::fabs(static_cast<double>(path_q16 - where_q16(now_us))) <= most_counts * (1 << physical_bits);
}

// Of 3 u^2 - 2 u^3 over T the peak acceleration is 6 / T^2, and the peak speed 1.5 / T.
void CyclicStream::begin_return(std::int64_t path_q16) noexcept {
    offset_q16_ = static_cast<double>(target_q16_ - path_q16);
    const double counts = std::fabs(offset_q16_) / (1 << physical_bits);
    fading_us_ =
        us_per_s * std::max({std::sqrt(6.0 * counts / settings_.acceleration), 1.5 * counts / settings_.fastest, 1e-6});
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
    const std::int64_t here = track.at(settings_.axis, instant.motion_us).position_q16;
    const std::int64_t then = track.at(settings_.axis, instant.next_us).position_q16;
    away_ = away_ || !reaches(here, instant.arrival_us);
    if (!away_) {
        target_q16_ = here + (then - here) * settings_.period_us / settings_.interval_us;
    } else {
        if (fading_us_ == 0.0 && (instant.next_us == instant.motion_us || instant.motion_us >= track.end_us())) {
            begin_return(here);
        }
        // Until then the same target again: it may have arrived although nobody has said so.
        target_q16_ =
            fading_us_ > 0.0 ? here + std::llround(offset_q16(elapsed_us_ + settings_.interval_us)) : target_q16_;
    }
    clamped_ = frames_.set(FieldRole::target_position, target_q16_).clamped || clamped_;
    return frames_.build();
}

void CyclicStream::on_arrival(std::uint64_t arrival_us) noexcept {
    if (arrival_us == UINT64_MAX) {
        return;
    }
    from_q16_ = where_q16(arrival_us);
    acknowledged_q16_ = target_q16_;
    arrival_us_ = arrival_us;
    if (fading_us_ > 0.0) {
        elapsed_us_ += settings_.interval_us;
        away_ = elapsed_us_ < fading_us_;
        fading_us_ = away_ ? fading_us_ : 0.0;
    }
}

} // namespace splinefeed::hal::modbus
