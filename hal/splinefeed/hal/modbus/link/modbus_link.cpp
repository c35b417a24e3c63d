// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/link/modbus_link.hpp"

#include "splinefeed/base/units.hpp"
#include "splinefeed/hal/modbus/link/connection_error.hpp"

#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <modbus/modbus.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>

namespace splinefeed::hal::modbus {

namespace {

// Wait before discarding input, so that outstanding answers have arrived. Without it the answers would stay one request
// behind for ever.
constexpr std::uint64_t settle_us = 5000;
// A receiver that missed the beginning of a frame waits for silence: after so many failures it gets a long one.
constexpr int lost_failures = 3;
constexpr std::uint64_t lost_us = 300'000;
constexpr std::size_t longest_frame = 256;

// Resolves a host name to a numeric IPv4 address; empty on failure.
std::string resolved(const std::string& host) {
    addrinfo wanted{};
    wanted.ai_family = AF_INET;
    wanted.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    if (getaddrinfo(host.c_str(), nullptr, &wanted, &found) != 0) {
        return {};
    }
    std::array<char, INET_ADDRSTRLEN> text{};
    const auto* const address = reinterpret_cast<const sockaddr_in*>(found->ai_addr);
    const bool ok = inet_ntop(AF_INET, &address->sin_addr, text.data(), text.size()) != nullptr;
    freeaddrinfo(found);
    return ok ? text.data() : "";
}

LinkFault fault_of(int error) noexcept {
    switch (error) {
    case ETIMEDOUT:
    case EAGAIN: return LinkFault::timeout;
    case EMBBADCRC: return LinkFault::corrupt;
    case EMBBADSLAVE: return LinkFault::wrong_unit;
    case EMBBADDATA:
    case EMBMDATA:
    case EMBUNKEXC:
    case EMBBADEXC: return LinkFault::wrong_length;
    default: return error > MODBUS_ENOBASE ? LinkFault::exception : LinkFault::disconnected;
    }
}

} // namespace

struct ModbusLink::Context {
    LinkAddress address;
    LinkTiming timing;
    Clock* clock = nullptr;
    modbus_t* modbus = nullptr;
    std::uint64_t quiet_from_us = 0; // instant of the last byte on the line
    int error = 0;
    bool connected = false;
    int failures = 0;    // in a row
    int timeouts = 0;    // in a row
    bool dirty = false;  // late input is possible
    bool behind = false; // whole answers may be outstanding
    OpenAnswers open{};  // of a serial line

