// SPDX-License-Identifier: MIT
// ClockDriftCompensation: corrects segment durations for the drift of a drive's clock, so that drives stay synchronous
// in runs of any length.
#pragma once

#include "splinefeed/base/units.hpp"
#include <cstdint>

namespace splinefeed::hal::modbus {

/// Each segment should end at its planned host time. Errors within `tolerated_us` are not corrected, because noise of
/// the clock estimate must not disturb the motion. One tick changes the speed by one part in the duration's ticks (125
/// ppm at 1 ms; 12.5 mm/s^2 for one segment at 100 mm/s). Larger errors are corrected by at most one part in 4000 per
/// segment, until the drive is synchronous again.
class ClockDriftCompensation {
public:
    static constexpr double tolerated_us = 15.0;

    /// Sets the planned end of the last segment pushed so far, on the host clock. [us]
    void anchor(double end_us) noexcept {
        end_us_ = end_us;
        ahead_us_ = 0.0;
        anchored_ = true;
        correcting_ = false;
    }
    [[nodiscard]] bool anchored() const noexcept { return anchored_; }
    /// Planned end of the next segment, whose duration is `ticks` (1/8 us). [us on the host clock]
    [[nodiscard]] double next_end_us(std::uint32_t ticks) const noexcept {
        return end_us_ + static_cast<double>(ticks) / ticks_per_us;
    }

    /// Returns the corrected duration of the next segment, in ticks.
    /// @param gain_us  gain of the drive's clock on the host clock from the anchor to next_end_us(ticks)
    [[nodiscard]] std::uint32_t trimmed(std::uint32_t ticks, double gain_us) noexcept {
        constexpr double share = 1.0 / 4000.0; // of a segment
        constexpr double settled_us = 3.0;
        end_us_ += static_cast<double>(ticks) / ticks_per_us;
        const double behind_us = gain_us - ahead_us_;
        const double size_us = behind_us < 0.0 ? -behind_us : behind_us;
        correcting_ = size_us > (correcting_ ? settled_us : tolerated_us);
        const double most = share * ticks > 1.0 ? share * ticks : 1.0;
        const double wanted = correcting_ ? ticks_per_us * behind_us : 0.0;
        const double change = wanted > most ? most : wanted < -most ? -most : wanted;
        const auto whole = static_cast<std::int32_t>(change < 0.0 ? change - 0.5 : change + 0.5);
        ahead_us_ += static_cast<double>(whole) / ticks_per_us;
        return static_cast<std::uint32_t>(static_cast<std::int64_t>(ticks) + whole);
    }

private:
    double end_us_ = 0.0;
    double ahead_us_ = 0.0; // sum of the corrections so far
    bool anchored_ = false;
    bool correcting_ = false;
};

} // namespace splinefeed::hal::modbus
