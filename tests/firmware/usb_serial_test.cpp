// SPDX-License-Identifier: MIT
#include "usb_host.hpp"

#include "support/catch.hpp"
#include "support/rounds.hpp"

namespace {

struct Line {
    explicit Line(std::uint64_t seed) : random(seed) { serial.start(); }
    ~Line() { CHECK(controller.misuse.empty()); }
    Line(const Line&) = delete;
    Line& operator=(const Line&) = delete;

    std::mt19937_64 random;
    UsbController controller{};
    rp2040::UsbSerial serial{controller};
    UsbHost host{controller, serial, random};

    Bytes read_all() {
        Bytes out;
        for (int byte = serial.read_byte(); byte >= 0; byte = serial.read_byte()) {
            out.push_back(static_cast<std::uint8_t>(byte));
        }
        return out;
    }
    void write_all(const Bytes& bytes) {
        for (const std::uint8_t byte : bytes) {
            REQUIRE(serial.write_byte(byte));
        }
    }
    /// What the host reads while it asks so often; empty packets as 0x100.
    std::vector<int> host_reads(int turns) {
        std::vector<int> out;
        for (int i = 0; i < turns; ++i) {
            Bytes packet;
            if (host.read(packet)) {
                out.insert(out.end(), packet.begin(), packet.end());
                if (packet.size() < 64) {
                    out.push_back(0x100);
                }
            }
            host.turn();
        }
        return out;
    }
};

Bytes series(std::size_t size, unsigned from = 0) {
    Bytes out(size);
    for (std::size_t i = 0; i < size; ++i) {
        out[i] = static_cast<std::uint8_t>(from + i * 7);
    }
    return out;
}

} // namespace

TEST_CASE("UsbSerial: no byte is lost, whoever waits, and whatever handshakes are", "[usb][random]") {
    const int rounds = splinefeed_test::rounds(60);
    for (int round = static_cast<int>(splinefeed_test::first_round()); round < rounds; ++round) {
        CAPTURE(round);
        Line line(static_cast<std::uint64_t>(round));
        UsbHost& host = line.host;
        REQUIRE(host.open());
        REQUIRE(line.serial.is_open());
        host.loses_handshakes = round % 2 == 1;
        const Bytes to_send = series(2000);
        std::size_t sent = 0;
        std::size_t answered = 0;
        Bytes arrived;
        Bytes heard;
        Bytes packet = series(1 + line.random() % 64);
        bool host_stops = false;
        bool device_stops = false;
        // The bus goes on within the polls, too: a token before any access.
        const auto bus = [&] {
            if (line.random() % 3 != 0) {
                return;
            }
            if (line.random() % 2 == 0 && sent < to_send.size()) {
                const auto from = to_send.begin() + static_cast<std::ptrdiff_t>(sent);
                packet.assign(from, from + static_cast<std::ptrdiff_t>(std::min(packet.size(), to_send.size() - sent)));
                if (host.write(packet)) {
                    sent += packet.size();
                    packet.resize(line.random() % 65);
                }
            } else if (Bytes got; !host_stops && host.read(got)) {
                heard.insert(heard.end(), got.begin(), got.end());
            }
        };
        line.controller.meanwhile = bus;
        for (int i = 0; i < 40'000 && (arrived.size() < to_send.size() || heard.size() < to_send.size()); ++i) {
            host_stops = line.random() % 100 == 0 ? host.chance() : host_stops;
            device_stops = line.random() % 100 == 0 ? host.chance() : device_stops;
            host.turn();
            for (int byte = 0; !device_stops && byte >= 0 && line.random() % 100 != 0;) {
                byte = line.serial.read_byte();
                if (byte >= 0) {
                    arrived.push_back(static_cast<std::uint8_t>(byte));
                }
            }
            while (answered < to_send.size() && line.random() % 50 != 0 && line.serial.write_byte(to_send[answered])) {
                ++answered;
            }
        }
        line.controller.meanwhile = nullptr;
        REQUIRE(arrived == to_send);
        REQUIRE(heard == to_send);
    }
}

