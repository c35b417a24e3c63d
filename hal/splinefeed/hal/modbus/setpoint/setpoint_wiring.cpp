// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/setpoint/setpoint_wiring.hpp"

#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/modbus/profile/field_codec.hpp"

#include <algorithm>
#include <cmath>

namespace splinefeed::hal::modbus {

std::uint32_t horizon_us(const SetpointWiring& wiring, std::uint32_t period_us) noexcept {
    const DriveProfile& profile = *wiring.profile;
    return profile.stream == StreamWay::cyclic ? std::max(period_us, profile.period_us) : period_us;
}

double rounding_counts(const SetpointWiring& wiring, std::uint32_t period_us) noexcept {
    const auto unit = [&](FieldRole role) {
        const RegisterField* const field = wiring.profile->field_of(role);
        return field == nullptr ? 0.0 : std::fabs(static_cast<double>(physical_of(*field, 1))) / (1 << physical_bits);
    };
    const double speeds =
        wiring.profile->stream == StreamWay::blocks ? unit(FieldRole::profile_velocity) * period_us / us_per_s : 0.0;
    const double overlap = static_cast<double>(horizon_us(wiring, period_us)) / period_us;
    return 0.5 * (unit(FieldRole::target_position) * overlap + speeds);
}

double late_counts(const SetpointWiring& wiring, std::uint32_t period_us, std::uint64_t late_us, double speed_counts_s,
                   std::uint32_t stop_us) noexcept {
    const double late_s = static_cast<double>(late_us) / us_per_s;
    const double period_s = us_to_s(period_us);
    // The drive keeps its speed and ramp meanwhile.
    double late = wiring.acceleration_counts_s2 * late_s * (period_s + late_s);
    if (wiring.profile->stream == StreamWay::cyclic) { // beyond its own period the drive stands
        late += speed_counts_s * std::max(0.0, late_s - (us_to_s(horizon_us(wiring, period_us)) - period_s));
    }
    // All drives then stop: the path advances by this much at most.
    return std::min(late, speed_counts_s * (2.0 * period_s + us_to_s(stop_us)));
}

} // namespace splinefeed::hal::modbus
