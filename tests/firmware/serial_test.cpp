// SPDX-License-Identifier: MIT
#include "serial.hpp"

#include "support/catch.hpp"

#include <deque>
#include <random>
#include <string>

using firmware::Serial;

namespace {

/// A UART with a FIFO of 16 bytes, and a host that sends a byte in each tick until it has heard of a pause: `late`
/// bytes later.
struct Line {
    std::string to_send;
    std::size_t sent = 0;
    std::deque<int> fifo{};
    std::deque<bool> pauses{}; // on their way to the host
    std::size_t late = 0;
    bool paused = false;
    bool overrun = false;
    std::string heard{};

    void tick(Serial& serial) {
        pauses.push_back(pauses.empty() ? paused : pauses.back());
        if (pauses.size() > late) {
            paused = pauses.front();
            pauses.pop_front();
        }
        if (!paused && sent < to_send.size()) {
            if (fifo.size() < 16) {
                fifo.push_back(static_cast<unsigned char>(to_send[sent]));
            } else {
                overrun = true;
            }
            ++sent;
        }
        serial.poll(
            [this] {
                if (overrun) {
                    overrun = false;
                    return Serial::lost;
                }
                if (fifo.empty()) {
                    return Serial::nothing;
                }
                const int byte = fifo.front();
                fifo.pop_front();
                return byte;
            },
            [this](std::uint8_t byte) {
                if (byte == 0x11 || byte == 0x13) {
                    (pauses.empty() ? paused : pauses.back()) = byte == 0x13;
                } else {
                    heard += static_cast<char>(byte);
                }
                return true;
            });
    }
};

std::string text(std::size_t size) {
    std::string out;
    for (std::size_t i = 0; out.size() < size; ++i) {
        out += std::to_string(i) + '\n';
    }
    return out;
}

} // namespace

TEST_CASE("Serial: a host that obeys XOFF loses nothing, however slowly lines are read", "[serial]") {
    for (const std::size_t late : {0U, 1U, 16U, 64U, 120U}) {
        CAPTURE(late);
        std::mt19937_64 random(late);
        Serial serial;
        Line line{.to_send = text(20'000), .late = late};
        std::string read;
        std::uint64_t busy = 0;
        for (int i = 0; i < 2'000'000 && read.size() < line.to_send.size(); ++i) {
            line.tick(serial);
            if (busy > 0) {
                --busy; // the planner's turn
                continue;
            }
            char c = 0;
            while (serial.pop(c)) {
                read += c;
                if (c == '\n' && random() % 8 == 0) {
                    busy = random() % 2000;
                    break;
                }
            }
        }
        CHECK(read == line.to_send);
        CHECK_FALSE(serial.bytes_lost());
    }
}

TEST_CASE("Serial: what the UART loses is reported", "[serial]") {
    Serial serial;
    Line line{.to_send = text(1000), .late = 100'000}; // it never hears of a pause
    for (int i = 0; i < 2000; ++i) {
        line.tick(serial);
    }
    char c = 0;
    while (serial.pop(c)) {
    }
    for (int i = 0; i < 20; ++i) {
        line.tick(serial);
    }
    CHECK(serial.bytes_lost());
    CHECK_FALSE(serial.bytes_lost());
}

TEST_CASE("Serial: requests act at once and are in no line", "[serial]") {
    Serial serial;
    Line line{.to_send = "1,2?,3\n!~\x18"};
    std::string read;
    for (int i = 0; i < 20; ++i) {
        line.tick(serial);
    }
    char c = 0;
    while (serial.pop(c)) {
        read += c;
    }
    CHECK(read == "1,2,3\n\x18"); // the mark of where it came
    for (const auto request :
         {Serial::Request::status, Serial::Request::hold, Serial::Request::resume, Serial::Request::abort}) {
        CHECK(serial.asked(request));
        CHECK_FALSE(serial.asked(request));
    }
}
