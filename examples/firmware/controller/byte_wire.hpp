// SPDX-License-Identifier: MIT
// ByteWire: bytes from and to a sender. The tick's interrupt polls the UART, so a board needs no other interrupt.
#pragma once

#include "serial.hpp"

#include <span>

namespace firmware {

/// One byte each way in a tick: the tick must be shorter than a byte on the line. The main loop hands all that came to
/// the controller in each of its rounds, before any line of it is read, so a stop waits for no line. A reset does not
/// even wait for the round.
class ByteWire {
public:
    /// For the interrupt. @param read  () -> int: a byte, Serial::nothing or Serial::lost
    /// @param write  (std::uint8_t) -> bool: false if the UART has no room now
    /// @return whether a reset came
    template <class Read, class Write>
    bool poll(Read&& read, Write&& write) noexcept {
        constexpr int reset = 0x18;
        bool resets = false;
        if (received_.room() > 0) {
            const int byte = read();
            if (byte == Serial::lost) {
                bytes_lost_.store(true, std::memory_order_relaxed);
            } else if (byte != Serial::nothing) {
                received_.push(static_cast<std::uint8_t>(byte));
                resets = byte == reset;
            }
        }
        if (!to_send_.empty() && write(to_send_.front())) {
            to_send_.drop();
        }
        return resets;
    }

    /// For the main loop: whether bytes have come.
    [[nodiscard]] bool has_come() const noexcept { return !received_.empty(); }
    /// Moves what has come out; returns how many bytes.
    [[nodiscard]] std::size_t take(std::span<char> out) noexcept {
        std::size_t count = 0;
        for (std::uint8_t byte = 0; count < out.size() && received_.pop(byte); ++count) {
            out[count] = static_cast<char>(byte);
        }
        return count;
    }
    [[nodiscard]] std::size_t room_to_send() const noexcept { return to_send_.room(); }
    /// @pre room_to_send() >= bytes.size()
    void send(std::span<const char> bytes) noexcept {
        for (const char byte : bytes) {
            to_send_.push(static_cast<std::uint8_t>(byte));
        }
    }
    [[nodiscard]] bool bytes_lost() noexcept {
        return bytes_lost_.load(std::memory_order_relaxed) &&
               (bytes_lost_.store(false, std::memory_order_relaxed), true);
    }

private:
    // What senders may have sent unanswered (1024 bytes), and bytes that act at once: so no round of the main loop,
    // however long it takes, loses one.
    std::array<std::uint8_t, 1088> in_{};
    std::array<std::uint8_t, 128> out_{};
    splinefeed::SpscRing<std::uint8_t> received_{in_};
    splinefeed::SpscRing<std::uint8_t> to_send_{out_};
    std::atomic<bool> bytes_lost_{false};
};

} // namespace firmware
