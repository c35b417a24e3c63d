// SPDX-License-Identifier: MIT
// ModbusLine: what a bus needs of its wire. ModbusLink is the real one; a test puts a simulated one in its place.
#pragma once

#include "splinefeed/hal/modbus/link/link_address.hpp"
#include "splinefeed/hal/rt/clock.hpp"

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
    bad_unit,     ///< no frame can carry the unit number (is_unit); nothing was sent
};

struct LinkAnswer {
    LinkFault fault = LinkFault::none;
    std::uint8_t exception = 0;    ///< code of the Modbus application protocol, where fault is exception
    std::uint64_t sent_us = 0;     ///< the line's clock: before the request went out
    std::uint64_t answered_us = 0; ///< and when its answer was complete
    std::uint64_t arrived_us = 0;  ///< when the drive had the request, by the line's rate, at the earliest
    std::uint64_t replied_us = 0;  ///< and began to answer, at the latest

    [[nodiscard]] bool ok() const noexcept { return fault == LinkFault::none; }
};

/// "no answer within its time", ...; what an owner would look at.
[[nodiscard]] const char* describe(LinkFault fault) noexcept;
/// "illegal address", ...
[[nodiscard]] const char* exception_name(std::uint8_t code) noexcept;

/// One wire to one or several drives. Used by one thread at a time; calls block until the answer came or its time has
/// passed. connect() may be called as often as the wire breaks.
class ModbusLine {
public:
    ModbusLine() = default;
    ModbusLine(const ModbusLine&) = delete;
    ModbusLine& operator=(const ModbusLine&) = delete;
    virtual ~ModbusLine() = default;

    /// False: it cannot be reached; error() says why. It takes at most the answer's time.
    virtual bool connect() noexcept = 0;
    virtual void close() noexcept = 0;
    [[nodiscard]] virtual bool connected() const noexcept = 0;
    /// Why the last connect() failed.
    [[nodiscard]] virtual const char* error() const noexcept = 0;

    /// Functions 03, 16 and 23. A fault changes nothing in `out`; what it did in the drive is unknown.
    /// @pre at most 125, 123, and 121 and 125 registers
    virtual LinkAnswer read(int unit, int address, std::span<std::uint16_t> out) noexcept = 0;
    virtual LinkAnswer write(int unit, int address, std::span<const std::uint16_t> values) noexcept = 0;
    /// Function 06, of a drive that has no 16; a line that knows no difference writes it by 16.
    virtual LinkAnswer write_one(int unit, int address, std::uint16_t value) noexcept {
        return write(unit, address, std::span(&value, 1));
    }
    virtual LinkAnswer exchange(int unit, int write_address, std::span<const std::uint16_t> values, int read_address,
                                std::span<std::uint16_t> out) noexcept = 0;

    /// The last answer was that to an earlier request, which a serial line does not tell: the next request waits until
    /// all answers that are under way have come, and throws them away. On tcp it does nothing: answers have numbers.
    virtual void resynchronise() noexcept = 0;

    /// When a request that is made now goes out, after the silence that the line needs.
    [[nodiscard]] virtual std::uint64_t next_us() const noexcept = 0;

    [[nodiscard]] virtual const LinkAddress& address() const noexcept = 0;
    /// By which it and everything on it waits; it outlives the line.
    [[nodiscard]] virtual Clock& clock() const noexcept = 0;
};

/// Makes the wire of an address.
using MakeLine =
    std::function<std::unique_ptr<ModbusLine>(const LinkAddress& address, const LinkTiming& timing, Clock& clock)>;

/// A ModbusLink.
[[nodiscard]] std::unique_ptr<ModbusLine> make_link(const LinkAddress& address, const LinkTiming& timing, Clock& clock);

} // namespace splinefeed::hal::modbus
