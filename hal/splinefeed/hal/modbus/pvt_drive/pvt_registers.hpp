// SPDX-License-Identifier: MIT
// PvtRegisters: the tables of the map splinefeed-pvt (docs/reference/pvt_map.md) before a drive. It answers reads of
// identity, configuration and status, and takes writes of configuration and exchange block.
#pragma once

#include "splinefeed/hal/modbus/pvt/pvt_map.hpp"
#include "splinefeed/hal/modbus/pvt_drive/modbus_exception.hpp"

namespace splinefeed::hal::modbus {

/// A table that a master reads, or writes a part of.
struct PvtTable {
    int address = 0;
    std::size_t size = 0;
};

/// The table in which these registers lie; empty: in none, or in the exchange block, which is written only.
[[nodiscard]] constexpr std::optional<PvtTable> table_of(int address, std::size_t count, int axes) noexcept {
    for (const PvtTable& table : {PvtTable{pvt::identity_address, pvt::identity_registers},
                                  PvtTable{pvt::configuration_address, pvt::configuration_registers},
                                  PvtTable{pvt::status_address, pvt::status_registers(axes)}}) {
        if (address >= table.address && static_cast<std::size_t>(address - table.address) + count <= table.size) {
            return table;
        }
    }
    return {};
}

/// `Machine` is the drive behind its registers. It has axes(), ring_capacity(), session(), configuration(),
/// configure(), feed_watchdog(), the commands begin(), preset_position() and execute(), take() for segments, and
/// status(), all but what PvtRegisters counts itself. Freestanding.
/// @tparam most_axes  that a Machine may have: the size of the tables
template <class Machine, int most_axes>
class PvtRegisters {
public:
    /// `machine` must outlive it.
    PvtRegisters(Machine& machine, std::uint32_t boot_number) noexcept : machine_(&machine), boot_(boot_number) {}

    /// All of them, or none and an exception.
    [[nodiscard]] ModbusException read(int address, std::span<std::uint16_t> out) noexcept;
    [[nodiscard]] ModbusException write(int address, std::span<const std::uint16_t> values) noexcept;
    /// Power off and on: the next boot, and nothing was said before.
    void power_cycle() noexcept { *this = PvtRegisters(*machine_, boot_ + 1); }
    /// The status of the machine, with what is counted here.
    [[nodiscard]] PvtStatus completed(PvtStatus of_machine) const noexcept;

private:
    [[nodiscard]] PvtIdentity identity() const noexcept;
    [[nodiscard]] ModbusException write_configuration(std::size_t at, std::span<const std::uint16_t> values) noexcept;
    [[nodiscard]] ModbusException write_block(std::span<const std::uint16_t> registers) noexcept;
    [[nodiscard]] PvtRefusal take(const PvtBlock& block, std::span<const PvtSegment> segments) noexcept;
    [[nodiscard]] PvtRefusal command(const PvtBlock& block, std::span<const PvtSegment> segments) noexcept;
    [[nodiscard]] static bool needs_no_session(const PvtBlock& block) noexcept;

    Machine* machine_;
    std::uint32_t boot_;
    PvtSegments segments_{}; // of the block that is decoded
    std::uint16_t nonce_ = 0;
    std::uint16_t last_command_ = 0;
    std::uint16_t refusals_ = 0;
    PvtRefusal refused_ = PvtRefusal::none;
};

template <class Machine, int most_axes>
PvtIdentity PvtRegisters<Machine, most_axes>::identity() const noexcept {
    return {.magic = pvt::magic,
            .version = pvt::version,
            .axes = static_cast<std::uint16_t>(machine_->axes()),
            .ring = machine_->ring_capacity(),
            .ticks_per_s = ticks_per_s,
            .boot = boot_,
            .check_16 = pvt::word_check_16,
            .check_32 = pvt::word_check_32};
}

template <class Machine, int most_axes>
PvtStatus PvtRegisters<Machine, most_axes>::completed(PvtStatus of_machine) const noexcept {
    of_machine.nonce = nonce_;
    of_machine.refused = refused_;
    of_machine.refusals = refusals_;
    of_machine.last_command = last_command_;
    of_machine.boot = boot_;
    return of_machine;
}

template <class Machine, int most_axes>
ModbusException PvtRegisters<Machine, most_axes>::read(int address, std::span<std::uint16_t> out) noexcept {
    const std::optional<PvtTable> asked = table_of(address, out.size(), machine_->axes());
    if (!asked) {
        return ModbusException::illegal_address;
    }
    std::array<std::uint16_t, pvt::status_registers(most_axes)> table{};
    switch (asked->address) {
    case pvt::identity_address: encode(identity(), std::span(table).template first<pvt::identity_registers>()); break;
    case pvt::configuration_address:
        encode(machine_->configuration(), std::span(table).template first<pvt::configuration_registers>());
        break;
    default: encode(completed(machine_->status()), machine_->axes(), table); break;
    }
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = table[static_cast<std::size_t>(address - asked->address) + i];
    }
    return ModbusException::none;
}

