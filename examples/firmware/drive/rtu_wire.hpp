// SPDX-License-Identifier: MIT
// RtuWire: a slave's end of a Modbus RTU line: the tick's interrupt collects the bytes of a request, and sends an
// answer.
#pragma once

#include "drive/rtu_frame.hpp"
#include "serial.hpp"

#include <atomic>
#include <cstdint>
#include <span>

namespace firmware {

/// Times in ticks. A byte on the line must last longer than a tick.
struct RtuTiming {
    unsigned silence = 1;  ///< what ends a frame: 3.5 characters, 1.75 ms above 19200 baud
    unsigned patience = 1; ///< for the rest of a request to this unit: shorter than any master waits for an answer
};

/// Half duplex: what comes in while a request is answered is dropped. An echo is not all of that: the UART still sends
/// its last bytes then. So an adapter must not echo.
///
/// A request ends with a silence. Adapters and computers leave gaps within frames, so one to this unit that is shorter
/// than its head says may go on for some time; what is for others ends with the first silence.
///
/// poll() belongs to the interrupt; all other functions belong to the main loop.
class RtuWire {
public:
    RtuWire(std::uint8_t unit, const RtuTiming& timing) noexcept : timing_(timing), unit_(unit) {}

    /// @param read  () -> int: a byte, Serial::nothing or Serial::lost
    /// @param write  (std::uint8_t) -> bool: false if the UART has no room now
    template <class Read, class Write>
    void poll(Read&& read, Write&& write) noexcept {
        const int byte = read();
        switch (state_.load(std::memory_order_acquire)) {
        case State::listens: listen(byte); break;
        case State::answers: break;
        case State::sends:
            if (write(reply_[sent_]) && ++sent_ == reply_size_) {
                listen_again();
            }
            break;
        }
    }

    /// Whether request() is there, for which answer() has to be called.
    [[nodiscard]] bool asked() const noexcept { return state_.load(std::memory_order_acquire) == State::answers; }
    [[nodiscard]] std::span<const std::uint8_t> request() const noexcept { return std::span(in_).first(size_); }
    /// Where the answer is written to.
    [[nodiscard]] RtuBytes& reply() noexcept { return reply_; }
    /// Sends that many bytes of reply(); 0: none. @pre asked()
    void answer(std::size_t size) noexcept {
        sent_ = 0;
        reply_size_ = size;
        if (size == 0) {
            listen_again();
        } else {
            state_.store(State::sends, std::memory_order_release);
        }
    }

private:
    enum class State : std::uint8_t { listens, answers, sends };

    void listen(int byte) noexcept {
        if (byte == Serial::nothing) {
            if (size_ > 0 || broken_) {
                wait();
            }
            return;
        }
        quiet_ = 0;
        if (byte == Serial::lost || size_ == in_.size()) {
            broken_ = true;
        } else {
            in_[size_++] = static_cast<std::uint8_t>(byte);
        }
    }
    /// A tick without a byte, behind some.
    void wait() noexcept {
        ++quiet_;
        const bool ours = !broken_ && (in_[0] == unit_ || in_[0] == rtu_broadcast);
        if (quiet_ < timing_.silence || (ours && quiet_ < timing_.patience && size_ < request_size(request()))) {
            return;
        }
        if (ours && size_ >= request_size(request())) {
            state_.store(State::answers, std::memory_order_release);
        } else {
            listen_again();
        }
    }
    void listen_again() noexcept {
        size_ = 0;
        quiet_ = 0;
        broken_ = false;
        state_.store(State::listens, std::memory_order_release);
    }

    RtuBytes in_{};
    RtuBytes reply_{};
    RtuTiming timing_;
    std::size_t size_ = 0;
    std::size_t reply_size_ = 0;
    std::size_t sent_ = 0;
    unsigned quiet_ = 0; // ticks since the last byte
    std::atomic<State> state_{State::listens};
    std::uint8_t unit_;
    bool broken_ = false; // the frame that comes in lacks a byte, or is too long
};

} // namespace firmware
