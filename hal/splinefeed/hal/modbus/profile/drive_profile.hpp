// SPDX-License-Identifier: MIT
// DriveProfile: description of a Modbus drive as data: link, registers, commands, motion. Filled once, before the
// motion. docs/reference/profiles.md explains every member.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace splinefeed::hal::modbus {

/// How a drive receives its motion.
enum class StreamWay : std::uint8_t {
    pvt,    ///< it buffers segments and interpolates them: docs/reference/pvt_map.md
    cyclic, ///< one target position per period, which it reaches a period later
    blocks, ///< positioning blocks that replace each other on the fly
    speed,  ///< none: a frequency inverter (VFD), which turns a spindle at a speed. Its counts/s are Hz of its output
};

/// Meaning of a field for the port. Only groups, commands and the init list write fields without a role.
enum class FieldRole : std::uint8_t {
    none,
    control,
    status,
    mode,
    mode_display,
    target_position,
    target_velocity,
    profile_velocity,
    profile_acceleration,
    profile_deceleration,
    actual_position,
    actual_velocity,
    following_error,
    following_error_window,
    fault_code,
    watchdog,
};
inline constexpr std::size_t field_roles = 16;

/// The four address spaces of a Modbus device.
enum class RegisterTable : std::uint8_t {
    holding,  ///< registers that are read and written
    input,    ///< registers that are read
    coils,    ///< single bits that are read and written
    discrete, ///< single bits that are read: discrete inputs
};
[[nodiscard]] constexpr bool is_bit(RegisterTable table) noexcept {
    return table == RegisterTable::coils || table == RegisterTable::discrete;
}
/// An address among those of all tables.
[[nodiscard]] constexpr int place_in(RegisterTable table, int address) noexcept {
    constexpr int addresses = 65536;
    return static_cast<int>(table) * addresses + address;
}

enum class Significance : std::uint8_t { high_first, low_first };
enum class FieldAccess : std::uint8_t { read_write, read, write };
/// Unit of a physical value.
enum class PhysicalUnit : std::uint8_t { number, counts, counts_per_s, counts_per_s2, ms };

/// A number in one to four registers, or a bit, which is a register of 0 or 1 here. The raw value in the registers is
/// raw = physical * scale_numerator / scale_denominator, or with `inverse` scale_numerator / (scale_denominator *
/// physical), for example for ramps in ms per 1000 rpm.
struct RegisterField {
    std::string name;
    FieldRole role = FieldRole::none;
    RegisterTable table = RegisterTable::holding; ///< another one with StreamWay::speed alone
    std::uint16_t address = 0;                    ///< address in the frame, from 0
    std::uint8_t width_bits = 16;                 ///< 16, 32 or 64; 1 of a bit
    bool is_signed = false;
    Significance word_order = Significance::high_first;
    Significance byte_order = Significance::high_first; ///< within a register
    std::int64_t scale_numerator = 1;                   ///< not 0
    std::int64_t scale_denominator = 1;                 ///< positive
    bool inverse = false;
    PhysicalUnit unit = PhysicalUnit::number;
    std::int64_t lowest = 0; ///< raw
    std::int64_t highest = 0xFFFF;
    FieldAccess access = FieldAccess::read_write;
    bool flash = false;     ///< every write wears the memory: never in a periodic frame
    std::int64_t value = 0; ///< raw: default value to write

    [[nodiscard]] constexpr std::size_t registers() const noexcept { return (width_bits + 15U) / 16U; }
    [[nodiscard]] constexpr int place() const noexcept { return place_in(table, address); }
    [[nodiscard]] constexpr bool readable() const noexcept { return access != FieldAccess::write; }
    [[nodiscard]] constexpr bool writable() const noexcept { return access != FieldAccess::read; }
};

/// An index into DriveProfile::fields.
using FieldIndex = std::size_t;
inline constexpr FieldIndex no_field = std::numeric_limits<FieldIndex>::max();

