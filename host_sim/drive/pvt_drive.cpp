// SPDX-License-Identifier: MIT
#include "host_sim/drive/pvt_drive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace splinefeed::host {

using hal::modbus::PvtBlock;
using hal::modbus::PvtCommand;
using hal::modbus::PvtConfiguration;
using hal::modbus::PvtIdentity;
using hal::modbus::PvtRefusal;
using hal::modbus::PvtSegment;
using hal::modbus::PvtSegments;
using hal::modbus::PvtStatus;
namespace pvt = hal::modbus::pvt;

namespace {

constexpr double errors_per_count = 65536.0;

std::int32_t in_register(double value) noexcept {
    constexpr double most = std::numeric_limits<std::int32_t>::max();
    return static_cast<std::int32_t>(std::clamp(std::nearbyint(value), -most, most));
}

/// A table of the map: whether registers lie in it, and where.
bool inside(int table, std::size_t size, int address, std::size_t count) noexcept {
    return address >= table && static_cast<std::size_t>(address - table) + count <= size;
}

// Numbers of 32 and 48 bits, by their first register, with the words the other way round.
void swap_number(std::span<std::uint16_t> values, std::size_t at, std::size_t words) noexcept {
    if (at + words <= values.size()) {
        std::swap(values[at], values[at + words - 1]);
    }
}

void swap_status(std::span<std::uint16_t> status) noexcept {
    for (const std::size_t at : {4U, 6U, 12U, 14U}) {
        swap_number(status, at, 2);
    }
    for (std::size_t at = 16; at < status.size(); at += 2) {
        swap_number(status, at, 2);
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

// A host that has just been started does not know the session.
bool needs_no_session(const PvtBlock& block) noexcept {
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

PvtDrive::PvtDrive(PvtDriveParameters parameters)
    : parameters_(std::move(parameters)), machine_(parameters_.axes, parameters_.ring, parameters_.clock_start_us),
      boot_(parameters_.boot) {}

void PvtDrive::power_cycle() {
    machine_.power_cycle(parameters_.clock_start_us);
    ++boot_;
    nonce_ = 0;
    last_command_ = 0;
    refusals_ = 0;
    refused_ = PvtRefusal::none;
}

PvtIdentity PvtDrive::identity() const {
    return {.magic = pvt::magic,
            .version = pvt::version,
            .axes = static_cast<std::uint16_t>(axes()),
            .ring = machine_.ring().capacity(),
            .ticks_per_s = ticks_per_s,
            .boot = boot_,
            .check_16 = pvt::word_check_16,
            .check_32 = pvt::word_check_32};
}

PvtStatus PvtDrive::status() const {
    PvtStatus status{.nonce = nonce_,
                     .state = machine_.state(),
                     .fault = static_cast<std::uint16_t>(machine_.fault()),
                     .fault_axis = static_cast<std::uint16_t>(machine_.fault_axis()),
                     .next = machine_.ring().next(),
                     .executed = machine_.ring().executed(),
                     .free = machine_.ring().free(),
                     .refused = refused_,
                     .refusals = refusals_,
                     .last_command = last_command_,
                     .clock_us = machine_.clock_us(),
                     .boot = boot_,
                     .position = {},
                     .following_error = {}};
    for (int k = 0; k < axes(); ++k) {
        const auto axis = static_cast<unsigned>(k);
        status.position[axis] = in_register(machine_.shaft(k).position_counts());
        status.following_error[axis] = in_register(machine_.shaft(k).following_error_counts() * errors_per_count);
    }
    return status;
}

PvtStatus PvtDrive::told_status() {
    PvtStatus told = status();
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

void PvtDrive::set_faults(const ModelFaults& faults) {
    stuck_ = told_status();
    faults_ = faults;
}

void PvtDrive::second_master() {
    constexpr std::uint16_t its_session = 0xFFFF;
    static_cast<void>(machine_.execute(PvtCommand::quick_stop, 0));
    static_cast<void>(machine_.begin(its_session, 0)); // taken only where nothing moves
}

ModbusException PvtDrive::read(int address, std::span<std::uint16_t> out) {
    std::array<std::uint16_t, pvt::status_registers(max_axes)> table{};
    std::size_t at = 0;
    const std::size_t status_size = pvt::status_registers(axes());
    if (inside(pvt::identity_address, pvt::identity_registers, address, out.size())) {
        hal::modbus::encode(identity(), std::span(table).first<pvt::identity_registers>());
        if (swapped_) {
            swap_number(table, 4, 2);
            swap_number(table, 6, 2);
            swap_number(table, 9, 2);
        }
        at = static_cast<std::size_t>(address - pvt::identity_address);
    } else if (inside(pvt::configuration_address, pvt::configuration_registers, address, out.size())) {
        hal::modbus::encode(machine_.configuration(), std::span(table).first<pvt::configuration_registers>());
        if (swapped_) {
            swap_number(table, 2, 2);
        }
        at = static_cast<std::size_t>(address - pvt::configuration_address);
    } else if (inside(pvt::status_address, status_size, address, out.size())) {
        hal::modbus::encode(told_status(), axes(), table);
        if (swapped_) {
            swap_status(std::span(table).first(status_size));
        }
        at = static_cast<std::size_t>(address - pvt::status_address);
    } else {
        return ModbusException::illegal_address;
    }
    const std::span<const std::uint16_t> asked = std::span(table).subspan(at, out.size());
    std::copy(asked.begin(), asked.end(), out.begin());
    return ModbusException::none;
}

ModbusException PvtDrive::write(int address, std::span<const std::uint16_t> values) {
    if (inside(pvt::configuration_address, pvt::configuration_registers, address, values.size())) {
        return write_configuration(static_cast<std::size_t>(address - pvt::configuration_address), values);
    }
    if (address != pvt::block_address) {
        return ModbusException::illegal_address;
    }
    if (values.size() > pvt::most_block_registers) {
        return ModbusException::illegal_value;
    }
    if (!swapped_) {
        return write_block(values);
    }
    hal::modbus::PvtBlockRegisters block{};
    std::copy(values.begin(), values.end(), block.begin());
    swap_block(std::span(block).first(values.size()), axes());
    return write_block(std::span(block).first(values.size()));
}

ModbusException PvtDrive::write_configuration(std::size_t at, std::span<const std::uint16_t> values) {
    constexpr std::uint16_t longest_reserve_ms = 10000;
    std::array<std::uint16_t, pvt::configuration_registers> table{};
    hal::modbus::encode(machine_.configuration(), table);
    if (swapped_) {
        swap_number(table, 2, 2);
    }
    std::copy(values.begin(), values.end(), table.begin() + static_cast<std::ptrdiff_t>(at));
    if (swapped_) {
        swap_number(table, 2, 2);
    }
    const PvtConfiguration wanted = hal::modbus::decode_configuration(table);
    if (wanted.stop_reserve_ms < 1 || wanted.stop_reserve_ms > longest_reserve_ms) {
        return ModbusException::illegal_value;
    }
    machine_.configure(wanted);
    return ModbusException::none;
}

ModbusException PvtDrive::write_block(std::span<const std::uint16_t> registers) {
    PvtSegments segments{};
    const std::optional<PvtBlock> block = hal::modbus::decode_block(registers, axes(), segments);
    if (!block) {
        return ModbusException::illegal_value;
    }
    nonce_ = block->nonce;
    refused_ = hal::modbus::checksum_holds(registers) ? take(*block, std::span(segments).first(block->count))
                                                      : PvtRefusal::checksum;
    refusals_ = static_cast<std::uint16_t>(refusals_ + (refused_ == PvtRefusal::none ? 0U : 1U));
    return ModbusException::none;
}

PvtRefusal PvtDrive::take(const PvtBlock& block, std::span<const PvtSegment> segments) {
    const bool ours = machine_.session() == block.session;
    if (!ours && !needs_no_session(block)) {
        return PvtRefusal::session;
    }
    machine_.feed_watchdog();
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
    if (machine_.session() != block.session) { // a late `begin` begins nothing; the others end sessions or need none
        return block.command == PvtCommand::begin ? PvtRefusal::session : PvtRefusal::none;
    }
    return machine_.take(block.first, segments);
}

PvtRefusal PvtDrive::command(const PvtBlock& block, std::span<const PvtSegment> segments) {
    const bool stops = block.command == PvtCommand::hold || block.command == PvtCommand::quick_stop;
    if (stops && faults_.refuses_stops) {
        return PvtRefusal::state;
    }
    switch (block.command) {
    case PvtCommand::begin: return machine_.begin(block.session, block.argument);
    case PvtCommand::preset_position: return machine_.preset_position(segments);
    default: return machine_.execute(block.command, block.argument);
    }
}

} // namespace splinefeed::host
