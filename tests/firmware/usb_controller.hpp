// SPDX-License-Identifier: MIT
// UsbController: the RP2040's USB controller as its datasheet (4.1.2.6) tells of it, with a bus on the other side. What
// no program may do to it is in `misuse`.
#pragma once

#include "rp2040/usb_port.hpp"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

using Bytes = std::vector<std::uint8_t>;

enum class Handshake { ack, nak, stall, none };

class UsbController final : public rp2040::UsbPort {
public:
    std::function<void()> meanwhile; ///< called before each access: the bus does not wait
    std::string misuse;

    [[nodiscard]] std::uint32_t read(std::uintptr_t address) const noexcept override {
        return const_cast<UsbController*>(this)->read_now(address);
    }
    void write(std::uintptr_t address, std::uint32_t value) noexcept override {
        pass();
        if (address == rp2040::RESETS_SET || address == rp2040::RESETS_CLR) {
            expect(value == 1U << 24, "another block is reset");
            registers_ = {};
            is_reset_ = address == rp2040::RESETS_SET;
            return;
        }
        expect(!is_reset_, "written in reset");
        if (std::uint32_t* const word = memory(address)) {
            write_memory(address - rp2040::DPSRAM, *word, value);
            return;
        }
        std::uint32_t& word = reg(address);
        if (address == rp2040::SIE_STATUS || address == rp2040::BUFF_STATUS) {
            word &= ~value;
        } else {
            word = value;
        }
    }
    void settle() noexcept override { settled_ = true; }

