// SPDX-License-Identifier: MIT
// UsbPipe: one direction of an endpoint, with one buffer of 64 bytes. RP2040 Datasheet, 4.1.2.5; USB 2.0, 8.6
// (toggles).
#pragma once

#include "rp2040/usb_port.hpp"

#include <span>

namespace rp2040 {

/// A buffer is the controller's from send() or receive() until look() says that a packet has gone or come.
class UsbPipe {
public:
    static constexpr std::size_t packet = 64;

    /// @param kind  0: control, 2: bulk, 3: interrupt  @param buffer  its place in DPSRAM
    constexpr UsbPipe(UsbPort& port, unsigned number, std::uint32_t kind, std::uint32_t buffer) noexcept
        : port_(port), number_(number), kind_(kind), buffer_(buffer) {}

    [[nodiscard]] unsigned address() const noexcept { return number_ / 2 | (number_ % 2 != 0 ? 0U : 0x80U); }
    [[nodiscard]] bool is_free() const noexcept { return owner_ == Owner::firmware; }
    [[nodiscard]] bool is_halted() const noexcept { return halted_; }

    void send(std::span<const std::uint8_t> bytes) noexcept {
        for (std::size_t at = 0; at < bytes.size(); at += 4) {
            std::uint32_t word = 0;
            for (std::size_t i = at + 4 < bytes.size() ? at + 4 : bytes.size(); i > at; --i) {
                word = word << 8 | bytes[i - 1];
            }
            port_.write(DPSRAM + buffer_ + at, word);
        }
        give(bytes.size());
    }
    /// The next packet may come: until then the host has to wait.
    void receive() noexcept { give(packet); }
    /// How many bytes of the packet that has come are left to take().
    [[nodiscard]] std::size_t size() const noexcept { return size_ - taken_; }
    std::uint8_t take() noexcept {
        word_ = taken_ % 4 == 0 ? port_.read(DPSRAM + buffer_ + taken_) : word_ >> 8;
        ++taken_;
        return static_cast<std::uint8_t>(word_);
    }

    /// Of endpoints 1 and above: there is one from here on, or none.
    void enable(bool on) noexcept {
        restart(false);
        const std::uint32_t set = endpoint_enable | endpoint_each_buffer | kind_ << 26 | buffer_;
        port_.write(ENDPOINT_CONTROL + 4 * number_, on ? set : 0);
    }
    /// No packet is to go or come, nor has one come. The next one is DATA0 or DATA1.
    void restart(bool data1) noexcept {
        owner_ = Owner::firmware;
        halted_ = false;
        data1_ = data1;
        size_ = taken_ = 0;
        control(0);
    }
    /// The host is refused until clear_halt() or restart(), on endpoint 0 only with EP_STALL_ARM.
    void halt() noexcept {
        halted_ = true;
        control(0);
        port_.settle();
        control(buffer_stall);
    }
    /// The packet that was to go or come still is, as DATA0.
    void clear_halt() noexcept {
        halted_ = data1_ = false;
        control(0);
        if (owner_ == Owner::controller) {
            give(last_ & buffer_length);
        }
    }
    /// The packet that is to go is not, unless it is on its way: look() knows that with the next event of the bus.
    void revoke() noexcept {
        if (!is_free() && !halted_) {
            control(last_); // a single bit changes: whenever the controller reads, it reads one or the other
        }
        owner_ = owner_ == Owner::controller ? Owner::unknown : owner_;
    }
    /// @param buffers  BUFF_STATUS  @param event  has come since the last revoke()
    /// @return whether a packet has gone or come
    bool look(std::uint32_t buffers, bool event = false) noexcept {
        const bool done = owner_ != Owner::firmware && (buffers >> number_ & 1) != 0;
        if (done) {
            data1_ = !data1_;
            size_ = port_.read(BUFFER_CONTROL + 4 * number_) & buffer_length;
            taken_ = 0;
        }
        owner_ = done || (owner_ == Owner::unknown && event) ? Owner::firmware : owner_;
        return done;
    }

private:
    enum class Owner : std::uint8_t { firmware, controller, unknown };
    void control(std::uint32_t value) noexcept { port_.write(BUFFER_CONTROL + 4 * number_, value); }
    void give(std::size_t size) noexcept {
        last_ = static_cast<std::uint32_t>(size) | (number_ % 2 == 0 ? buffer_full : 0) | (data1_ ? buffer_data1 : 0);
        owner_ = Owner::controller;
        taken_ = size_; // of the last packet nothing is left
        if (!halted_) { // else clear_halt() gives it
            control(last_);
            port_.settle(); // the controller must not see that bit before the others
            control(last_ | buffer_available);
        }
    }

    UsbPort& port_;
    unsigned number_;
    std::uint32_t kind_;
    std::uint32_t buffer_;
    std::uint32_t last_ = 0; // what was given
    std::size_t size_ = 0;
    std::size_t taken_ = 0;
    std::uint32_t word_ = 0; // the rest of a word of it
    Owner owner_ = Owner::firmware;
    bool halted_ = false;
    bool data1_ = false;
};

} // namespace rp2040