enum class GroupUse : std::uint8_t {
    target, ///< written in one frame for each setpoint
    status, ///< read in one frame, periodically
};

/// Adjacent fields that are transferred in one frame.
struct FieldGroup {
    GroupUse use = GroupUse::target;
    std::vector<FieldIndex> fields; ///< in order of their addresses
    std::uint16_t address = 0;
    std::size_t registers = 0;
};

/// A condition: (raw & mask) == value.
struct FieldTest {
    FieldIndex field = no_field;
    std::uint32_t mask = 0;
    std::uint32_t value = 0;
};

enum class DriveState : std::uint8_t {
    unknown, ///< no test matches
    not_ready,
    disabled,
    enabled,
    moving,
    homing,
    halted,
    quick_stop,
    fault,
};
inline constexpr std::size_t drive_states = 9;

struct StateTest {
    DriveState state = DriveState::unknown;
    FieldTest test;
};

enum class StepKind : std::uint8_t {
    level,  ///< the bits of the mask become the value and keep it
    edge,   ///< the bits of the mask become 0, then the value, in two frames, and keep it
    pulse,  ///< the bits become the value, and 0 again after the duration
    toggle, ///< the bits of the mask are inverted
};

struct CommandStep {
    FieldIndex field = no_field;
    std::uint32_t mask = 0xFFFFFFFF;
    std::uint32_t value = 0;
    StepKind kind = StepKind::level;
    std::uint32_t duration_ms = 0; ///< pulse: its duration; else: wait before the next step
};

enum class DriveCommand : std::uint8_t {
    enable,
    disable,
    fault_reset,
    start_move,
    halt,
    resume,
    quick_stop,
    home,
    forward, ///< these three with StreamWay::speed
    reverse,
    stop,
};
inline constexpr std::size_t drive_commands = 11;

struct LinkSettings {
    bool rtu = true;
    bool tcp = false;
    int unit = 1;
    int baud = 19200;
    char parity = 'E';
    int stop_bits = 1;                   ///< factory setting
    std::uint32_t silence_before_us = 0; ///< in addition to the 3.5 characters of RTU
    std::uint32_t silence_after_us = 0;
    std::uint32_t turnaround_us = 0; ///< time from the request to the drive's answer
    std::uint32_t response_timeout_us = 100'000;
    int retries = 2; ///< repetitions of an unanswered exchange; after 1 + retries consecutive time-outs a tcp
                     ///< connection is replaced
    std::uint32_t functions = 1U << 3U | 1U << 6U | 1U << 16U; ///< those that the drive has: a bit each, by its code
    [[nodiscard]] constexpr bool has(int function) const noexcept {
        return (functions >> static_cast<unsigned>(function) & 1U) != 0;
    }
    int most_read_registers = 125;
    int most_write_registers = 123;
    int address_base = 0;                  ///< of the addresses in the file; addresses in this structure count from 0
    bool reads_zero_until_written = false; ///< registers read as 0 before the first write of the target group
    /// Duration of an exchange at a baud rate, by the maker or a measurement.
    struct Exchange {
        int baud = 0;
        std::uint32_t duration_us = 0;
    };
    std::vector<Exchange> exchanges;
};

enum class WatchdogReaction : std::uint8_t { none, stop, quick_stop, disable, fault };

struct DriveProfile {
    std::string name;
    std::string drive;                     ///< makes and models
    std::vector<std::string> sources;      ///< sources of registers and values
    std::vector<std::string> not_verified; ///< what was not tested on hardware
    StreamWay stream = StreamWay::pvt;
    int axes = 1; ///< largest number in one drive

    LinkSettings link;
    std::vector<RegisterField> fields;
    std::vector<FieldGroup> groups;

    bool cia402 = false;           ///< states from the CiA 402 status word; else from `states`
    std::vector<StateTest> states; ///< tested in this order
    std::array<std::vector<CommandStep>, drive_commands> commands;

