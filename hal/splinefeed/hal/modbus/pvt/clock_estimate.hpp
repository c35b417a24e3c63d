// SPDX-License-Identifier: MIT
// ClockEstimate: what a drive's clock shows at an instant of ours, from exchanges that carry its clock.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace splinefeed::hal::modbus {

/// Each exchange bounds the instant at which the drive read its clock: after the request passed the line, before the
/// answer began to. The tightest of every half second is kept, and a line is laid through the last sixteen. No
/// allocation; cost of a sample: constant, of a question thirty products.
class ClockEstimate {
public:
    /// @param earliest_us, latest_us  monotonic clock, bounds of the instant at which the drive's clock was clock_us
    void sample(std::uint64_t earliest_us, std::uint64_t latest_us, std::uint32_t clock_us) noexcept;
    /// Forgets everything: the drive was switched off.
    void clear() noexcept { *this = ClockEstimate(); }

    [[nodiscard]] bool known() const noexcept { return count_ > 0; }
    /// What the drive's clock shows then, modulo 2^32. @pre known()
    [[nodiscard]] std::uint32_t drive_clock(std::uint64_t host_us) const noexcept {
        return static_cast<std::uint32_t>(static_cast<std::uint64_t>(drive_us(host_us)));
    }
    /// The same without the modulo, from some origin that stays. @pre known()
    [[nodiscard]] std::int64_t drive_us(std::uint64_t host_us) const noexcept;
    /// How fast its clock is against ours, parts per million; 0 while there are less than three seconds of samples.
    [[nodiscard]] double skew_ppm() const noexcept;
    /// Half the width of the tightest bounds: the estimate is within this. [us] @pre known()
    [[nodiscard]] double uncertainty_us() const noexcept;

private:
    static constexpr std::size_t kept = 16;

    struct Sample {
        std::uint64_t host_us = 0;
        std::int64_t offset_us = 0; // drive's clock less ours
        std::uint64_t width_us = 0;
    };
    struct Line {
        double offset_us = 0.0; // at origin_us
        double slope = 0.0;
        std::uint64_t origin_us = 0;
    };

    [[nodiscard]] const Sample& at(std::size_t i) const noexcept { return samples_[(first_ + i) % kept]; }
    [[nodiscard]] Line line() const noexcept;
    [[nodiscard]] static Sample common(const Sample& a, const Sample& b) noexcept;

    std::array<Sample, kept> samples_{};
    std::size_t first_ = 0;
    std::size_t count_ = 0;
    std::uint64_t slot_ = 0;
    std::int64_t clock_us_ = 0;    // of the last sample, without the modulo
    std::uint64_t sampled_us_ = 0; // its earliest instant
};

} // namespace splinefeed::hal::modbus
