// SPDX-License-Identifier: MIT
// SetpointFrames: builds the frames of a move by the drive's profile: one group with its trigger, or single fields.
#pragma once

#include "splinefeed/hal/modbus/profile/field_codec.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace splinefeed::hal::modbus {

/// Registers to be written in one frame.
struct RegisterWrite {
    static constexpr std::size_t most = 123;

    std::uint16_t address = 0;
    std::size_t count = 0;
    std::array<std::uint16_t, most> values{};

    [[nodiscard]] std::span<const std::uint16_t> registers() const noexcept { return std::span(values).first(count); }
};

/// Stores the last value of every field. Allocates in its constructor only.
class SetpointFrames {
public:
    /// The profile must outlive the frames.
    explicit SetpointFrames(const DriveProfile& profile);

    /// Sets the value of a role's field for the next build(). Returns the raw value; 0 if the profile has no such
    /// field.
    RawValue set(FieldRole role, std::int64_t physical_q16) noexcept;
    /// A physical value rounded as in the register of that role; unchanged if the profile has no such field.
    [[nodiscard]] double rounded(FieldRole role, double physical) const noexcept;
    /// The raw value that was set or written last: commands change single bits of it.
    [[nodiscard]] std::int64_t last(FieldIndex field) const noexcept { return last_[field]; }
    /// Call when frames were lost: what the drive has of their values is unknown, so the next build() has all of them.
    void forget() noexcept { std::fill(known_.begin(), known_.end(), false); }
    /// Returns the frame that writes one field. For a field of the target group it writes the whole group, without a
    /// start. The value counts as sent.
    [[nodiscard]] RegisterWrite single(FieldIndex field, std::int64_t raw) noexcept;

    /// Returns the frames of the move, in the order of sending; valid until the next call. With a target group this is
    /// one frame, which includes the steps of start_move. Otherwise: changed speeds and ramps, the target position, and
    /// start_move unless its bits are set already. A pulse is two frames, without its duration.
    [[nodiscard]] std::span<const RegisterWrite> build() noexcept;

private:
    static constexpr std::size_t most_writes = 16;

    [[nodiscard]] bool in_group(FieldIndex field) const noexcept;
    void append(FieldIndex index, std::int64_t raw) noexcept;
    void put_group(RegisterWrite& write) const noexcept;
    void append_group() noexcept;
    void append_start() noexcept;
    [[nodiscard]] bool started() const noexcept;

    const DriveProfile& profile_;
    const FieldGroup* group_;
    std::vector<std::int64_t> last_; // raw, by field
    std::vector<std::int64_t> sent_; // last value sent to the drive
    std::vector<bool> known_;        // whether a value was sent
    std::array<FieldIndex, field_roles> by_role_{};
    std::array<RegisterWrite, most_writes> writes_{};
    std::size_t count_ = 0;
};

} // namespace splinefeed::hal::modbus
