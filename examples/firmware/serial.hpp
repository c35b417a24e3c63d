// SPDX-License-Identifier: MIT
// Serial: bytes from and to the host. The tick's interrupt polls the UART, so a board needs no other interrupt.
#pragma once

#include "splinefeed/base/spsc_ring.hpp"

#include <array>
#include <atomic>
#include <cstdint>

namespace firmware {

/// One byte each way in a tick: the tick must be shorter than a byte on the line. The host is told to pause (XOFF)
/// before the buffer is full; what a UART nevertheless loses is reported (bytes_lost).
class Serial {
public:
    /// Bytes that act at once, wherever they stand between or within lines.
    enum class Request : std::uint8_t { status, hold, resume, abort };
    /// What read() of a board says instead of a byte.
    static constexpr int nothing = -1;
    static constexpr int lost = -2; ///< the UART had no room for one or more bytes

    /// Stands among the bytes of lines where an abort came: what was sent before it belongs to the program that ends.
    static constexpr char abort_mark = 0x18;

    /// For the interrupt. @param read  () -> int: a byte, `nothing` or `lost`
    /// @param write  (std::uint8_t) -> bool: false if the UART has no room now
    template <class Read, class Write>
    void poll(Read&& read, Write&& write) noexcept {
        if (received_.room() > 0) {
            const int byte = read();
            if (byte == lost) {
                bytes_lost_.store(true, std::memory_order_relaxed);
            } else if (byte != nothing) {
                take(static_cast<std::uint8_t>(byte));
            }
        }
        const std::size_t waiting = received_.size();
        const bool pause = waiting > (paused_ ? in_size / 4 : in_size / 2);
        if (pause != paused_) {
            paused_ = write(pause ? xoff : xon) ? pause : paused_;
        } else if (!to_send_.empty() && write(to_send_.front())) {
            to_send_.drop();
        }
    }

    /// For the main loop: the next byte of a line.
    [[nodiscard]] bool pop(char& out) noexcept {
        std::uint8_t byte = 0;
        const bool here = received_.pop(byte);
        out = static_cast<char>(byte);
        return here;
    }
    /// Waits for room: a byte leaves in each tick.
    void write(const char* text) noexcept {
        for (; *text != '\0'; ++text) {
            while (to_send_.room() == 0) {
            }
            to_send_.push(static_cast<std::uint8_t>(*text));
        }
    }
    /// Whether this was asked since the last call.
    [[nodiscard]] bool asked(Request request) noexcept {
        std::atomic<bool>& flag = asked_[static_cast<std::size_t>(request)];
        return flag.load(std::memory_order_relaxed) && (flag.store(false, std::memory_order_relaxed), true);
    }
    [[nodiscard]] bool bytes_lost() noexcept {
        return bytes_lost_.load(std::memory_order_relaxed) &&
               (bytes_lost_.store(false, std::memory_order_relaxed), true);
    }

private:
    static constexpr std::uint8_t xon = 0x11;
    static constexpr std::uint8_t xoff = 0x13;
    static constexpr std::size_t in_size = 256; // the half above the mark holds what a USB adapter still sends
    static constexpr std::size_t out_size = 128;

    void take(std::uint8_t byte) noexcept {
        switch (byte) {
        case '?': ask(Request::status); break;
        case '!': ask(Request::hold); break;
        case '~': ask(Request::resume); break;
        case abort_mark:
            ask(Request::abort);
            received_.push(byte);
            break;
        default: received_.push(byte); break;
        }
    }
    void ask(Request request) noexcept {
        asked_[static_cast<std::size_t>(request)].store(true, std::memory_order_relaxed);
    }

    std::array<std::uint8_t, in_size> in_{};
    std::array<std::uint8_t, out_size> out_{};
    splinefeed::SpscRing<std::uint8_t> received_{in_};
    splinefeed::SpscRing<std::uint8_t> to_send_{out_};
    std::array<std::atomic<bool>, 4> asked_{};
    std::atomic<bool> bytes_lost_{false};
    bool paused_ = false;
};

} // namespace firmware
