// SPDX-License-Identifier: MIT
// UsbHost: what a computer does with a serial port of USB: it enumerates, opens, writes and reads. USB 2.0, chapters 8
// and 9.
#pragma once

#include "rp2040/usb_serial.hpp"

#include "usb_controller.hpp"

#include <random>

struct UsbHost {
    UsbController& controller;
    rp2040::UsbSerial& serial;
    std::mt19937_64& random;
    unsigned address = 0;
    bool in_data1 = false; ///< the next packet of endpoint 2
    bool out_data1 = false;
    bool loses_handshakes = false;
    bool stalled = false; ///< the last control transfer

    /// A turn of the firmware, or two within a transaction, and now and then a new frame.
    void turn() {
        serial.poll();
        if (random() % 3 == 0) {
            serial.poll();
        }
        if (random() % 5 == 0) {
            controller.start_frame();
        }
    }
    bool chance() { return random() % 2 == 0; }

    /// A transfer of endpoint 0, as long as the device lets it wait. @return what came; nothing: STALL, or no answer in
    /// time
    std::optional<Bytes> control(std::uint16_t request, std::uint16_t value, std::uint16_t index, std::uint16_t length,
                                 const Bytes& data = {}) {
        stalled = false;
        if (!setup(request, value, index, length)) {
            return std::nullopt;
        }
        Bytes got;
        bool data1 = true;
        if (length > 0 && (request & 0x8000) != 0) {
            for (bool more = true; more;) {
                Bytes packet;
                if (!poll_in(0, packet, data1)) {
                    return std::nullopt;
                }
                data1 = !data1;
                got.insert(got.end(), packet.begin(), packet.end());
                more = packet.size() == 64 && got.size() < length;
            }
            return poll_out(0, {}, true) ? std::optional(got) : std::nullopt;
        }
        if (length > 0 && !poll_out(0, data, true)) {
            return std::nullopt;
        }
        Bytes status;
        return poll_in(0, status, true) && status.empty() ? std::optional(got) : std::nullopt;
    }
    bool is_refused(std::uint16_t request, std::uint16_t value, std::uint16_t index, std::uint16_t length,
                    const Bytes& data = {}) {
        return !control(request, value, index, length, data) && stalled;
    }
    bool setup(std::uint16_t request, std::uint16_t value, std::uint16_t index, std::uint16_t length) {
        const auto low = [](unsigned word) {
            return static_cast<std::uint8_t>(word);
        };
        return controller.setup(address, {low(request >> 8), low(request), low(value), low(value >> 8), low(index),
                                          low(index >> 8), low(length), low(length >> 8)}) == Handshake::ack;
    }
    /// Asks until there is a packet with this toggle; the other one is a packet that the host has had.
    bool poll_in(unsigned endpoint, Bytes& packet, bool data1) {
        for (int i = 0; i < 50; ++i) {
            bool is_data1 = false;
            const bool acked = !loses_handshakes || random() % 4 != 0;
            const Handshake answer = controller.in(address, endpoint, packet, is_data1, acked);
            if (answer == Handshake::stall || answer == Handshake::none) {
                stalled = answer == Handshake::stall;
                return false;
            }
            if (answer == Handshake::ack && is_data1 == data1) {
                controller.finish();
                return true;
            }
            turn();
        }
        return false;
    }
    bool poll_out(unsigned endpoint, const Bytes& packet, bool data1) {
        for (int i = 0; i < 50; ++i) {
            const Handshake answer = controller.out(address, endpoint, packet, data1);
            if (answer == Handshake::stall || answer == Handshake::none) {
                stalled = answer == Handshake::stall;
                return false;
            }
            if (answer == Handshake::ack && (!loses_handshakes || random() % 4 != 0)) {
                return true;
            }
            turn();
        }
        return false;
    }

    void reset() {
        controller.reset_bus();
        turn();
        address = 0;
        in_data1 = out_data1 = false;
    }
    bool configure() {
        in_data1 = out_data1 = false;
        return control(0x0009, 1, 0, 0).has_value();
    }
    bool enumerate() {
        reset();
        if (!control(0x0005, 5, 0, 0)) {
            return false;
        }
        turn();
        address = 5;
        return configure();
    }
    bool set_dtr(bool here) { return control(0x2122, here ? 3 : 2, 0, 0).has_value(); }
    bool open() { return enumerate() && set_dtr(true); }

    /// One token each. @return whether a packet has gone or come
    bool write(const Bytes& packet) {
        const bool taken = controller.out(address, 2, packet, out_data1) == Handshake::ack;
        const bool heard = taken && (!loses_handshakes || random() % 4 != 0);
        out_data1 = out_data1 != heard;
        return heard;
    }
    bool read(Bytes& packet) {
        bool data1 = false;
        const bool acked = !loses_handshakes || random() % 4 != 0;
        const bool here = controller.in(address, 2, packet, data1, acked) == Handshake::ack && data1 == in_data1;
        in_data1 = in_data1 != here;
        return here;
    }
};
