// SPDX-License-Identifier: MIT
#include "host_sim/drive/pvt_drive.hpp"

#include <algorithm>
#include <array>

namespace splinefeed::host {

using hal::modbus::PvtCommand;
using hal::modbus::PvtRefusal;
using hal::modbus::PvtStatus;
using hal::modbus::PvtTable;
namespace pvt = hal::modbus::pvt;

namespace {

constexpr int other_tables = 65536; // the first place behind the holding registers

// Numbers of 32 and 48 bits, by their first register, with the words the other way round.
void swap_number(std::span<std::uint16_t> values, std::size_t at, std::size_t words) noexcept {
    if (at + words <= values.size()) {
        std::swap(values[at], values[at + words - 1]);
    }
}

void swap_table(const PvtTable& table, std::span<std::uint16_t> values) noexcept {
    switch (table.address) {
    case pvt::identity_address:
        for (const std::size_t at : {4U, 6U, 9U}) {
            swap_number(values, at, 2);
        }
        break;
    case pvt::configuration_address: swap_number(values, 2, 2); break;
    default:
        for (const std::size_t at : {4U, 6U, 12U, 14U}) {
            swap_number(values, at, 2);
        }
        for (std::size_t at = 16; at < values.size(); at += 2) {
            swap_number(values, at, 2);
        }
    }
}

void swap_block(std::span<std::uint16_t> block, int axes) noexcept {
    for (const std::size_t at : {4U, 7U, 9U}) {
        swap_number(block, at, 2);
    }
    for (std::size_t at = pvt::block_head_registers; at < block.size(); at += pvt::segment_registers(axes)) {
        swap_number(block, at, 2);
        for (std::size_t k = 0; k < 2 * static_cast<std::size_t>(axes); ++k) {
            swap_number(block, at + 2 + 3 * k, 3);
        }
    }
}

} // namespace

PvtStatus FaultyPvtMachine::status() {
    PvtStatus told = PvtMachine::status();
    if (faults_.stuck_place) {
        told.executed = stuck_.executed;
        told.position = stuck_.position;
    }
    told.state = faults_.state         ? static_cast<hal::modbus::PvtState>(*faults_.state)
                 : faults_.stuck_state ? stuck_.state
                                       : told.state;
    told.free = faults_.no_room ? std::uint16_t{0} : told.free;
    for (std::int32_t& position : told.position) {
        position += noise_.next(faults_.dither_counts);
    }
    return told;
}

void FaultyPvtMachine::set_faults(const ModelFaults& faults) {
    stuck_ = status();
    faults_ = faults;
}

PvtRefusal FaultyPvtMachine::execute(PvtCommand command, std::uint32_t argument) {
    const bool stops = command == PvtCommand::hold || command == PvtCommand::quick_stop;
    return stops && faults_.refuses_stops ? PvtRefusal::state : PvtMachine::execute(command, argument);
}

PvtDrive::PvtDrive(PvtDriveParameters parameters)
    : parameters_(std::move(parameters)), machine_(parameters_.axes, parameters_.ring, parameters_.clock_start_us),
      registers_(machine_, parameters_.boot) {}

void PvtDrive::power_cycle() {
    machine_.power_cycle(parameters_.clock_start_us);
    registers_.power_cycle();
}

void PvtDrive::second_master() {
    constexpr std::uint16_t its_session = 0xFFFF;
    static_cast<void>(machine_.PvtMachine::execute(PvtCommand::quick_stop, 0));
    static_cast<void>(machine_.begin(its_session, 0)); // taken only where nothing moves
}

ModbusException PvtDrive::read(int address, std::span<std::uint16_t> out) {
    if (address >= other_tables) {
        return ModbusException::illegal_function;
    }
    const std::optional<PvtTable> table = hal::modbus::table_of(address, out.size(), axes());
    if (!swapped_ || !table) {
        return registers_.read(address, out);
    }
    std::array<std::uint16_t, pvt::status_registers(max_axes)> all{};
    const std::span<std::uint16_t> values = std::span(all).first(table->size);
    const ModbusException answer = registers_.read(table->address, values);
    swap_table(*table, values);
    std::copy_n(values.begin() + (address - table->address), out.size(), out.begin());
    return answer;
}

ModbusException PvtDrive::write(int address, std::span<const std::uint16_t> values) {
    if (address >= other_tables) {
        return ModbusException::illegal_function;
    }
    if (!swapped_) {
        return registers_.write(address, values);
    }
    if (address == pvt::block_address && values.size() <= pvt::most_block_registers) {
        hal::modbus::PvtBlockRegisters block{};
        std::ranges::copy(values, block.begin());
        swap_block(std::span(block).first(values.size()), axes());
        return registers_.write(address, std::span(block).first(values.size()));
    }
    const std::optional<PvtTable> table = hal::modbus::table_of(address, values.size(), axes());
    if (!table || table->address != pvt::configuration_address) {
        return registers_.write(address, values);
    }
    std::array<std::uint16_t, pvt::configuration_registers> all{};
    static_cast<void>(read(table->address, all));
    std::ranges::copy(values, all.begin() + (address - table->address));
    swap_table(*table, all);
    return registers_.write(table->address, all);
}

} // namespace splinefeed::host
