// SPDX-License-Identifier: MIT
// SimulatedModule: an I/O module with a few coils and inputs, and a line to it on a virtual clock.
#pragma once

#include "splinefeed/hal/modbus/module/module_bus.hpp"

#include <map>

namespace splinefeed_test {

/// Its bits, and what is wrong with it. Addresses that it does not have are refused.
struct SimulatedModule {
    std::map<int, bool> coils;
    std::map<int, bool> inputs;
    int writes = 0;
    bool mute = false;      ///< requests take effect, but nobody hears the answer
    bool unplugged = false; ///< there is no connection
};

/// A line with modules by unit, which outlive it.
class ModuleLink final : public splinefeed::hal::modbus::ModbusWire {
public:
    using LinkAddress = splinefeed::hal::modbus::LinkAddress;
    using LinkAnswer = splinefeed::hal::modbus::LinkAnswer;
    using LinkFault = splinefeed::hal::modbus::LinkFault;
    using LinkTiming = splinefeed::hal::modbus::LinkTiming;
    using BitTable = splinefeed::hal::modbus::BitTable;

    ModuleLink(std::map<int, SimulatedModule>& modules, const LinkAddress& address, const LinkTiming& timing,
               splinefeed::hal::Clock& clock)
        : modules_(modules), address_(address), timing_(timing), clock_(clock) {}

    bool connect() noexcept override {
        connected_ = true;
        for (const auto& [unit, module] : modules_) {
            connected_ = connected_ && !module.unplugged;
        }
        return connected_;
    }
    void close() noexcept override { connected_ = false; }
    [[nodiscard]] bool connected() const noexcept override { return connected_; }
    [[nodiscard]] std::string error() const override { return "it is unplugged"; }
    LinkAnswer read(int /*unit*/, int /*address*/, std::span<std::uint16_t> /*out*/) noexcept override { return {}; }
    LinkAnswer write(int /*unit*/, int /*address*/, std::span<const std::uint16_t> /*values*/) noexcept override {
        return {};
    }
    LinkAnswer exchange(int /*unit*/, int /*write_address*/, std::span<const std::uint16_t> /*values*/,
                        int /*read_address*/, std::span<std::uint16_t> /*out*/) noexcept override {
        return {};
    }
    LinkAnswer read_bit(int unit, BitTable table, int address, bool& out) noexcept override {
        return transact(unit, table, address, [&out](SimulatedModule& /*module*/, bool& bit) { out = bit; });
    }
    LinkAnswer write_coil(int unit, int address, bool on) noexcept override {
        return transact(unit, BitTable::coils, address, [on](SimulatedModule& module, bool& bit) {
            bit = on;
            ++module.writes;
        });
    }
    void resynchronise() noexcept override {}
    [[nodiscard]] std::uint64_t next_us() const noexcept override { return clock_.now_us(); }
    [[nodiscard]] const LinkAddress& address() const noexcept override { return address_; }
    [[nodiscard]] splinefeed::hal::Clock& clock() const noexcept override { return clock_; }

private:
    static constexpr std::uint64_t latency_us = 700;

    template <class Effect>
    LinkAnswer transact(int unit, BitTable table, int address, const Effect& effect) {
        LinkAnswer answer;
        const auto found = modules_.find(unit);
        if (found == modules_.end() || found->second.unplugged) {
            clock_.sleep_us(timing_.answer_us);
            connected_ = found == modules_.end();
            answer.fault = connected_ ? LinkFault::timeout : LinkFault::disconnected;
            return answer;
        }
        clock_.sleep_us(latency_us);
        SimulatedModule& module = found->second;
        std::map<int, bool>& bits = table == BitTable::coils ? module.coils : module.inputs;
        const auto bit = bits.find(address);
        if (bit == bits.end()) {
            answer.fault = LinkFault::exception;
            answer.exception = 2;
            return answer;
        }
        effect(module, bit->second);
        if (module.mute) {
            clock_.sleep_us(timing_.answer_us);
            answer.fault = LinkFault::timeout;
        }
        return answer;
    }

    std::map<int, SimulatedModule>& modules_;
    LinkAddress address_;
    LinkTiming timing_;
    splinefeed::hal::Clock& clock_;
    bool connected_ = false;
};

} // namespace splinefeed_test
