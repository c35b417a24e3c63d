// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt/modbus_bus.hpp"

namespace splinefeed::hal::modbus {

namespace {

constexpr std::uint64_t rest_us = 1000; // when no drive is due; one that moves is each 4 ms

} // namespace

PvtClient& ModbusBus::add(int unit, bool both_in_one) {
    drives_.push_back(std::make_unique<PvtClient>(*link_, unit, both_in_one));
    return *drives_.back();
}

void ModbusBus::start() {
    stopping_.store(false);
    thread_ = link_->clock().start([this] { run(); });
}

void ModbusBus::stop() noexcept {
    stopping_.store(true);
    if (thread_) {
        thread_->join();
    }
}

void ModbusBus::run() noexcept {
    while (!stopping_.load(std::memory_order_relaxed)) {
        bool spoke = false;
        for (const auto& drive : drives_) {
            spoke = drive->step() || spoke;
        }
        busy_us_.store(thread_us(), std::memory_order_relaxed);
        if (!spoke) {
            link_->clock().sleep_us(rest_us);
        }
    }
}

} // namespace splinefeed::hal::modbus
