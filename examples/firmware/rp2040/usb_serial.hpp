// SPDX-License-Identifier: MIT
// UsbSerial: bytes from and to a sender by USB, for which it is a serial port (CDC-ACM).
#pragma once

#include "rp2040/usb_pipe.hpp"

#include <array>
#include <atomic>

namespace rp2040 {

/// poll() is for the tick or a main loop, each 200 us or more often, as are read_byte() and write_byte(), from the same
/// place. None waits. Who sends faster than the other one reads has to wait: no byte is lost. But when a sender has
/// closed the port, what he has not read is, and when it is opened again, what he wrote.
/// Erratum RP2040-E15 is worked around, for polls each 200 us. RP2040-E5 is not: on a busy hub the chip's steppings B0
/// and B1 (2021) may not be found. Its workaround takes GPIO15, which commands the spindle.
class UsbSerial {
public:
    explicit constexpr UsbSerial(UsbPort& port) noexcept : port_(port) {}

    /// @pre clk_usb runs, at 48 MHz
    void start() noexcept;
    void poll() noexcept;

    /// A sender has opened the port (DTR), and the bus is awake; a pulled cable lets it sleep after 3 ms. From
    /// anywhere.
    [[nodiscard]] bool is_open() const noexcept { return open_.load(std::memory_order_relaxed); }
    /// How often it was opened: tells a sender from the next one where nobody has looked in between. From anywhere.
    [[nodiscard]] std::uint32_t sessions() const noexcept { return sessions_.load(std::memory_order_relaxed); }
    /// @return a byte, or -1: none
    int read_byte() noexcept {
        const int byte = out_.size() > 0 ? out_.take() : -1;
        if (byte >= 0 && out_.size() == 0) {
            out_.receive();
        }
        return byte;
    }
    /// @return false: no room now. Without a sender it is taken and dropped.
    [[nodiscard]] bool write_byte(std::uint8_t byte) noexcept {
        if (sender_ && count_ < next_.size()) {
            next_[count_++] = byte;
            return true;
        }
        return !sender_;
    }

private:
    enum class Stage : std::uint8_t { refused, status, address, data, answer }; // of a request
    void begin_request() noexcept;
    Stage answer(std::uint32_t request, std::uint32_t value, std::uint32_t index, std::uint32_t length) noexcept;
    void send_answer() noexcept;
    void go_on(std::uint32_t buffers) noexcept;
    void configure(bool on) noexcept;
    void set_sender(bool here) noexcept;

    UsbPort& port_;
    UsbPipe control_in_{port_, 0, 0, 0x100}; // both have the one buffer
    UsbPipe control_out_{port_, 1, 0, 0x100};
    std::array<UsbPipe, 3> pipes_{{{port_, 2, 3, 0x180}, {port_, 4, 2, 0x1c0}, {port_, 5, 2, 0x200}}};
    UsbPipe& in_ = pipes_[1];
    UsbPipe& out_ = pipes_[2];
    Stage stage_ = Stage::status;
    std::span<const std::uint8_t> to_answer_;
    bool is_short_ = false; // the host has asked for more
    std::array<std::uint8_t, 2> reply_{};
    std::array<std::uint8_t, 7> line_coding_{0x00, 0xc2, 1, 0, 0, 0, 8}; // 115200 8N1; means nothing here
    std::uint32_t address_ = 0;                                          // when SET_ADDRESS is over
    std::uint8_t configuration_ = 0;
    bool sender_ = false;
    bool suspended_ = false;
    unsigned polls_of_frame_ = 0;
    std::uint32_t frame_ = 0;
    std::array<std::uint8_t, UsbPipe::packet> next_{}; // packet to the host
    std::size_t count_ = 0;
    bool was_full_ = false; // the last one: the host waits for one that is not, maybe an empty one
    std::atomic<bool> open_{false};
    std::atomic<std::uint32_t> sessions_{0};
};

} // namespace rp2040
