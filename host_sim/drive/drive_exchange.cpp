// SPDX-License-Identifier: MIT
#include "host_sim/drive/drive_exchange.hpp"

#include "host_sim/base/input_error.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <modbus/modbus.h>
#include <new>
#include <sys/socket.h>
#include <unistd.h>

namespace splinefeed::host {

using hal::modbus::is_bit;
using hal::modbus::place_in;
using hal::modbus::RegisterTable;

namespace {

constexpr int registers = 65536;

int word(const std::vector<std::uint8_t>& bytes, std::size_t at) {
    return at + 1 < bytes.size() ? bytes[at] << 8 | bytes[at + 1] : -1;
}

} // namespace

void ModbusContextDeleter::operator()(_modbus* context) const noexcept {
    modbus_free(context);
}

ModbusContext make_modbus_context(const ListenAddress& address) {
    ModbusContext context(
        address.kind == ListenAddress::Kind::tcp
            ? modbus_new_tcp(address.host.c_str(), address.port)
            : modbus_new_rtu(address.device.c_str(), address.baud, address.parity, 8, address.stops()));
    if (context == nullptr) {
        throw UsageError("--listen {}: libmodbus does not take it: {}", in_quotes(address.text()),
                         modbus_strerror(errno));
    }
    if (address.kind == ListenAddress::Kind::rtu) {
        modbus_set_slave(context.get(), address.unit);
    }
    return context;
}

DriveExchange::DriveExchange(DriveModel& model, const ListenAddress& address)
    : model_(&model), context_(make_modbus_context(address)),
      mapping_(modbus_mapping_new(registers, registers, registers, registers)),
      header_(static_cast<std::size_t>(modbus_get_header_length(context_.get()))),
      serial_(address.kind == ListenAddress::Kind::rtu) {
    std::array<int, 2> ends{-1, -1};
    if (mapping_ == nullptr || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
        modbus_mapping_free(mapping_);
        throw std::bad_alloc();
    }
    near_ = ends[0];
    far_ = ends[1];
    modbus_set_socket(context_.get(), near_);
    // libmodbus sleeps that long before it answers nonsense.
    modbus_set_response_timeout(context_.get(), 0, 1);
}

DriveExchange::~DriveExchange() {
    modbus_set_socket(context_.get(), -1);
    modbus_mapping_free(mapping_);
    close(near_);
    close(far_);
}

std::vector<std::uint8_t> DriveExchange::answer(const std::vector<std::uint8_t>& request) {
    if (const ModbusException exception = take_effect(request); exception != ModbusException::none) {
        return refuse(request, exception);
    }
    std::vector<std::uint8_t> replied = request;
    if (request[header_] == MODBUS_FC_WRITE_AND_READ_REGISTERS) {
        keep_mapping(replied);
    }
    static_cast<void>(modbus_reply(context_.get(), replied.data(), static_cast<int>(replied.size()), mapping_));
    return collect();
}

// libmodbus writes into the mapping before it reads from it. What a drive reads may be another image than what is
// written there, and is in the mapping already: so the request writes what it finds.
void DriveExchange::keep_mapping(std::vector<std::uint8_t>& request) const {
    const std::size_t head = header_ + 1;
    const int address = word(request, head + 4);
    const int count = word(request, head + 6);
    for (int i = 0; i < count; ++i) {
        const std::uint16_t value = mapping_->tab_registers[address + i];
        const std::size_t at = head + 9 + 2 * static_cast<std::size_t>(i);
        request[at] = static_cast<std::uint8_t>(value >> 8U);
        request[at + 1] = static_cast<std::uint8_t>(value & 0xFFU);
    }
}

std::vector<std::uint8_t> DriveExchange::refuse(const std::vector<std::uint8_t>& request, ModbusException exception) {
    static_cast<void>(modbus_reply_exception(context_.get(), request.data(), static_cast<unsigned>(exception)));
    return collect();
}

std::vector<std::uint8_t> DriveExchange::collect() const {
    std::vector<std::uint8_t> reply(MODBUS_MAX_ADU_LENGTH);
    const ssize_t size = recv(far_, reply.data(), reply.size(), MSG_DONTWAIT);
    reply.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    if (serial_ && !reply.empty() && reply.front() == MODBUS_BROADCAST_ADDRESS) {
        reply.clear();
    }
    return reply;
}

ModbusException DriveExchange::read(int address, int count) {
    if (count < 1 || count > MODBUS_MAX_READ_REGISTERS) {
        return ModbusException::illegal_value;
    }
    if (address + count > registers) {
        return ModbusException::illegal_address;
    }
    return model_->read(address, {mapping_->tab_registers + address, static_cast<std::size_t>(count)});
}

// Of another table than the holding registers.
ModbusException DriveExchange::read_table(RegisterTable table, int address, int count) {
    if (count < 1 || count > (is_bit(table) ? MODBUS_MAX_READ_BITS : MODBUS_MAX_READ_REGISTERS)) {
        return ModbusException::illegal_value;
    }
    if (address + count > registers) {
        return ModbusException::illegal_address;
    }
    std::vector<std::uint16_t> values(static_cast<std::size_t>(count));
    const ModbusException refused = model_->read(place_in(table, address), values);
    if (refused == ModbusException::none && is_bit(table)) {
        std::ranges::copy(values,
                          (table == RegisterTable::coils ? mapping_->tab_bits : mapping_->tab_input_bits) + address);
    } else if (refused == ModbusException::none) {
        std::ranges::copy(values, mapping_->tab_input_registers + address);
    }
    return refused;
}

ModbusException DriveExchange::write_coil(int address, int value) {
    constexpr int on = 0xFF00;
    if (value != on && value != 0) {
        return ModbusException::illegal_value;
    }
    const std::uint16_t bit = value == on ? 1 : 0;
    return model_->write(place_in(RegisterTable::coils, address), std::span(&bit, 1));
}

ModbusException DriveExchange::write(int address, const std::uint8_t* bytes, int count) {
    if (count < 1 || count > MODBUS_MAX_WRITE_REGISTERS) {
        return ModbusException::illegal_value;
    }
    std::array<std::uint16_t, MODBUS_MAX_WRITE_REGISTERS> values{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
        values[i] = static_cast<std::uint16_t>(bytes[2 * i] << 8 | bytes[2 * i + 1]);
    }
    return address + count > registers
               ? ModbusException::illegal_address
               : model_->write(address, std::span(values).first(static_cast<std::size_t>(count)));
}

ModbusException DriveExchange::take_effect(const std::vector<std::uint8_t>& request) {
    if (request.size() <= header_) {
        return ModbusException::illegal_function;
    }
    const auto at = [this](std::size_t offset) {
        return header_ + 1 + offset;
    };
    // The bytes that follow the count of bytes, as many as the count of registers asks for.
    const auto holds = [&](std::size_t count_at, int count) {
        return at(count_at) < request.size() && request[at(count_at)] == 2 * count &&
               at(count_at) + static_cast<std::size_t>(2 * count) < request.size();
    };
    const int address = word(request, at(0));
    const int second = word(request, at(2));
    if (address < 0 || second < 0) {
        return ModbusException::illegal_value;
    }
    switch (request[header_]) {
    case MODBUS_FC_READ_HOLDING_REGISTERS: return read(address, second);
    case MODBUS_FC_READ_INPUT_REGISTERS: return read_table(RegisterTable::input, address, second);
    case MODBUS_FC_READ_COILS: return read_table(RegisterTable::coils, address, second);
    case MODBUS_FC_READ_DISCRETE_INPUTS: return read_table(RegisterTable::discrete, address, second);
    case MODBUS_FC_WRITE_SINGLE_COIL: return write_coil(address, second);
    case MODBUS_FC_WRITE_SINGLE_REGISTER: return write(address, request.data() + at(2), 1);
    case MODBUS_FC_WRITE_MULTIPLE_REGISTERS:
        return holds(4, second) ? write(address, request.data() + at(5), second) : ModbusException::illegal_value;
    case MODBUS_FC_WRITE_AND_READ_REGISTERS: {
        const int write_address = word(request, at(4));
        const int write_count = word(request, at(6));
        if (write_address < 0 || write_count > MODBUS_MAX_WR_WRITE_REGISTERS || !holds(8, write_count)) {
            return ModbusException::illegal_value;
        }
        // A read that cannot be must not leave its write behind.
        if (const ModbusException exception = read(address, second); exception != ModbusException::none) {
            return exception;
        }
        const ModbusException exception = write(write_address, request.data() + at(9), write_count);
        return exception != ModbusException::none ? exception : read(address, second);
    }
    default: return ModbusException::illegal_function;
    }
}

} // namespace splinefeed::host