template <class Machine, int most_axes>
ModbusException PvtRegisters<Machine, most_axes>::write(int address, std::span<const std::uint16_t> values) noexcept {
    if (address == pvt::block_address) {
        return write_block(values);
    }
    const std::optional<PvtTable> table = table_of(address, values.size(), machine_->axes());
    return table && table->address == pvt::configuration_address
               ? write_configuration(static_cast<std::size_t>(address - table->address), values)
               : ModbusException::illegal_address;
}

template <class Machine, int most_axes>
ModbusException PvtRegisters<Machine, most_axes>::write_configuration(std::size_t at,
                                                                      std::span<const std::uint16_t> values) noexcept {
    constexpr std::uint16_t longest_reserve_ms = 10000;
    std::array<std::uint16_t, pvt::configuration_registers> table{};
    encode(machine_->configuration(), table);
    for (std::size_t i = 0; i < values.size(); ++i) {
        table[at + i] = values[i];
    }
    const PvtConfiguration wanted = decode_configuration(table);
    if (wanted.stop_reserve_ms < 1 || wanted.stop_reserve_ms > longest_reserve_ms) {
        return ModbusException::illegal_value;
    }
    machine_->configure(wanted);
    return ModbusException::none;
}

template <class Machine, int most_axes>
ModbusException PvtRegisters<Machine, most_axes>::write_block(std::span<const std::uint16_t> registers) noexcept {
    const std::optional<PvtBlock> block = decode_block(registers, machine_->axes(), segments_);
    if (!block) {
        return ModbusException::illegal_value;
    }
    nonce_ = block->nonce;
    refused_ = checksum_holds(registers) ? take(*block, std::span<const PvtSegment>(segments_).first(block->count))
                                         : PvtRefusal::checksum;
    refusals_ = static_cast<std::uint16_t>(refusals_ + (refused_ == PvtRefusal::none ? 0U : 1U));
    return ModbusException::none;
}

template <class Machine, int most_axes>
PvtRefusal PvtRegisters<Machine, most_axes>::take(const PvtBlock& block,
                                                  std::span<const PvtSegment> segments) noexcept {
    const bool ours = machine_->session() == block.session;
    if (!ours && !needs_no_session(block)) {
        return PvtRefusal::session;
    }
    machine_->feed_watchdog();
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
    if (machine_->session() != block.session) { // a late `begin` begins nothing; the others end sessions or need none
        return block.command == PvtCommand::begin ? PvtRefusal::session : PvtRefusal::none;
    }
    return machine_->take(block.first, segments);
}

template <class Machine, int most_axes>
PvtRefusal PvtRegisters<Machine, most_axes>::command(const PvtBlock& block,
                                                     std::span<const PvtSegment> segments) noexcept {
    switch (block.command) {
    case PvtCommand::begin: return machine_->begin(block.session, block.argument);
    case PvtCommand::preset_position: return machine_->preset_position(segments);
    default: return machine_->execute(block.command, block.argument);
    }
}

// A host that has just been started does not know the session.
template <class Machine, int most_axes>
bool PvtRegisters<Machine, most_axes>::needs_no_session(const PvtBlock& block) noexcept {
    switch (block.command) {
    case PvtCommand::begin: return true;
    case PvtCommand::enable:
    case PvtCommand::disable:
    case PvtCommand::quick_stop:
    case PvtCommand::fault_reset: return block.count == 0;
    default: return false;
    }
}

} // namespace splinefeed::hal::modbus