    /// The bus. What is sent to another address is nobody's.
    Handshake setup(unsigned address, const std::array<std::uint8_t, 8>& packet) {
        finish();
        if (!hears(address)) {
            return Handshake::none;
        }
        for (std::size_t i = 0; i < 8; ++i) {
            set_byte(i, packet[i]);
        }
        reg(rp2040::EP_STALL_ARM) = 0;
        reg(rp2040::SIE_STATUS) |= rp2040::sie_setup_rec;
        return Handshake::ack;
    }
    /// The packet's bytes and toggle. It is over at the next transaction, or at finish(). `acked`: the host's answer
    /// arrives.
    Handshake in(unsigned address, unsigned endpoint, Bytes& bytes, bool& data1, bool acked = true) {
        finish();
        const std::uint32_t control = control_of(2 * endpoint);
        if (!hears(address) || !is_enabled(2 * endpoint)) {
            return Handshake::none;
        }
        if (stalls(2 * endpoint, control)) {
            return Handshake::stall;
        }
        if ((control & (rp2040::buffer_available | rp2040::buffer_full)) !=
            (rp2040::buffer_available | rp2040::buffer_full)) {
            return Handshake::nak;
        }
        bytes.clear();
        for (std::size_t i = 0; i < (control & rp2040::buffer_length); ++i) {
            bytes.push_back(byte_at(buffer_of(2 * endpoint) + i));
        }
        data1 = (control & rp2040::buffer_data1) != 0;
        if (acked) {
            in_flight_ = {2 * endpoint, control};
        }
        return Handshake::ack;
    }
    Handshake out(unsigned address, unsigned endpoint, const Bytes& bytes, bool data1) {
        finish();
        const unsigned pipe = 2 * endpoint + 1;
        const std::uint32_t control = control_of(pipe);
        if (!hears(address) || !is_enabled(pipe)) {
            return Handshake::none;
        }
        if (stalls(pipe, control)) {
            return Handshake::stall;
        }
        if ((control & rp2040::buffer_available) == 0 || (control & rp2040::buffer_full) != 0) {
            return Handshake::nak;
        }
        if (((control & rp2040::buffer_data1) != 0) != data1) { // the host has missed an acknowledgement
            return Handshake::ack;
        }
        if (bytes.size() > (control & rp2040::buffer_length)) {
            misuse = "no room for a packet";
        }
        for (std::size_t i = 0; i < bytes.size(); ++i) {
            set_byte(buffer_of(pipe) + i, bytes[i]);
        }
        in_flight_ = {pipe, static_cast<std::uint32_t>(bytes.size()) | rp2040::buffer_full |
                                (control & rp2040::buffer_data1)};
        finish();
        return Handshake::ack;
    }
    /// The transaction on the bus is over.
    void finish() {
        if (in_flight_) {
            const auto [pipe, control] = *in_flight_;
            in_flight_.reset();
            const std::uint32_t keeps =
                rp2040::buffer_data1 | rp2040::buffer_length | ((pipe & 1) != 0 ? rp2040::buffer_full : 0);
            control_of(pipe) = control & keeps;
            if (pipe < 2 ? (reg(rp2040::SIE_CTRL) & rp2040::sie_ep0_int_1buf) != 0
                         : (endpoint_control(pipe) & rp2040::endpoint_each_buffer) != 0) {
                reg(rp2040::BUFF_STATUS) |= 1U << pipe;
            }
        }
    }
    void reset_bus() {
        in_flight_.reset();
        reg(rp2040::SIE_STATUS) |= rp2040::sie_bus_reset;
    }
    void start_frame() {
        finish();
        reg(rp2040::SOF_RD) = (reg(rp2040::SOF_RD) + 1) & 0x7ff;
    }
    void suspend() {
        finish();
        reg(rp2040::SIE_STATUS) |= rp2040::sie_suspended;
    }
    [[nodiscard]] bool is_attached() { return (reg(rp2040::SIE_CTRL) >> 16 & reg(rp2040::MAIN_CTRL) & 1) != 0; }
    [[nodiscard]] unsigned address() { return reg(rp2040::ADDR_ENDP); }

private:
    void pass() {
        if (meanwhile) {
            const auto now = std::move(meanwhile); // not within itself
            meanwhile = nullptr;
            now();
            meanwhile = now;
        }
    }
    void expect(bool good, const char* what) {
        if (!good) {
            misuse = what;
        }
    }
    std::uint32_t read_now(std::uintptr_t address) {
        pass();
        if (address == rp2040::RESET_DONE) {
            return is_reset_ ? 0 : 1U << 24;
        }
        if (const std::uint32_t* const word = memory(address)) {
            const std::size_t at = address - rp2040::DPSRAM;
            for (unsigned pipe = 3; at >= 0x100 && pipe < 32; pipe += 2) {
                expect(buffer_of(pipe) != (at & ~std::size_t{63}) ||
                           (control_of(pipe) & rp2040::buffer_available) == 0 || !is_enabled(pipe),
                       "a packet is read that may still come");
            }
            return *word;
        }
        return reg(address);
    }
    void write_memory(std::size_t at, std::uint32_t& word, std::uint32_t value) {
        constexpr std::uint32_t last = rp2040::buffer_available | rp2040::buffer_stall;
        if (at >= 0x80 && at < 0x100 && (value & last) != 0) {
            expect(word == (value & ~last) && settled_ && written_ == at,
                   "given to the controller at once with the rest");
        }
        for (unsigned pipe = 0; at >= 0x100 && pipe < 32; pipe += 2) {
            expect(buffer_of(pipe) != (at & ~std::size_t{63}) || (control_of(pipe) & rp2040::buffer_available) == 0,
                   "a packet is written that may be on its way");
        }
        word = value;
        written_ = at;
        settled_ = false;
    }
    [[nodiscard]] std::uint32_t* memory(std::uintptr_t address) {
        const bool here = address >= rp2040::DPSRAM && address < rp2040::DPSRAM + 4096 && address % 4 == 0;
        return here ? &memory_[(address - rp2040::DPSRAM) / 4] : nullptr;
    }
    [[nodiscard]] std::uint32_t& reg(std::uintptr_t address) {
        const std::size_t at = address - rp2040::USBCTRL;
        expect(at < 0x9c && at % 4 == 0, "there is no such register");
        return registers_[at / 4 % registers_.size()];
    }
    [[nodiscard]] std::uint32_t& control_of(unsigned pipe) { return memory_[0x80 / 4 + pipe]; }
    [[nodiscard]] std::uint32_t endpoint_control(unsigned pipe) { return memory_[pipe]; } // of EP1 and above
    [[nodiscard]] bool is_enabled(unsigned pipe) { return pipe < 2 || endpoint_control(pipe) >> 31 != 0; }
    [[nodiscard]] std::size_t buffer_of(unsigned pipe) { return pipe < 2 ? 0x100 : endpoint_control(pipe) & 0xffc0; }
    [[nodiscard]] bool stalls(unsigned pipe, std::uint32_t control) {
        return (control & rp2040::buffer_stall) != 0 && (pipe >= 2 || (reg(rp2040::EP_STALL_ARM) >> pipe & 1) != 0);
    }
    [[nodiscard]] bool hears(unsigned address) { return is_attached() && address == this->address(); }
    [[nodiscard]] std::uint8_t byte_at(std::size_t at) {
        return static_cast<std::uint8_t>(memory_[at / 4] >> 8 * (at % 4));
    }
    void set_byte(std::size_t at, std::uint8_t byte) {
        std::uint32_t& word = memory_[at / 4];
        word = (word & ~(0xffU << 8 * (at % 4))) | std::uint32_t{byte} << 8 * (at % 4);
    }

    struct InFlight {
        unsigned pipe;
        std::uint32_t control;
    };
    std::array<std::uint32_t, 1024> memory_ = noise();
    std::array<std::uint32_t, 39> registers_{};
    std::optional<InFlight> in_flight_;
    std::size_t written_ = 0;
    bool settled_ = false;
    bool is_reset_ = false;

    static std::array<std::uint32_t, 1024> noise() {
        std::array<std::uint32_t, 1024> words{};
        std::uint32_t state = 1;
        for (std::uint32_t& word : words) {
            word = state = state * 1664525 + 1013904223;
        }
        return words;
    }
};
