// SPDX-License-Identifier: MIT
// ClockEstimate: maps host time to a drive's clock, estimated from exchanges that carry the drive's clock.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace splinefeed::hal::modbus {

/// Instants of an exchange, host clock. [us]
struct ExchangeInstants {
    std::uint64_t sent_us = 0;     ///< before the request was sent
    std::uint64_t arrived_us = 0;  ///< earliest instant at which the drive had the whole request, by the line's rate
    std::uint64_t replied_us = 0;  ///< latest instant at which it began to answer, by the line's rate
    std::uint64_t answered_us = 0; ///< when the answer was complete
};

/// Each exchange bounds the instant at which the drive read its clock: after the request was received and before the
/// answer began. The estimate keeps the tightest bounds of every half second and fits a line through the last sixteen.
/// Does not allocate. A sample takes constant time, a conversion about thirty multiplications.
class ClockEstimate {
public:
    /// A line that was quicker than its rate once (a USB adapter, a pseudo-terminal) has no rate: from then on only the
    /// times of sending and answering are bounds. @pre the answer is to this request
    void sample(const ExchangeInstants& exchange, std::uint32_t clock_us) noexcept;
    /// The earliest instant at which the drive had the request. [us]
    [[nodiscard]] std::uint64_t earliest_us(const ExchangeInstants& exchange) const noexcept {
        return has_no_rate_ ? exchange.sent_us : exchange.arrived_us;
    }
    /// @param earliest_us, latest_us  host clock: bounds of the instant at which the drive's clock was clock_us
    void sample(std::uint64_t earliest_us, std::uint64_t latest_us, std::uint32_t clock_us) noexcept;
    /// Discards all samples, for example after a power cycle of the drive.
    void clear() noexcept { *this = ClockEstimate(); }

    [[nodiscard]] bool known() const noexcept { return count_ > 0; }
    /// The drive's clock at a host time, modulo 2^32. [us] @pre known()
    [[nodiscard]] std::uint32_t drive_clock(std::uint64_t host_us) const noexcept {
        return static_cast<std::uint32_t>(static_cast<std::uint64_t>(drive_us(host_us)));
    }
    /// The same without the modulo, from a fixed arbitrary origin. [us] @pre known()
    [[nodiscard]] std::int64_t drive_us(std::uint64_t host_us) const noexcept;
    /// Frequency error of the drive's clock against the host's. [ppm] 0 until the samples span three seconds.
    [[nodiscard]] double skew_ppm() const noexcept;
    /// Half the width of the tightest bounds: the estimate is within this. [us] @pre known()
    [[nodiscard]] double uncertainty_us() const noexcept;

private:
    static constexpr std::size_t kept = 16;

    struct Sample {
        std::uint64_t host_us = 0;
        std::int64_t offset_us = 0; // drive's clock minus host clock
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
    bool has_no_rate_ = false;
};

} // namespace splinefeed::hal::modbus
