// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/cyclic_stream.hpp"

#include "splinefeed/base/units.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace splinefeed::hal::modbus {

CyclicStream::CyclicStream(const DriveProfile& profile, const CyclicSettings& settings)
    : settings_(settings), frames_(profile) {
    if (settings_.interval_us == 0 || settings_.interval_us > settings_.period_us) {
        settings_.interval_us = settings_.period_us;
    }
}

// Peak acceleration of 3 u^2 - 2 u^3 over T: 6 / T^2. If the path moves meanwhile, the drive takes its speed at once,
// as it lost it: with the axis's acceleration it would fall far behind.
void CyclicStream::on_setpoint_timeout(const TrajectoryBuffer& track, const MotionInstant& instant) noexcept {
    if (fading_us_ > 0.0 && instant.motion_us == instant.next_us) {
        return; // the path stands: it is no further away than when the return began
    }
    const std::int64_t place_q16 = begun_ ? std::midpoint(this->place_q16(ways_[0], instant.arrival_us),
                                                          this->place_q16(ways_[1], instant.arrival_us))
                                          : target_q16_;
    offset_q16_ = static_cast<double>(place_q16 - track.at(settings_.axis, instant.motion_us).position_q16);
    fading_us_ = us_per_s * std::sqrt(6.0 * std::fabs(offset_q16_) / (settings_.acceleration * (1 << physical_bits)));
    fades_from_us_ = instant.arrival_us;
}

double CyclicStream::offset_q16(double elapsed_us) const noexcept {
    if (elapsed_us >= fading_us_) {
        return 0.0;
    }
    const double u = elapsed_us / fading_us_;
    return offset_q16_ * (1.0 - u * u * (3.0 - 2.0 * u));
}

void CyclicStream::begin(std::int64_t position_q16) noexcept {
    target_q16_ = position_q16;
    ways_.fill({position_q16, position_q16, 0});
    begun_ = true;
}

void CyclicStream::on_arrival(std::uint64_t earliest_us, std::uint64_t latest_us) noexcept {
    ways_[0] = {place_q16(ways_[0], earliest_us), target_q16_, earliest_us};
    if (latest_us != UINT64_MAX) {
        ways_[1] = {place_q16(ways_[1], latest_us), target_q16_, latest_us};
    }
}

// The drive moves straight from where a target reaches it, for its period, and then stands at the target.
std::int64_t CyclicStream::place_q16(const Way& way, std::uint64_t now_us) const noexcept {
    const double passed_us = now_us > way.since_us ? static_cast<double>(now_us - way.since_us) : 0.0;
    const double share = std::min(1.0, passed_us / settings_.period_us);
    return way.from_q16 + std::llround(static_cast<double>(way.to_q16 - way.from_q16) * share);
}

std::int64_t CyclicStream::within_reach(std::int64_t target_q16, std::uint64_t now_us) noexcept {
    if (!begun_ || settings_.fastest <= 0.0) {
        return target_q16;
    }
    constexpr double rounding_counts = 2.0; // of targets and of the instants of their arrival
    const double most_counts = catch_up * settings_.fastest * settings_.period_us / us_per_s + rounding_counts;
    const std::int64_t most_q16 = std::llround(most_counts * (1 << physical_bits));
    const auto [low, high] = std::minmax({place_q16(ways_[0], now_us), place_q16(ways_[1], now_us)});
    const std::int64_t middle = std::midpoint(low, high);
    const std::int64_t reach = std::max<std::int64_t>(0, most_q16 - (high - low) / 2);
    const std::int64_t nearest = std::clamp(target_q16, middle - reach, middle + reach);
    limited_ = nearest != target_q16;
    return nearest;
}

std::span<const RegisterWrite> CyclicStream::frame(const TrajectoryBuffer& track,
                                                   const MotionInstant& instant) noexcept {
    std::int64_t here = track.at(settings_.axis, instant.motion_us).position_q16;
    std::int64_t then = track.at(settings_.axis, instant.next_us).position_q16;
    if (fading_us_ > 0.0) {
        const auto passed_us = static_cast<double>(instant.arrival_us - fades_from_us_);
        here += std::llround(offset_q16(passed_us));
        then += std::llround(offset_q16(passed_us + settings_.interval_us));
        fading_us_ = passed_us + settings_.interval_us < fading_us_ ? fading_us_ : 0.0;
    }
    target_q16_ = within_reach(here + (then - here) * settings_.period_us / settings_.interval_us, instant.arrival_us);
    clamped_ = frames_.set(FieldRole::target_position, target_q16_).clamped || clamped_;
    return frames_.build();
}

} // namespace splinefeed::hal::modbus
