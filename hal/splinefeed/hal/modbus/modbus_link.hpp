// SPDX-License-Identifier: MIT
// ModbusLink: one wire to one or several drives, on libmodbus. It keeps the silences of a serial line, which libmodbus
// does not, and tells what went wrong by name.
#pragma once

#include "splinefeed/hal/modbus/link_address.hpp"

#include <memory>
#include <span>

namespace splinefeed::hal::modbus {

enum class LinkFault : std::uint8_t {
    none,
    timeout,      ///< no answer, or one that broke off
    disconnected, ///< the wire is gone: reset, refused, unplugged
    corrupt,      ///< wrong CRC
    wrong_unit,   ///< another drive answered
    wrong_length, ///< a valid frame that does not fit the request; on tcp also an answer to an earlier request
    exception,    ///< the drive refused; LinkAnswer::exception says why
};

struct LinkAnswer {
    LinkFault fault = LinkFault::none;
    std::uint8_t exception = 0;    ///< code of the Modbus application protocol, where fault is exception
    std::uint64_t sent_us = 0;     ///< monotonic clock: before the request went out
    std::uint64_t answered_us = 0; ///< and when its answer was complete
    std::uint64_t arrived_us = 0;  ///< when the drive had the request, by the line's rate, at the earliest
    std::uint64_t replied_us = 0;  ///< and began to answer, at the latest

    [[nodiscard]] bool ok() const noexcept { return fault == LinkFault::none; }
};

/// "no answer within its time", ...; what an owner would look at.
[[nodiscard]] const char* describe(LinkFault fault) noexcept;
/// "illegal address", ...
[[nodiscard]] const char* exception_name(std::uint8_t code) noexcept;

/// CLOCK_MONOTONIC [us]
[[nodiscard]] std::uint64_t monotonic_us() noexcept;
/// Processor time of the calling thread. [us]
[[nodiscard]] std::uint64_t thread_us() noexcept;
/// Sleeps until that instant.
void sleep_until_us(std::uint64_t instant_us) noexcept;

/// Not copied, not moved; used by one thread at a time. It allocates when it is made, and never again: connect() may be
/// called as often as the wire breaks.
class ModbusLink {
public:
    ModbusLink(const LinkAddress& address, const LinkTiming& timing);
    ModbusLink(const ModbusLink&) = delete;
    ModbusLink& operator=(const ModbusLink&) = delete;
    ~ModbusLink();

    /// False: it cannot be reached; error() says why. It takes at most the answer's time.
    bool connect() noexcept;
    void close() noexcept;
    [[nodiscard]] bool connected() const noexcept;
    /// Why the last connect() failed, in the system's words.
    [[nodiscard]] const char* error() const noexcept;

    /// Functions 03, 16 and 23. A fault changes nothing in `out`; what it did in the drive is unknown.
    /// @pre at most 125, 123, and 121 and 125 registers
    LinkAnswer read(int unit, int address, std::span<std::uint16_t> out) noexcept;
    LinkAnswer write(int unit, int address, std::span<const std::uint16_t> values) noexcept;
    LinkAnswer exchange(int unit, int write_address, std::span<const std::uint16_t> values, int read_address,
                        std::span<std::uint16_t> out) noexcept;

    /// The last answer was that to an earlier request, which a serial line does not tell: the next request waits until
    /// all answers that are under way have come, and throws them away. On tcp it does nothing: answers have numbers.
    void resynchronise() noexcept;

    /// When a request that is made now goes out, after the silence that the line needs.
    [[nodiscard]] std::uint64_t next_us() const noexcept;

    [[nodiscard]] const LinkAddress& address() const noexcept;

private:
    struct Context;

    template <class Call>
    LinkAnswer transact(int unit, const ExchangeBytes& bytes, int expected, const Call& call) noexcept;

    std::unique_ptr<Context> context_;
};

} // namespace splinefeed::hal::modbus
