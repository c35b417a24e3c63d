// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt/pvt_map.hpp"

namespace splinefeed::hal::modbus {

namespace {

constexpr std::size_t checksum_at = 9;

constexpr std::array<std::uint32_t, 256> crc_table = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
        std::uint32_t rest = i;
        for (int bit = 0; bit < 8; ++bit) {
            rest = (rest & 1U) != 0 ? 0xEDB88320U ^ (rest >> 1U) : rest >> 1U;
        }
        table[i] = rest;
    }
    return table;
}();

std::uint32_t checksum(std::span<const std::uint16_t> block) noexcept {
    return crc32(block.subspan(pvt::block_head_registers), crc32(block.first(checksum_at)));
}

// The numbers of each table in their order: `io` writes or reads them.

template <class Io, class Identity>
void pass_identity(Io io, Identity& identity) noexcept {
    io.pass(identity.magic, identity.version, identity.axes, identity.ring, identity.ticks_per_s, identity.boot,
            identity.check_16, identity.check_32);
}

template <class Io, class Configuration>
void pass_configuration(Io io, Configuration& configuration) noexcept {
    io.pass(configuration.watchdog_ms, configuration.stop_reserve_ms, configuration.following_window);
}

/// All but its checksum.
template <class Io, class Status>
void pass_status(Io& io, Status& status, int axes) noexcept {
    io.pass(status.nonce, status.state, status.fault, status.fault_axis, status.next, status.executed, status.free,
            status.refused, status.refusals, status.last_command, status.clock_us, status.boot);
    for (const unsigned k : indices(axes)) {
        io.pass(status.position[k], status.following_error[k]);
    }
}

template <class Io, class Block>
void pass_head(Io& io, Block& block) noexcept {
    io.pass(block.nonce, block.session, block.command, block.command_counter, block.argument, block.count, block.first);
}

template <class Io, class Segment>
void pass_ends(Io& io, Segment& segment, int axes) noexcept {
    for (const unsigned k : indices(axes)) {
        io.pass(segment.end[k], segment.end_velocity[k]);
    }
}

constexpr std::int64_t largest_48 = (std::int64_t{1} << 47U) - 1;

// Quotient rounded to nearest, ties upwards; empty if it does not fit a signed 48-bit number.
std::optional<std::int64_t> divided(std::int64_t value, std::int64_t divisor) noexcept {
    if (value > largest_48 * divisor || value < -largest_48 * divisor) {
        return std::nullopt;
    }
    const std::int64_t shifted = value + divisor / 2;
    const std::int64_t quotient = shifted / divisor;
    return shifted % divisor < 0 ? quotient - 1 : quotient;
}

} // namespace

const char* fault_name(std::uint16_t fault) noexcept {
    constexpr std::array<const char*, 7> names{"no fault",
                                               "its segments ran out while it moved",
                                               "its watchdog expired: it received nothing for too long",
                                               "a limit of velocity, acceleration or travel",
                                               "the following error left its window",
                                               "emergency stop",
                                               "its bus"};
    return fault < names.size() ? names[fault] : "a fault of its maker's; see the drive's manual";
}

std::uint32_t crc32(std::span<const std::uint16_t> registers, std::uint32_t before) noexcept {
    std::uint32_t rest = ~before;
    for (const std::uint16_t value : registers) {
        rest = crc_table[(rest ^ (std::uint32_t{value} >> 8U)) & 0xFFU] ^ (rest >> 8U);
        rest = crc_table[(rest ^ value) & 0xFFU] ^ (rest >> 8U);
    }
    return ~rest;
}

std::optional<std::int64_t> pvt_position(std::int64_t units) noexcept {
    return divided(units, units_per_count >> PvtSegment::position_bits);
}

