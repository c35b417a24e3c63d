// SPDX-License-Identifier: MIT
// ModbusLink: a Modbus line on libmodbus. In addition to libmodbus it keeps the silences of a serial line and
// classifies faults.
#pragma once

#include "splinefeed/hal/modbus/link/modbus_wire.hpp"

namespace splinefeed::hal::modbus {

/// For one thread at a time. Allocates in its constructor only.
class ModbusLink final : public ModbusWire {
public:
    /// The clock must outlive the link.
    ModbusLink(const LinkAddress& address, const LinkTiming& timing, Clock& clock = system_clock());
    ModbusLink(const ModbusLink&) = delete;
    ModbusLink& operator=(const ModbusLink&) = delete;
    ~ModbusLink() override;

    bool connect() noexcept override;
    void close() noexcept override;
    [[nodiscard]] bool connected() const noexcept override;
    [[nodiscard]] std::string error() const override;

    LinkAnswer read(int unit, int address, std::span<std::uint16_t> out) noexcept override;
    LinkAnswer write(int unit, int address, std::span<const std::uint16_t> values) noexcept override;
    LinkAnswer write_one(int unit, int address, std::uint16_t value) noexcept override;
    LinkAnswer exchange(int unit, int write_address, std::span<const std::uint16_t> values, int read_address,
                        std::span<std::uint16_t> out) noexcept override;

    LinkAnswer read_inputs(int unit, int address, std::span<std::uint16_t> out) noexcept override;
    LinkAnswer read_bit(int unit, BitTable table, int address, bool& out) noexcept override;
    LinkAnswer write_coil(int unit, int address, bool on) noexcept override;

    void resynchronise() noexcept override;
    [[nodiscard]] std::uint64_t next_us() const noexcept override;
    [[nodiscard]] std::uint64_t read_from_us(int unit) const noexcept override;
    [[nodiscard]] bool owes_answer(int unit) const noexcept override;
    [[nodiscard]] const LinkAddress& address() const noexcept override;
    [[nodiscard]] Clock& clock() const noexcept override;

private:
    struct Context;
    struct Request;

    void abandon() noexcept;
    [[nodiscard]] bool flush() noexcept;
    void judge(const Request& request, int done, LinkAnswer& answer) noexcept;

    /// Reads registers by a function of libmodbus.
    template <class Call>
    LinkAnswer read_by(const Call& call, int unit, int address, std::span<std::uint16_t> out) noexcept;
    template <class Call>
    LinkAnswer transact(const Request& request, const Call& call) noexcept;

    std::unique_ptr<Context> context_;
};

} // namespace splinefeed::hal::modbus
