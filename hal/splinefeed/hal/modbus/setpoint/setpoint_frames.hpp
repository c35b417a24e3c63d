// SPDX-License-Identifier: MIT
// SetpointFrames: the frames that set a drive going, as its profile has them: one group with its trigger, or field by
// field.
#pragma once

#include "splinefeed/hal/modbus/profile/field_codec.hpp"

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

/// Remembers what every field was told last. It allocates when it is made, and never again.
class SetpointFrames {
public:
    /// The profile must outlive it.
    explicit SetpointFrames(const DriveProfile& profile);

    /// What the field of the role will be told; nothing where the profile has no such field.
    RawValue set(FieldRole role, std::int64_t physical_q16) noexcept;
    /// What a physical value of that role becomes on its way through the register; the value itself without a field.
    [[nodiscard]] double rounded(FieldRole role, double physical) const noexcept;
    /// Whoever writes a field by other ways (enable, mode) says so: bits of commands are laid over it.
    void set_last(FieldIndex field, std::int64_t raw) noexcept { last_[field] = raw; }
    [[nodiscard]] std::int64_t last(FieldIndex field) const noexcept { return last_[field]; }
    /// The frame that writes one field; of the target group, with all of it and without a start. It counts as told.
    [[nodiscard]] RegisterWrite single(FieldIndex field, std::int64_t raw) noexcept;

    /// The frames of the move that was set, in the order in which they must go out. With a target group it is one, with
    /// the steps of start_move in it. Without: speeds and ramps where they changed, the target position behind them,
    /// and start_move last unless what it sets stands already. A pulse is two frames, without its duration. Valid until
    /// the next call.
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
    std::vector<std::int64_t> sent_; // what the drive has
    std::vector<bool> known_;        // whether it has anything from us
    std::array<FieldIndex, field_roles> by_role_{};
    std::array<RegisterWrite, most_writes> writes_{};
    std::size_t count_ = 0;
};

} // namespace splinefeed::hal::modbus
