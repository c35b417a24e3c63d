// SPDX-License-Identifier: MIT
// A chip that records: what was set when, as a logic analyser sees it.
#pragma once

#include "splinefeed/hal/gpio/pin_writer.hpp"
#include "splinefeed/hal/rt/clock.hpp"

#include <cerrno>
#include <chrono>
#include <mutex>
#include <thread>
#include <vector>

namespace splinefeed_test {

class RecordingWriter final : public splinefeed::hal::gpio::PinWriter {
public:
    struct Row {
        std::uint64_t at_ns;
        std::uint64_t levels; // of all lines
        std::uint64_t mask;   // of the call
    };

    [[nodiscard]] bool set(std::uint64_t mask, std::uint64_t levels) noexcept override {
        const std::lock_guard lock(mutex_);
        levels_ = (levels_ & ~mask) | (levels & mask);
        rows_.push_back({splinefeed::hal::system_clock().now_ns(), levels_, mask});
        if (rows_.size() == stalls_after_) { // the thread that sets stands still
            std::this_thread::sleep_for(std::chrono::milliseconds(stall_ms_));
        }
        if (fails_after_ > 0 && rows_.size() >= fails_after_) {
            errno = ENODEV;
            return false;
        }
        return true;
    }
    /// As lines are before a port has them.
    void begin_with(std::uint64_t levels) { levels_ = levels; }
    void stall_after(std::size_t rows, int ms) {
        stalls_after_ = rows;
        stall_ms_ = ms;
    }
    void fail_after(std::size_t rows) { fails_after_ = rows; }
    [[nodiscard]] std::vector<Row> rows() const {
        const std::lock_guard lock(mutex_);
        return rows_;
    }

private:
    mutable std::mutex mutex_;
    std::vector<Row> rows_;
    std::uint64_t levels_ = 0;
    std::size_t fails_after_ = 0;
    std::size_t stalls_after_ = 0;
    int stall_ms_ = 0;
};

} // namespace splinefeed_test