    [[nodiscard]] bool lost() const noexcept { return address.wire == Wire::rtu && failures >= lost_failures; }
    [[nodiscard]] std::uint64_t next_us() const noexcept {
        const std::uint64_t settle = lost()   ? lost_us
                                     : behind ? timing.answer_us + frame_us(address, longest_frame)
                                     : dirty  ? settle_us
                                              : 0;
        return quiet_from_us + silence_us(address) + timing.before_us + settle;
    }
};

struct ModbusLink::Request {
    int unit;
    RequestKind kind;
    std::uint64_t content;
    ExchangeBytes bytes;
    int expected; // what libmodbus returns where all is well
};

ModbusLink::ModbusLink(const LinkAddress& address, const LinkTiming& timing, Clock& clock)
    : context_(std::make_unique<Context>(Context{.address = address, .timing = timing, .clock = &clock})) {
    constexpr int data_bits = 8;
    const std::string host = address.wire == Wire::tcp ? resolved(address.host) : address.host;
    if (host.empty()) {
        context_->error = no_such_host;
        return;
    }
    context_->modbus = address.wire == Wire::tcp
                           ? modbus_new_tcp(host.c_str(), address.port)
                           : modbus_new_rtu(host.c_str(), address.baud, address.parity, data_bits, address.stops());
    if (context_->modbus == nullptr) {
        context_->error = errno;
    }
}

ModbusLink::~ModbusLink() {
    if (context_->modbus != nullptr) {
        ModbusLink::close();
        modbus_free(context_->modbus);
    }
}

const LinkAddress& ModbusLink::address() const noexcept {
    return context_->address;
}

Clock& ModbusLink::clock() const noexcept {
    return *context_->clock;
}

bool ModbusLink::connected() const noexcept {
    return context_->connected;
}

std::string ModbusLink::error() const {
    return connection_error(context_->error, context_->address);
}

std::uint64_t ModbusLink::next_us() const noexcept {
    return std::max(context_->clock->now_us(), context_->next_us());
}

void ModbusLink::resynchronise() noexcept {
    if (context_->address.wire == Wire::rtu) {
        context_->dirty = context_->behind = true;
    }
}

std::uint64_t ModbusLink::read_from_us(int unit) const noexcept {
    return is_unit(Wire::rtu, unit) ? context_->open.until_us(unit, RequestKind::reading, 0) : 0;
}

bool ModbusLink::owes_answer(int unit) const noexcept {
    return is_unit(Wire::rtu, unit) && context_->open.owes(unit, context_->clock->now_us());
}

bool ModbusLink::connect() noexcept {
    Context& context = *context_;
    if (context.modbus == nullptr) {
        return false;
    }
    close();
    const std::uint32_t most = context.timing.answer_us;
    modbus_set_response_timeout(context.modbus, most / us_per_s, most % us_per_s);
    // Without a time-out of its own for each byte that of the response is for the whole of it.
    modbus_set_byte_timeout(context.modbus, 0, 0);
    if (modbus_connect(context.modbus) != 0) {
        context.error = errno;
        return false;
    }
    context.connected = true;
    context.timeouts = 0;
    context.dirty = context.address.wire == Wire::rtu; // a new tcp connection has no old input
    context.quiet_from_us = context.clock->now_us();
    return true;
}

void ModbusLink::close() noexcept {
    if (context_->connected) {
        modbus_close(context_->modbus);
        context_->connected = false;
    }
}

// TCP repeats lost data after growing pauses of seconds; a new connection works at once. Data that is still buffered
// must not arrive later: an old target would move the drive back. So the connection is reset.
void ModbusLink::abandon() noexcept {
    if (context_->address.wire == Wire::tcp) {
        constexpr linger drop{.l_onoff = 1, .l_linger = 0};
        setsockopt(modbus_get_socket(context_->modbus), SOL_SOCKET, SO_LINGER, &drop, sizeof(drop));
    }
    close();
}

// Of a device that sends without an end there is always more: such a connection is of no use.
bool ModbusLink::flush() noexcept {
    constexpr int most_frames = 16;
    Context& context = *context_;
    context.dirty = context.behind = false;
    if (context.address.wire == Wire::rtu) {
        modbus_flush(context.modbus);
        return true;
    }
    std::array<std::uint8_t, longest_frame> old{};
    for (int i = 0; i < most_frames; ++i) {
        const ssize_t size = recv(modbus_get_socket(context.modbus), old.data(), old.size(), MSG_DONTWAIT);
        if (size < static_cast<ssize_t>(old.size())) {
            return true;
        }
    }
    return false;
}

template <class Call>
LinkAnswer ModbusLink::transact(const Request& request, const Call& call) noexcept {
    Context& context = *context_;
    const auto& [unit, kind, content, bytes, expected] = request;
    LinkAnswer answer;
    answer.sent_us = answer.answered_us = context.clock->now_us();
    if (!context.connected) {
        answer.fault = LinkFault::disconnected;
        return answer;
    }
    // Otherwise libmodbus would use the previous unit.
    if (!is_unit(context.address.wire, unit) || modbus_set_slave(context.modbus, unit) != 0) {
        answer.fault = LinkFault::bad_unit;
        return answer;
    }
    const bool serial = context.address.wire == Wire::rtu;
    const std::uint64_t quiet =
        std::max(context.next_us(), serial ? context.open.until_us(unit, kind, content) : std::uint64_t{0});
    context.failures = context.lost() ? 0 : context.failures;
    if (answer.sent_us < quiet) {
        context.clock->sleep_until_us(quiet);
        answer.sent_us = context.clock->now_us();
    }
    if (context.dirty && !flush()) {
        context.error = EMBMDATA;
        abandon();
        answer.fault = LinkFault::disconnected;
        answer.answered_us = context.clock->now_us();
        return answer;
    }
    // libmodbus counts the time-out from the moment when the request is in the system's buffer.
    const std::uint32_t most = context.timing.answer_us + frame_us(context.address, bytes.request + bytes.reply);
    modbus_set_response_timeout(context.modbus, most / us_per_s, most % us_per_s);
    errno = 0;
    const int done = call(context.modbus);
    answer.answered_us = context.quiet_from_us = context.clock->now_us();
    judge(request, done, answer);
    return answer;
}

void ModbusLink::judge(const Request& request, int done, LinkAnswer& answer) noexcept {
    const int error = errno;
    Context& context = *context_;
    const bool serial = context.address.wire == Wire::rtu;
    if (done == request.expected) {
        context.failures = context.timeouts = 0;
        answer.arrived_us = answer.sent_us + frame_us(context.address, request.bytes.request);
        answer.replied_us = answer.answered_us - frame_us(context.address, request.bytes.reply);
    } else {
        ++context.failures;
        answer.fault = done >= 0 ? LinkFault::wrong_length : fault_of(error);
        context.dirty = answer.fault != LinkFault::exception;
        context.timeouts = answer.fault == LinkFault::timeout ? context.timeouts + 1 : 0;
    }
    if (serial && context.dirty) {
        context.open.missed(request.unit, request.kind, request.content, answer.answered_us);
    } else if (serial) {
        context.open.answered(request.unit, request.kind);
    }
    if (answer.fault == LinkFault::exception) {
        answer.exception = static_cast<std::uint8_t>(error - MODBUS_ENOBASE);
    } else if (answer.fault == LinkFault::disconnected || (!serial && context.timeouts > context.timing.retries)) {
        context.error = error;
        abandon();
    }
}

template <class Call>
LinkAnswer ModbusLink::read_by(const Call& call, int unit, int address, std::span<std::uint16_t> out) noexcept {
    std::array<std::uint16_t, MODBUS_MAX_READ_REGISTERS> in{};
    const int count = static_cast<int>(out.size());
    const LinkAnswer answer =
        transact({unit, RequestKind::reading, 0, exchange_bytes(context_->address, 0, out.size()), count},
                 [&](modbus_t* modbus) { return call(modbus, address, count, in.data()); });
    if (answer.ok()) {
        std::memcpy(out.data(), in.data(), out.size_bytes());
    }
    return answer;
}

LinkAnswer ModbusLink::read(int unit, int address, std::span<std::uint16_t> out) noexcept {
    return read_by(modbus_read_registers, unit, address, out);
}

LinkAnswer ModbusLink::read_inputs(int unit, int address, std::span<std::uint16_t> out) noexcept {
    return read_by(modbus_read_input_registers, unit, address, out);
}

LinkAnswer ModbusLink::write(int unit, int address, std::span<const std::uint16_t> values) noexcept {
    const int count = static_cast<int>(values.size());
    return transact({unit, RequestKind::write, content_of(address, values),
                     exchange_bytes(context_->address, values.size(), 0), count},
                    [&](modbus_t* modbus) { return modbus_write_registers(modbus, address, count, values.data()); });
}

// The request is as long as that of a read, and the answer repeats the request.
LinkAnswer ModbusLink::write_one(int unit, int address, std::uint16_t value) noexcept {
    const std::size_t bytes = exchange_bytes(context_->address, 0, 1).request;
    return transact({unit, RequestKind::single_write, content_of(address, std::span(&value, 1)), {bytes, bytes}, 1},
                    [&](modbus_t* modbus) { return modbus_write_register(modbus, address, value); });
}

LinkAnswer ModbusLink::exchange(int unit, int write_address, std::span<const std::uint16_t> values, int read_address,
                                std::span<std::uint16_t> out) noexcept {
    std::array<std::uint16_t, MODBUS_MAX_WR_READ_REGISTERS> in{};
    const int count = static_cast<int>(out.size());
    const ExchangeBytes bytes = exchange_bytes(context_->address, values.size(), out.size());
    const LinkAnswer answer = transact({unit, RequestKind::exchange, 0, bytes, count}, [&](modbus_t* modbus) {
        return modbus_write_and_read_registers(modbus, write_address, static_cast<int>(values.size()), values.data(),
                                               read_address, count, in.data());
    });
    if (answer.ok()) {
        std::memcpy(out.data(), in.data(), out.size_bytes());
    }
    return answer;
}

// The request is as long as that of registers, and one byte of the answer has the bit.
LinkAnswer ModbusLink::read_bit(int unit, BitTable table, int address, bool& out) noexcept {
    const std::size_t request = exchange_bytes(context_->address, 0, 1).request;
    std::uint8_t bit = 0;
    const LinkAnswer answer =
        transact({unit, RequestKind::reading, 0, {request, request - 2}, 1}, [&](modbus_t* modbus) {
            return table == BitTable::coils ? modbus_read_bits(modbus, address, 1, &bit)
                                            : modbus_read_input_bits(modbus, address, 1, &bit);
        });
    if (answer.ok()) {
        out = bit != 0;
    }
    return answer;
}

LinkAnswer ModbusLink::write_coil(int unit, int address, bool on) noexcept {
    const std::size_t bytes = exchange_bytes(context_->address, 0, 1).request;
    return transact({unit, RequestKind::single_write, content_of(address, std::array{on}), {bytes, bytes}, 1},
                    [&](modbus_t* modbus) { return modbus_write_bit(modbus, address, on ? 1 : 0); });
}

} // namespace splinefeed::hal::modbus
