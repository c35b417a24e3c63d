// SPDX-License-Identifier: MIT
// ClockDriftCompensation: durations in the ticks of a drive whose clock is not ours, so that it stays in step however
// long it runs.
#pragma once

#include <cstdint>

namespace splinefeed::hal::modbus {

/// A segment is to end when the drive's clock shows what ours would show then. Within `tolerated_us` nothing is done:
/// an estimate that moves a little must not shake the motion, and a tick more or less changes the speed by one part in
/// the duration's ticks (125 ppm at 1 ms; 12.5 mm/s^2 for one segment at 100 mm/s). Beyond, one part in 4000 at most is
/// given or taken per segment until the drive is in step again.
class ClockDriftCompensation {
public:
    static constexpr double tolerated_us = 15.0;

    /// Segments of so many of our ticks (1/8 us) are to end, the last one pushed so far, at `end_us` of our clock.
    void anchor(double end_us) noexcept {
        end_us_ = end_us;
        ahead_us_ = 0.0;
        anchored_ = true;
        correcting_ = false;
    }
    [[nodiscard]] bool anchored() const noexcept { return anchored_; }
    /// When the next segment is to end. [us of our clock]
    [[nodiscard]] double next_end_us(std::uint32_t ticks) const noexcept { return end_us_ + ticks / ticks_per_us; }

    /// The duration to tell the drive.
    /// @param gain_us  by how much the drive's clock gains on ours from the anchor to next_end_us(ticks)
    [[nodiscard]] std::uint32_t trimmed(std::uint32_t ticks, double gain_us) noexcept {
        constexpr double share = 1.0 / 4000.0; // of a segment
        constexpr double settled_us = 3.0;
        end_us_ += ticks / ticks_per_us;
        const double behind_us = gain_us - ahead_us_;
        const double size_us = behind_us < 0.0 ? -behind_us : behind_us;
        correcting_ = size_us > (correcting_ ? settled_us : tolerated_us);
        const double most = share * ticks > 1.0 ? share * ticks : 1.0;
        const double wanted = correcting_ ? ticks_per_us * behind_us : 0.0;
        const double change = wanted > most ? most : wanted < -most ? -most : wanted;
        const auto whole = static_cast<std::int32_t>(change < 0.0 ? change - 0.5 : change + 0.5);
        ahead_us_ += whole / ticks_per_us;
        return static_cast<std::uint32_t>(static_cast<std::int64_t>(ticks) + whole);
    }

private:
    static constexpr double ticks_per_us = 8.0;

    double end_us_ = 0.0;
    double ahead_us_ = 0.0; // that the durations told were longer than ours
    bool anchored_ = false;
    bool correcting_ = false;
};

} // namespace splinefeed::hal::modbus