TEST_CASE("UsbSerial: a host that stops reading blocks nobody, one that is not read waits", "[usb]") {
    Line line(1);
    REQUIRE(line.host.open());
    std::size_t taken = 0;
    for (int i = 0; i < 1000; ++i) {
        line.serial.poll();
        taken += line.serial.write_byte(static_cast<std::uint8_t>(taken * 7)) ? 1 : 0;
    }
    CHECK(taken == 65); // the first went alone
    CHECK(line.serial.is_open());
    const Bytes packet = series(64);
    CHECK(line.host.write(packet));
    CHECK_FALSE(line.host.write(packet)); // NAK
    line.host.turn();
    CHECK_FALSE(line.host.write(packet));
    CHECK(line.read_all() == packet);
    CHECK(line.host.write(packet));
    std::vector<int> expected{0, 0x100};
    for (const std::uint8_t byte : series(64, 7)) {
        expected.push_back(byte);
    }
    expected.push_back(0x100); // the end of whole packets
    CHECK(line.host_reads(20) == expected);
}

TEST_CASE("UsbSerial: an empty packet ends whole ones, and comes once", "[usb]") {
    for (const std::size_t size : {1U, 63U, 64U}) {
        CAPTURE(size);
        Line line(size);
        REQUIRE(line.host.open());
        line.write_all(series(size));
        std::vector<int> expected;
        for (const std::uint8_t byte : series(size)) {
            expected.push_back(byte);
        }
        expected.push_back(0x100);
        CHECK(line.host_reads(30) == expected);
        CHECK(line.host.write({})); // one of the host's is nothing
        line.host.turn();
        CHECK(line.serial.read_byte() == -1);
        CHECK(line.host.write({9}));
        line.host.turn();
        CHECK(line.serial.read_byte() == 9);
    }
}

TEST_CASE("UsbSerial: the next sender reads nothing of the last one's, and nothing of his is done", "[usb][random]") {
    const int rounds = splinefeed_test::rounds(400);
    for (int round = static_cast<int>(splinefeed_test::first_round()); round < rounds; ++round) {
        CAPTURE(round);
        Line line(static_cast<std::uint64_t>(round));
        UsbHost& host = line.host;
        REQUIRE(host.open());
        CHECK(line.serial.sessions() == 1);
        Bytes packet;
        for (std::uint32_t session = 1; session < 6; ++session) {
            // The session's number is in all of its bytes.
            const Bytes mine(1 + line.random() % 64, static_cast<std::uint8_t>(session));
            const auto is_mine = [session](const Bytes& bytes) {
                return std::all_of(bytes.begin(), bytes.end(),
                                   [session](std::uint8_t byte) { return byte == session; });
            };
            for (std::uint64_t i = line.random() % 20; i > 0; --i) {
                for (std::uint64_t bytes = line.random() % 4 == 0 ? 64 : line.random() % 4; bytes > 0; --bytes) {
                    (void)line.serial.write_byte(static_cast<std::uint8_t>(session));
                }
                switch (line.random() % 4) {
                case 0: (void)host.write(mine); break;
                case 1: REQUIRE((!host.read(packet) || is_mine(packet))); break;
                case 2: REQUIRE(is_mine(line.read_all())); break;
                default: host.turn(); break;
                }
            }
            // The host still reads while it closes, until it has heard that the port is closed.
            line.controller.meanwhile = [&] {
                if (line.random() % 3 == 0) {
                    REQUIRE((!host.read(packet) || is_mine(packet)));
                }
            };
            REQUIRE(host.set_dtr(false));
            line.controller.meanwhile = nullptr;
            host.turn();
            CHECK_FALSE(line.serial.is_open());
            for (int i = 0; i < 5; ++i) {
                CHECK(line.serial.write_byte(static_cast<std::uint8_t>(session))); // dropped
                CHECK_FALSE(host.read(packet));
                host.turn();
            }
            REQUIRE(host.set_dtr(true));
            host.turn();
            CHECK(line.serial.is_open());
            CHECK(line.serial.sessions() == session + 1);
            CHECK_FALSE(host.read(packet));
            CHECK(line.serial.read_byte() == -1);
            // Both ways still are in step.
            line.write_all({static_cast<std::uint8_t>(session + 1)});
            host.turn();
            host.turn();
            REQUIRE(host.read(packet));
            CHECK(packet == Bytes{static_cast<std::uint8_t>(session + 1)});
            REQUIRE(host.write(packet));
            host.turn();
            CHECK(line.read_all() == packet);
        }
    }
}

TEST_CASE("UsbSerial: what was sent before the port is closed is still read", "[usb]") {
    Line line(1);
    REQUIRE(line.host.open());
    CHECK(line.host.write(series(30)));
    REQUIRE(line.host.set_dtr(true)); // it is open already
    CHECK(line.serial.sessions() == 1);
    REQUIRE(line.host.set_dtr(false));
    CHECK(line.read_all() == series(30));
    CHECK(line.host.write(series(10))); // nobody has opened the port, but bytes are bytes
    line.host.turn();
    CHECK(line.read_all() == series(10));
}

