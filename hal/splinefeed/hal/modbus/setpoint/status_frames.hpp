// SPDX-License-Identifier: MIT
// StatusFrames: what must be read of a drive again and again, as its profile has it, and what it says.
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
    bool done =
        false; ///< the last move has arrived; true where the profile has no test for it and the drive is enabled
    bool homed = false;                              ///< false where the profile has no test for it
    std::int64_t position_q16 = 0;                   ///< [1/65536 count]
    std::optional<std::int64_t> following_error_q16; ///< where the drive tells it
    std::int64_t fault_code = 0;                     ///< the maker's; 0 where the drive tells none
};

/// Use: for each of reads(): read it, take(i, registers); then reading(). It allocates when it is made, and never
/// again.
class StatusFrames {
public:
    static constexpr std::size_t most_reads = 5;

    /// The profile must outlive it.
    explicit StatusFrames(const DriveProfile& profile);

    /// The status group in one frame, and a frame for each field with a role that is not in it: status, actual
    /// position, following error, fault code.
    [[nodiscard]] std::span<const RegisterRead> reads() const noexcept { return std::span(reads_).first(count_); }
    /// @pre i < reads().size(), registers.size() == reads()[i].count
    void take(std::size_t i, std::span<const std::uint16_t> registers) noexcept;
    [[nodiscard]] DriveReading reading() const noexcept;

private:
    void append(FieldIndex index) noexcept;
    [[nodiscard]] bool holds_now(const std::optional<FieldTest>& test, bool otherwise) const noexcept;
    [[nodiscard]] DriveState state() const noexcept;

    const DriveProfile& profile_;
    std::vector<std::int64_t> raw_; // by field
    std::array<RegisterRead, most_reads> reads_{};
    std::size_t count_ = 0;
};

} // namespace splinefeed::hal::modbus
