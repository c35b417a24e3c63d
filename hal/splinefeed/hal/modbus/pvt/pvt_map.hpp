// SPDX-License-Identifier: MIT
// PvtMap: addresses, constants and codecs of the register map splinefeed-pvt. docs/reference/pvt_map.md defines the map
// and the behaviour of drives.
#pragma once

#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/modbus/link/registers.hpp"
#include "splinefeed/s4_segment_stream/feed_segment.hpp"

#include <array>
#include <optional>

namespace splinefeed::hal::modbus {

namespace pvt {

inline constexpr std::uint16_t magic = 0x5346;
inline constexpr std::uint16_t version = 1;
inline constexpr std::uint16_t word_check_16 = 0x1234;
inline constexpr std::uint32_t word_check_32 = 0x12345678;

inline constexpr int identity_address = 0x0000;
inline constexpr int configuration_address = 0x0010;
inline constexpr int status_address = 0x0020;
inline constexpr int block_address = 0x0100;

inline constexpr std::size_t identity_registers = 11;
inline constexpr std::size_t configuration_registers = 4;
inline constexpr std::size_t block_head_registers = 11;
inline constexpr std::size_t most_block_registers = 121; ///< limit of function 23
inline constexpr std::uint16_t shortest_ring = 16;       // segments
inline constexpr std::uint32_t shortest_ticks = 800;
inline constexpr std::uint32_t longest_ticks = 80'000'000;
inline constexpr std::uint32_t rest_mark = 0x8000'0000; ///< bit in the duration of a segment: PvtSegment::rest

[[nodiscard]] constexpr std::size_t status_registers(int axes) noexcept {
    return 18 + 4 * static_cast<std::size_t>(axes);
}
[[nodiscard]] constexpr std::size_t segment_registers(int axes) noexcept {
    return 2 + 6 * static_cast<std::size_t>(axes);
}
/// Largest number of segments in one exchange.
[[nodiscard]] constexpr std::size_t most_segments(int axes) noexcept {
    return (most_block_registers - block_head_registers) / segment_registers(axes);
}

/// The earlier of two sequence numbers, which wrap. @pre they are less than 2^31 apart
[[nodiscard]] constexpr std::uint32_t earlier(std::uint32_t a, std::uint32_t b) noexcept {
    return static_cast<std::int32_t>(b - a) < 0 ? b : a;
}

} // namespace pvt

enum class PvtState : std::uint16_t { disabled, standing, running, stopping, held, fault, homing };
enum class PvtFault : std::uint16_t { none, underflow, watchdog, limit, following_error, emergency_stop, bus };
enum class PvtRefusal : std::uint16_t { none, checksum, session, gap, no_room, malformed, state };
enum class PvtCommand : std::uint16_t {
    none,
    enable,
    disable,
    begin,
    start,
    hold,
    resume,
    quick_stop,
    end,
    fault_reset,
    home,
    preset_position
};

struct PvtIdentity {
    std::uint16_t magic = 0;
    std::uint16_t version = 0;
    std::uint16_t axes = 0;
    std::uint16_t ring = 0;
    std::uint32_t ticks_per_s = 0;
    std::uint32_t boot = 0;
    std::uint16_t check_16 = 0;
    std::uint32_t check_32 = 0;
};

struct PvtConfiguration {
    std::uint16_t watchdog_ms = 0;
    std::uint16_t stop_reserve_ms = 100;
    std::uint32_t following_window = 0; ///< [counts]
};

/// Text of PvtStatus::fault by the map; all faults of makers have one text.
[[nodiscard]] const char* fault_name(std::uint16_t fault) noexcept;

/// A segment in the drive's units. It starts at the end of the previous one.
struct PvtSegment {
    static constexpr int position_bits = 16; ///< positions in 1/2^16 count
    static constexpr int velocity_bits = 24; ///< velocities in 1/2^24 count per duration

    std::uint32_t duration_ticks = 0;
    bool rest = false; ///< the whole machine is at rest at its end, including axes of other drives
    PerAxis<std::int64_t> end{};
    PerAxis<std::int64_t> end_velocity{};
};

/// Assigns a drive's axis to a machine axis; -1: none.
struct PvtAxis {
    PvtAxis(int axis = -1, bool turned = false, // NOLINT(google-explicit-constructor): a number is an axis
            std::int64_t window = 2) noexcept
        : machine_axis(axis), inverted(turned), window_counts(window) {}