TEST_CASE("UsbSerial: a halted pipe stalls, loses nothing and begins anew with DATA0", "[usb]") {
    Line line(3);
    UsbHost& host = line.host;
    REQUIRE(host.open());
    Bytes packet;
    line.write_all({1});
    line.host.turn();
    REQUIRE(host.read(packet)); // the next is DATA1
    line.controller.finish();
    host.turn();
    line.write_all({2});
    host.turn();
    CHECK(host.write({3}));
    host.turn();
    REQUIRE(host.control(0x0203, 0, 0x82, 0));
    REQUIRE(host.control(0x0203, 0, 0x02, 0));
    bool data1 = false;
    CHECK(line.controller.in(host.address, 2, packet, data1) == Handshake::stall);
    CHECK(line.controller.out(host.address, 2, {4}, true) == Handshake::stall);
    CHECK(line.read_all() == Bytes{3});
    line.write_all({5});
    host.turn();
    CHECK(line.controller.in(host.address, 2, packet, data1) == Handshake::stall);
    CHECK(line.controller.out(host.address, 2, {4}, true) == Handshake::stall);
    REQUIRE(host.control(0x0201, 0, 0x82, 0));
    REQUIRE(host.control(0x0201, 0, 0x02, 0));
    host.in_data1 = host.out_data1 = false;
    CHECK(line.host_reads(20) == std::vector<int>{2, 0x100, 5, 0x100});
    CHECK(host.write({4}));
    host.turn();
    CHECK(line.read_all() == Bytes{4});
    // Without a halt, too: the host begins anew.
    REQUIRE(host.control(0x0201, 0, 0x82, 0));
    REQUIRE(host.control(0x0201, 0, 0x02, 0));
    host.in_data1 = host.out_data1 = false;
    line.write_all({6});
    CHECK(line.host_reads(10) == std::vector<int>{6, 0x100});
    CHECK(host.write({7}));
    host.turn();
    CHECK(line.read_all() == Bytes{7});
}

TEST_CASE("UsbSerial: a pulled cable and a sleeping computer are no open port; what sleeps wakes up with all bytes",
          "[usb]") {
    Line line(4);
    UsbHost& host = line.host;
    REQUIRE(host.open());
    line.write_all({1, 2});
    CHECK(host.write({3}));
    line.controller.suspend();
    line.serial.poll();
    CHECK_FALSE(line.serial.is_open());
    for (int i = 0; i < 20; ++i) {
        line.serial.poll();
        CHECK_FALSE(line.serial.is_open());
    }
    line.controller.start_frame();
    line.serial.poll();
    CHECK(line.serial.is_open());
    CHECK(line.serial.sessions() == 1);
    CHECK(line.read_all() == Bytes{3});
    CHECK(line.host_reads(10) == std::vector<int>{1, 2, 0x100});
    line.controller.suspend(); // now it is pulled, and put in again
    line.serial.poll();
    CHECK_FALSE(line.serial.is_open());
    CHECK(host.write({4}));
    host.turn();
    CHECK(host.enumerate());
    CHECK(line.serial.read_byte() == -1); // of before
    CHECK(host.set_dtr(true));
    CHECK(line.serial.is_open());
    CHECK(line.serial.sessions() == 2);
}

TEST_CASE("UsbSerial: no packet is offered in the last fifth of a frame", "[usb]") {
    Line line(5);
    REQUIRE(line.host.open());
    bool data1 = false;
    Bytes packet;
    for (int poll_of_frame = 0; poll_of_frame < 5; ++poll_of_frame) {
        CAPTURE(poll_of_frame);
        line.controller.start_frame();
        for (int i = 0; i < poll_of_frame; ++i) {
            line.serial.poll();
        }
        CHECK(line.controller.in(line.host.address, 2, packet, data1) == Handshake::nak);
        line.write_all({9});
        line.serial.poll();
        const bool offered = line.controller.in(line.host.address, 2, packet, data1) == Handshake::ack;
        CHECK(offered == (poll_of_frame < 4));
        line.controller.start_frame();
        line.serial.poll();
        if (!offered) {
            CHECK(line.controller.in(line.host.address, 2, packet, data1) == Handshake::ack);
        }
        line.controller.finish();
        line.serial.poll();
    }
}
