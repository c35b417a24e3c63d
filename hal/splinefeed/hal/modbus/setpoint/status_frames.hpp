// SPDX-License-Identifier: MIT
// StatusFrames: the periodic status reads of a drive by its profile, and the decoded status.
#pragma once

#include "splinefeed/hal/modbus/profile/field_codec.hpp"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace splinefeed::hal::modbus {

/// Registers to be read in one frame.
struct RegisterRead {
    std::uint16_t address = 0;
    std::size_t count = 0;
};

struct DriveReading {
    DriveState state = DriveState::unknown;
    bool done = false;             ///< the last move is complete; without a test in the profile: the drive is enabled
    bool homed = false;            ///< false without a test in the profile
    std::int64_t position_q16 = 0; ///< [1/65536 count]
    std::optional<std::int64_t> following_error_q16; ///< empty: the drive does not report it
    std::int64_t fault_code = 0;                     ///< code of the maker; 0 if the drive reports none
};

/// Use: read each frame of reads() and pass it to take(); then call reading(). Allocates in its constructor only.
class StatusFrames {
public:
    static constexpr std::size_t most_reads = 5;

    /// The profile must outlive the frames.
    explicit StatusFrames(const DriveProfile& profile);

    /// The frames to read: the status group, and one frame for each of these fields outside of it: status, actual
    /// position, following error, fault code.
    [[nodiscard]] std::span<const RegisterRead> reads() const noexcept { return std::span(reads_).first(count_); }
    /// Which of reads() has the actual position.
    [[nodiscard]] std::size_t position_read() const noexcept { return position_read_; }
    /// @pre i < reads().size(), registers.size() == reads()[i].count
    void take(std::size_t i, std::span<const std::uint16_t> registers) noexcept;
    [[nodiscard]] DriveReading reading() const noexcept;

private:
    std::size_t append(FieldIndex index) noexcept;
    [[nodiscard]] bool holds_now(const std::optional<FieldTest>& test, bool otherwise) const noexcept;
    [[nodiscard]] DriveState state() const noexcept;

    const DriveProfile& profile_;
    std::vector<std::int64_t> raw_; // by field
    std::array<RegisterRead, most_reads> reads_{};
    std::size_t count_ = 0;
    std::size_t position_read_ = 0;
};

} // namespace splinefeed::hal::modbus