    std::optional<std::int64_t> stream_mode; ///< raw value of the mode field for streaming
    std::optional<std::int64_t> homing_mode;
    bool change_on_the_fly = false; ///< a new block replaces the active one
    std::uint32_t period_us =
        0; ///< shortest period of cyclic targets or blocks that the drive accepts; 0: limited by the link
    std::optional<FieldTest> done; ///< the last move is complete; with StreamWay::speed: the speed is reached
    std::optional<FieldTest> homed;
    /// Written before the drive is enabled; empty: the drive keeps its setting. With pvt 0 disables the check.
    std::optional<std::int64_t> following_error_window_counts;

    std::uint32_t watchdog_timeout_ms = 0; ///< written to the watchdog field; 0: the drive keeps its setting
    WatchdogReaction watchdog_reaction = WatchdogReaction::none;

    struct InitialValue {
        FieldIndex field = no_field;
        std::int64_t value = 0; ///< raw
    };
    std::vector<InitialValue> init; ///< written once, in order; a flash field only if its value differs

    struct SetupCheck {
        FieldTest test;
        std::string sentence; ///< message if it refuses the drive
    };
    std::vector<SetupCheck> identity; ///< must hold, before anything is written
    std::vector<SetupCheck> stays_on; ///< must not hold: the motor has power then, whatever `disable` writes

    /// Index of the field of a role, or no_field. Cost: linear.
    [[nodiscard]] FieldIndex index_of(FieldRole role) const noexcept {
        for (FieldIndex i = 0; role != FieldRole::none && i < fields.size(); ++i) {
            if (fields[i].role == role) {
                return i;
            }
        }
        return no_field;
    }
    /// Whether `homed` is a state that the drive keeps. The bit 12 of CiA 402 is no such: its meaning is that of the
    /// mode.
    [[nodiscard]] bool keeps_homed() const noexcept {
        constexpr std::uint32_t of_mode = 0x1000;
        return homed && !(cia402 && homed->mask == of_mode);
    }
    /// The same field, or nullptr.
    [[nodiscard]] const RegisterField* field_of(FieldRole role) const noexcept {
        const FieldIndex index = index_of(role);
        return index == no_field ? nullptr : &fields[index];
    }
    [[nodiscard]] FieldIndex index_of(std::string_view field_name) const noexcept {
        for (FieldIndex i = 0; i < fields.size(); ++i) {
            if (fields[i].name == field_name) {
                return i;
            }
        }
        return no_field;
    }
    [[nodiscard]] const FieldGroup* group_for(GroupUse use) const noexcept {
        for (const FieldGroup& group : groups) {
            if (group.use == use) {
                return &group;
            }
        }
        return nullptr;
    }
    [[nodiscard]] const std::vector<CommandStep>& steps_of(DriveCommand command) const noexcept {
        return commands[static_cast<std::size_t>(command)];
    }
};

/// State by a CiA 402 status word. `moving` also needs the test `done`.
[[nodiscard]] constexpr DriveState cia402_state(std::uint32_t status_word) noexcept {
    constexpr std::uint32_t fault_mask = 0x4F;
    constexpr std::uint32_t operation_mask = 0x6F;
    if ((status_word & fault_mask) == 0x08 || (status_word & fault_mask) == 0x0F) {
        return DriveState::fault;
    }
    switch (status_word & operation_mask) {
    case 0x27: return DriveState::enabled;
    case 0x07: return DriveState::quick_stop;
    case 0x21: // ready to switch on
    case 0x23: return DriveState::disabled;
    default: break;
    }
    return (status_word & fault_mask) == 0x40   ? DriveState::disabled
           : (status_word & fault_mask) == 0x00 ? DriveState::not_ready
                                                : DriveState::unknown;
}

[[nodiscard]] constexpr bool holds(const FieldTest& test, std::int64_t raw) noexcept {
    return (static_cast<std::uint64_t>(raw) & test.mask) == test.value;
}

} // namespace splinefeed::hal::modbus