    int machine_axis;
    bool inverted;              ///< it counts in the opposite direction of the machine's axis
    std::int64_t window_counts; ///< how far the position of a shaft that stands may dither

    friend bool operator==(const PvtAxis&, const PvtAxis&) = default;
};

/// Range of a segment: positions below 2^31 counts, velocities below 2^23 counts per segment.
inline constexpr double pvt_velocity_range = 8388608.0;

/// Converts a feed segment for the axes of a drive; axes without a machine axis keep their positions in `out`. Rounds
/// to nearest, so both neighbours of a joint round it alike. Returns false, without changing `out`, if a position, a
/// velocity or the duration does not fit the registers.
[[nodiscard]] bool to_pvt(const FeedSegment& segment, std::span<const PvtAxis> axes, PvtSegment& out) noexcept;
/// Converts a position of a feed segment to 1/2^16 count; empty: out of range.
[[nodiscard]] std::optional<std::int64_t> pvt_position(std::int64_t units) noexcept;

struct PvtStatus {
    std::uint16_t nonce = 0;
    PvtState state = PvtState::disabled;
    std::uint16_t fault = 0; ///< PvtFault, or the maker's from 0x100
    std::uint16_t fault_axis = 0;
    std::uint32_t next = 0;
    std::uint32_t executed = 0;
    std::uint16_t free = 0;
    PvtRefusal refused = PvtRefusal::none;
    std::uint16_t refusals = 0;
    std::uint16_t last_command = 0; ///< counter of the last command
    std::uint32_t clock_us = 0;
    std::uint32_t boot = 0;
    PerAxis<std::int32_t> position{};        ///< [counts]
    PerAxis<std::int32_t> following_error{}; ///< [1/65536 count]
};

/// Head of the exchange block.
struct PvtBlock {
    std::uint16_t nonce = 0;
    std::uint16_t session = 0;
    PvtCommand command = PvtCommand::none;
    std::uint16_t command_counter = 0;
    std::uint32_t argument = 0;
    std::uint16_t count = 0;
    std::uint32_t first = 0;
};

using PvtBlockRegisters = std::array<std::uint16_t, pvt::most_block_registers>;
using PvtSegments = std::array<PvtSegment, pvt::most_segments(1)>;

/// Encodes a whole block with its checksum. Returns its number of registers.
/// @pre block.count <= pvt::most_segments(axes) and segments.size() >= block.count
std::size_t encode(const PvtBlock& block, std::span<const PvtSegment> segments, int axes,
                   PvtBlockRegisters& out) noexcept;
/// Decodes a block; empty if its length and count are inconsistent. Does not check the checksum: checksum_holds().
[[nodiscard]] std::optional<PvtBlock> decode_block(std::span<const std::uint16_t> registers, int axes,
                                                   PvtSegments& segments) noexcept;
[[nodiscard]] bool checksum_holds(std::span<const std::uint16_t> block) noexcept;

void encode(const PvtIdentity& identity, std::span<std::uint16_t, pvt::identity_registers> out) noexcept;
[[nodiscard]] PvtIdentity decode_identity(std::span<const std::uint16_t, pvt::identity_registers> in) noexcept;
void encode(const PvtConfiguration& configuration, std::span<std::uint16_t, pvt::configuration_registers> out) noexcept;
[[nodiscard]] PvtConfiguration
decode_configuration(std::span<const std::uint16_t, pvt::configuration_registers> in) noexcept;
/// @pre out.size() >= pvt::status_registers(axes)
void encode(const PvtStatus& status, int axes, std::span<std::uint16_t> out) noexcept;
[[nodiscard]] PvtStatus decode_status(std::span<const std::uint16_t> in, int axes) noexcept;
/// Checks the checksum of a status. @pre status is complete
[[nodiscard]] bool status_holds(std::span<const std::uint16_t> status) noexcept;

/// CRC-32 (reflected 0x04C11DB7) of registers as bytes, high byte first. Pass an earlier result in `before` to
/// continue.
[[nodiscard]] std::uint32_t crc32(std::span<const std::uint16_t> registers, std::uint32_t before = 0) noexcept;

} // namespace splinefeed::hal::modbus
