// SPDX-License-Identifier: MIT
// ModbusBus: one wire, the drives on it, and the one thread that speaks on it.
#pragma once

#include "splinefeed/hal/modbus/pvt/pvt_client.hpp"

namespace splinefeed::hal::modbus {

/// Each drive in turn gets one exchange, as often as it needs one. Between start() and stop() nobody else uses the
/// link.
class ModbusBus {
public:
    explicit ModbusBus(std::unique_ptr<ModbusLine> link) : link_(std::move(link)) {}
    ModbusBus(const ModbusBus&) = delete;
    ModbusBus& operator=(const ModbusBus&) = delete;
    ~ModbusBus() { stop(); }

    /// Before start(). The reference stays valid.
    PvtClient& add(int unit, bool both_in_one = true);
    [[nodiscard]] ModbusLine& link() noexcept { return *link_; }
    [[nodiscard]] const std::vector<std::unique_ptr<PvtClient>>& drives() const noexcept { return drives_; }

    void start();
    void stop() noexcept;
    /// Processor time that the thread used so far. [us]
    [[nodiscard]] std::uint64_t busy_us() const noexcept { return busy_us_.load(std::memory_order_relaxed); }

private:
    void run() noexcept;

    std::unique_ptr<ModbusLine> link_;
    std::vector<std::unique_ptr<PvtClient>> drives_;
    std::unique_ptr<ClockThread> thread_;
    std::atomic<bool> stopping_{false};
    std::atomic<std::uint64_t> busy_us_{0};
};

} // namespace splinefeed::hal::modbus
