// SPDX-License-Identifier: MIT
// ModbusWire: interface to the wire of Modbus devices. ModbusLink implements it; tests use a simulated one.
#pragma once

#include "splinefeed/hal/modbus/link/link_address.hpp"
#include "splinefeed/hal/modbus/link/open_answers.hpp"
#include "splinefeed/hal/rt/clock.hpp"

#include <span>

namespace splinefeed::hal::modbus {

enum class LinkFault : std::uint8_t {
    none,
    timeout,      ///< no answer, or an incomplete one
    disconnected, ///< the connection is lost: reset, refused, unplugged
    corrupt,      ///< wrong CRC
    wrong_unit,   ///< another drive answered
    wrong_length, ///< a valid frame that does not fit the request; on tcp also an answer to an earlier request
    exception,    ///< the drive refused the request: LinkAnswer::exception
    bad_unit,     ///< the unit number is invalid (is_unit); nothing was sent
};

/// What of single bits a device has.
enum class BitTable : std::uint8_t {
    coils,  ///< written and read
    inputs, ///< discrete inputs: read
};

struct LinkAnswer {
    LinkFault fault = LinkFault::none;
    std::uint8_t exception = 0;    ///< exception code of the Modbus application protocol, if fault is exception
    std::uint64_t sent_us = 0;     ///< on the line's clock: before the request was sent
    std::uint64_t answered_us = 0; ///< when its answer was complete
    std::uint64_t arrived_us = 0;  ///< earliest instant at which the drive had the whole request, by the line's rate
    std::uint64_t replied_us = 0;  ///< latest instant at which it began to answer

    [[nodiscard]] bool ok() const noexcept { return fault == LinkFault::none; }
    /// Whether the device will never execute this request. Exceptions that say "later" (acknowledge, busy), and those
    /// of a gateway that does not reach the device, are no refusals: like a time-out, they may pass.
    [[nodiscard]] bool refused() const noexcept;
};

/// Text for messages: what went wrong and what to check. On a line that worked before, the tcp text is right for both.
[[nodiscard]] const char* describe(LinkFault fault, Wire wire = Wire::tcp) noexcept;
/// Name of an exception code, for example "illegal address".
[[nodiscard]] const char* exception_name(std::uint8_t code) noexcept;

/// One line to one or several drives. For one thread at a time. Calls block until the answer or the time-out: a call
/// takes longest_exchange_us() at most, whatever comes in. Call connect() again after the connection is lost.
class ModbusWire {
public:
    ModbusWire() = default;
    ModbusWire(const ModbusWire&) = delete;
    ModbusWire& operator=(const ModbusWire&) = delete;
    virtual ~ModbusWire() = default;

    /// Connects, within LinkTiming::answer_us. Returns false on failure: error().
    virtual bool connect() noexcept = 0;
    virtual void close() noexcept = 0;
    [[nodiscard]] virtual bool connected() const noexcept = 0;
    /// Why the last connect() failed, or the connection was lost, and what to do.
    [[nodiscard]] virtual std::string error() const = 0;

    /// Functions 03, 16 and 23. After a fault `out` is unchanged, and it is unknown whether the drive executed the
    /// request.
    /// @pre at most 125 registers to read, 123 to write; for function 23: 121 to write, 125 to read
    virtual LinkAnswer read(int unit, int address, std::span<std::uint16_t> out) noexcept = 0;
    virtual LinkAnswer write(int unit, int address, std::span<const std::uint16_t> values) noexcept = 0;
    /// Function 06, for a drive without function 16. The default uses function 16.
    virtual LinkAnswer write_one(int unit, int address, std::uint16_t value) noexcept {
        return write(unit, address, std::span(&value, 1));
    }
    virtual LinkAnswer exchange(int unit, int write_address, std::span<const std::uint16_t> values, int read_address,
                                std::span<std::uint16_t> out) noexcept = 0;

    /// Functions 04, input registers, 01 and 02, of one bit, and 05. By default the line has no device with such: an
    /// exception, illegal function.
    virtual LinkAnswer read_inputs(int unit, int address, std::span<std::uint16_t> out) noexcept;
    virtual LinkAnswer read_bit(int unit, BitTable table, int address, bool& out) noexcept;
    virtual LinkAnswer write_coil(int unit, int address, bool on) noexcept;

    /// Call when an answer belonged to an earlier request, which a serial frame does not show. The next request then
    /// waits until all outstanding answers have arrived, and discards them. Does nothing on tcp, where answers have
    /// transaction numbers.
    virtual void resynchronise() noexcept = 0;

    /// When a request made now would be sent, after the required silence. [us]
    [[nodiscard]] virtual std::uint64_t next_us() const noexcept = 0;

    /// A reading of that unit before this instant waits until then: OpenAnswers. Who has others to speak to asks later.
    /// [us]
    [[nodiscard]] virtual std::uint64_t read_from_us(int /*unit*/) const noexcept { return 0; }
    /// Whether the unit may still answer an earlier request: a request of another kind that it answers says that not.
    [[nodiscard]] virtual bool owes_answer(int /*unit*/) const noexcept { return false; }

    [[nodiscard]] virtual const LinkAddress& address() const noexcept = 0;
    /// Clock of the line and of everything on it; outlives the line.
    [[nodiscard]] virtual Clock& clock() const noexcept = 0;
};

/// What went wrong with a request on a line: "no answer in time ...", "exception busy", "there is no connection: ...".
[[nodiscard]] std::string describe(const LinkAnswer& answer, const ModbusWire& wire);

/// Longest time of an exchange: what may still come of earlier ones is waited for, then the answer. [us]
[[nodiscard]] constexpr std::uint64_t longest_exchange_us(const LinkAddress& address, const LinkTiming& timing,
                                                          std::size_t written, std::size_t read) noexcept {
    constexpr std::uint64_t scheduling_us = 50'000; // the host is late
    const std::uint64_t answer_us = std::uint64_t{timing.answer_us} + exchange_us(address, written, read);
    return OpenAnswers::latest_us + 2 * answer_us + timing.before_us + scheduling_us;
}

/// Factory of lines.
using MakeWire =
    std::function<std::unique_ptr<ModbusWire>(const LinkAddress& address, const LinkTiming& timing, Clock& clock)>;

/// Makes a ModbusLink.
[[nodiscard]] std::unique_ptr<ModbusWire> make_link(const LinkAddress& address, const LinkTiming& timing, Clock& clock);

} // namespace splinefeed::hal::modbus