bool to_pvt(const FeedSegment& segment, std::span<const PvtAxis> axes, PvtSegment& out) noexcept {
    static_assert(units_per_count % (std::int64_t{1} << PvtSegment::velocity_bits) == 0);
    PvtSegment made = out;
    made.duration_ticks = segment.duration_ticks;
    made.rest = segment.ends_at_rest();
    bool fits = segment.duration_ticks >= pvt::shortest_ticks && segment.duration_ticks <= pvt::longest_ticks;
    for (std::size_t k = 0; k < axes.size() && fits; ++k) {
        if (axes[k].machine_axis >= 0) {
            const auto axis = static_cast<std::size_t>(axes[k].machine_axis);
            const auto end = pvt_position(segment.end[axis]);
            const auto velocity = divided(segment.end_velocity[axis], units_per_count >> PvtSegment::velocity_bits);
            fits = end && velocity;
            made.end[k] = axes[k].inverted ? -end.value_or(0) : end.value_or(0);
            made.end_velocity[k] = axes[k].inverted ? -velocity.value_or(0) : velocity.value_or(0);
        }
    }
    out = fits ? made : out;
    return fits;
}

std::size_t encode(const PvtBlock& block, std::span<const PvtSegment> segments, int axes,
                   PvtBlockRegisters& out) noexcept {
    RegisterWriter writer(out);
    pass_head(writer, block);
    writer.put32(0);
    for (const PvtSegment& segment : segments.first(block.count)) {
        writer.put32(segment.duration_ticks | (segment.rest ? pvt::rest_mark : 0));
        pass_ends(writer, segment, axes);
    }
    const std::size_t size = writer.size();
    RegisterWriter(std::span(out).subspan(checksum_at, 2)).put32(checksum(std::span(out).first(size)));
    return size;
}

std::optional<PvtBlock> decode_block(std::span<const std::uint16_t> registers, int axes,
                                     PvtSegments& segments) noexcept {
    if (registers.size() < pvt::block_head_registers) {
        return std::nullopt;
    }
    RegisterReader reader(registers);
    PvtBlock block;
    pass_head(reader, block);
    static_cast<void>(reader.take32());
    if (block.count > pvt::most_segments(axes) ||
        registers.size() != pvt::block_head_registers + block.count * pvt::segment_registers(axes)) {
        return std::nullopt;
    }
    for (PvtSegment& segment : std::span(segments).first(block.count)) {
        const std::uint32_t duration = reader.take32();
        segment.duration_ticks = duration & ~pvt::rest_mark;
        segment.rest = (duration & pvt::rest_mark) != 0;
        pass_ends(reader, segment, axes);
    }
    return block;
}

bool checksum_holds(std::span<const std::uint16_t> block) noexcept {
    return block.size() >= pvt::block_head_registers &&
           RegisterReader(block.subspan(checksum_at, 2)).take32() == checksum(block);
}

void encode(const PvtIdentity& identity, std::span<std::uint16_t, pvt::identity_registers> out) noexcept {
    pass_identity(RegisterWriter(out), identity);
}

PvtIdentity decode_identity(std::span<const std::uint16_t, pvt::identity_registers> in) noexcept {
    PvtIdentity identity;
    pass_identity(RegisterReader(in), identity);
    return identity;
}

void encode(const PvtConfiguration& configuration,
            std::span<std::uint16_t, pvt::configuration_registers> out) noexcept {
    pass_configuration(RegisterWriter(out), configuration);
}

PvtConfiguration decode_configuration(std::span<const std::uint16_t, pvt::configuration_registers> in) noexcept {
    PvtConfiguration configuration;
    pass_configuration(RegisterReader(in), configuration);
    return configuration;
}

void encode(const PvtStatus& status, int axes, std::span<std::uint16_t> out) noexcept {
    RegisterWriter writer(out);
    pass_status(writer, status, axes);
    writer.put32(crc32(out.first(writer.size())));
}

bool status_holds(std::span<const std::uint16_t> status) noexcept {
    const std::size_t last = status.size() - 2;
    return RegisterReader(status.subspan(last)).take32() == crc32(status.first(last));
}

PvtStatus decode_status(std::span<const std::uint16_t> in, int axes) noexcept {
    RegisterReader reader(in);
    PvtStatus status;
    pass_status(reader, status, axes);
    return status;
}

} // namespace splinefeed::hal::modbus
