// SPDX-License-Identifier: MIT
#include "drive/pvt_registers.hpp"

namespace firmware {

namespace modbus = splinefeed::hal::modbus;
namespace pvt = splinefeed::hal::modbus::pvt;

namespace {

constexpr std::size_t status_size = pvt::status_registers(drive_axes);

/// Whether these registers lie in a table.
constexpr bool inside(int table, std::size_t size, unsigned address, std::size_t count) noexcept {
    const auto begin = static_cast<unsigned>(table);
    return address >= begin && address - begin + count <= size;
}

/// A host that has just been started does not know the session.
bool needs_no_session(const modbus::PvtBlock& block) noexcept {
    switch (block.command) {
    case PvtCommand::begin: return true;
    case PvtCommand::enable:
    case PvtCommand::disable:
    case PvtCommand::quick_stop:
    case PvtCommand::fault_reset: return block.count == 0;
    default: return false;
    }
}

} // namespace

void PvtRegisters::encode_status(std::span<std::uint16_t> out) const noexcept {
    const SegmentQueue& queue = drive_.queue();
    modbus::PvtStatus status;
    status.nonce = nonce_;
    status.state = drive_.state();
    status.fault = static_cast<std::uint16_t>(drive_.fault());
    status.fault_axis = static_cast<std::uint16_t>(drive_.fault_axis());
    status.next = queue.next();
    status.executed = queue.executed();
    status.free = queue.free();
    status.refused = refused_;
    status.refusals = refusals_;
    status.last_command = last_command_;
    status.clock_us = drive_.clock_us();
    status.boot = boot_;
    for (unsigned k = 0; k < drive_axes; ++k) {
        status.position[k] = drive_.position_counts(k);
    }
    encode(status, static_cast<int>(drive_axes), out);
}

ModbusException PvtRegisters::read(unsigned address, std::span<std::uint16_t> out) noexcept {
    std::array<std::uint16_t, status_size> table{};
    int begin = 0;
    if (inside(pvt::identity_address, pvt::identity_registers, address, out.size())) {
        begin = pvt::identity_address;
        modbus::PvtIdentity identity;
        identity.magic = pvt::magic;
        identity.version = pvt::version;
        identity.axes = drive_axes;
        identity.ring = drive_.queue().capacity();
        identity.ticks_per_s = splinefeed::ticks_per_s;
        identity.boot = boot_;
        identity.check_16 = pvt::word_check_16;
        identity.check_32 = pvt::word_check_32;
        encode(identity, std::span(table).first<pvt::identity_registers>());
    } else if (inside(pvt::configuration_address, pvt::configuration_registers, address, out.size())) {
        begin = pvt::configuration_address;
        encode(drive_.configuration(), std::span(table).first<pvt::configuration_registers>());
    } else if (inside(pvt::status_address, status_size, address, out.size())) {
        begin = pvt::status_address;
        encode_status(table);
    } else {
        return ModbusException::illegal_address;
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = table[address - static_cast<unsigned>(begin) + i];
    }
    return ModbusException::none;
}

ModbusException PvtRegisters::write(unsigned address, std::span<const std::uint16_t> values) noexcept {
    if (inside(pvt::configuration_address, pvt::configuration_registers, address, values.size())) {
        return write_configuration(address - static_cast<unsigned>(pvt::configuration_address), values);
    }
    return address == static_cast<unsigned>(pvt::block_address) ? write_block(values)
                                                                : ModbusException::illegal_address;
}

ModbusException PvtRegisters::write_configuration(std::size_t at, std::span<const std::uint16_t> values) noexcept {
    constexpr std::uint16_t longest_reserve_ms = 10000;
    std::array<std::uint16_t, pvt::configuration_registers> table{};
    encode(drive_.configuration(), table);
    for (std::size_t i = 0; i < values.size(); ++i) {
        table[at + i] = values[i];
    }
    const PvtConfiguration wanted = modbus::decode_configuration(table);
    if (wanted.stop_reserve_ms < 1 || wanted.stop_reserve_ms > longest_reserve_ms) {
        return ModbusException::illegal_value;
    }
    drive_.configure(wanted);
    return ModbusException::none;
}

ModbusException PvtRegisters::write_block(std::span<const std::uint16_t> registers) noexcept {
    const std::optional<Block> block = modbus::decode_block(registers, static_cast<int>(drive_axes), segments_);
    if (!block) {
        return ModbusException::illegal_value;
    }
    nonce_ = block->nonce;
    refused_ = modbus::checksum_holds(registers)
                   ? take(*block, std::span<const PvtSegment>(segments_).first(block->count))
                   : PvtRefusal::checksum;
    refusals_ = static_cast<std::uint16_t>(refusals_ + (refused_ == PvtRefusal::none ? 0U : 1U));
    return ModbusException::none;
}

PvtRefusal PvtRegisters::take(const Block& block, std::span<const PvtSegment> segments) noexcept {
    const bool ours = drive_.session() == block.session;
    if (!ours && !needs_no_session(block)) {
        return PvtRefusal::session;
    }
    drive_.feed_watchdog();
    const auto ahead = static_cast<std::int16_t>(block.command_counter - last_command_);
    const bool fresh = ours ? ahead > 0 : ahead != 0;
    if (block.command != PvtCommand::none && fresh) {
        if (const PvtRefusal refusal = command(block, segments); refusal != PvtRefusal::none) {
            return refusal;
        }
        last_command_ = block.command_counter;
    }
    if (block.command == PvtCommand::preset_position) {
        return PvtRefusal::none; // its segment is a place
    }
    if (drive_.session() != block.session) { // a late `begin` begins nothing; the others end sessions or need none
        return block.command == PvtCommand::begin ? PvtRefusal::session : PvtRefusal::none;
    }
    return drive_.take(block.first, segments);
}

PvtRefusal PvtRegisters::command(const Block& block, std::span<const PvtSegment> segments) noexcept {
    switch (block.command) {
    case PvtCommand::begin: return drive_.begin(block.session, block.argument);
    case PvtCommand::preset_position: return drive_.preset_position(segments);
    default: return drive_.execute(block.command, block.argument);
    }
}

} // namespace firmware
