// SPDX-License-Identifier: MIT
// ModbusBus: one wire with its drives, and the thread that exchanges data with them.
#pragma once

#include "splinefeed/hal/modbus/pvt/pvt_client.hpp"

namespace splinefeed::hal::modbus {

/// The thread serves the drives in turn, one exchange each, if one is due. Between start() and stop() no other thread
/// may use the link.
class ModbusBus {
public:
    explicit ModbusBus(std::unique_ptr<ModbusWire> link) : link_(std::move(link)) {}
    ModbusBus(const ModbusBus&) = delete;
    ModbusBus& operator=(const ModbusBus&) = delete;
    ~ModbusBus() { stop(); }

    /// Adds a drive. The reference stays valid. @pre not started
    PvtClient& add(int unit, bool both_in_one = true);
    [[nodiscard]] ModbusWire& link() noexcept { return *link_; }
    [[nodiscard]] const std::vector<std::unique_ptr<PvtClient>>& drives() const noexcept { return drives_; }

    void start();
    void stop() noexcept;
    /// Processor time that the thread has used. [us]
    [[nodiscard]] std::uint64_t busy_us() const noexcept { return busy_us_.load(std::memory_order_relaxed); }

private:
    void run() noexcept;

    std::unique_ptr<ModbusWire> link_;
    std::vector<std::unique_ptr<PvtClient>> drives_;
    std::unique_ptr<ClockThread> thread_;
    std::atomic<bool> stopping_{false};
    std::atomic<std::uint64_t> busy_us_{0};
};

} // namespace splinefeed::hal::modbus
