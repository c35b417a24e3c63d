// SPDX-License-Identifier: MIT
#include "controller/byte_wire.hpp"

#include "support/catch.hpp"

#include <deque>
#include <string>

using firmware::ByteWire;
using firmware::Serial;

namespace {

/// A UART that has these bytes, and takes one in a tick.
struct SenderWire {
    std::deque<int> in;
    std::string out;
    bool ready = true;

    bool poll(ByteWire& line) {
        return line.poll(
            [this] {
                const int byte = in.empty() ? Serial::nothing : in.front();
                if (!in.empty()) {
                    in.pop_front();
                }
                return byte;
            },
            [this](std::uint8_t byte) {
                out += ready ? std::string(1, static_cast<char>(byte)) : "";
                return ready;
            });
    }
};

std::string taken(ByteWire& line) {
    std::array<char, 2000> bytes{};
    return {bytes.data(), line.take(bytes)};
}

} // namespace

TEST_CASE("ByteWire: bytes come and go in order, and a reset is told at once", "[byte_wire]") {
    ByteWire line;
    SenderWire wire;
    for (const int byte : {0x47, 0x85, 0x18, 0x31}) {
        wire.in.push_back(byte);
    }
    CHECK_FALSE(line.has_come());
    CHECK_FALSE(wire.poll(line));
    CHECK(line.has_come());
    CHECK_FALSE(wire.poll(line));
    CHECK(wire.poll(line));
    CHECK_FALSE(wire.poll(line));
    CHECK(taken(line) == "G\x85\x18" + std::string("1"));
    line.send(std::string_view("ok"));
    wire.ready = false;
    wire.poll(line);
    CHECK(wire.out.empty());
    wire.ready = true;
    for (int i = 0; i < 4; ++i) {
        wire.poll(line);
    }
    CHECK(wire.out == "ok");
}

TEST_CASE("ByteWire: all that a sender may have sent fits, and what a UART loses is told", "[byte_wire]") {
    ByteWire line;
    SenderWire wire;
    wire.in.assign(1024 + 32, 'x');
    for (int i = 0; i < 1024 + 32; ++i) {
        wire.poll(line);
    }
    CHECK(taken(line).size() == 1024 + 32);
    CHECK_FALSE(line.bytes_lost());
    wire.in.push_back(Serial::lost);
    wire.poll(line);
    CHECK(line.bytes_lost());
    CHECK_FALSE(line.bytes_lost());
}
