// SPDX-License-Identifier: MIT
// Faults of the line, as a client sees them that knows nothing of ours: bytes and when they come.
#include "drive_process.hpp"
#include "modbus/scripted_peer.hpp"
#include "support/catch.hpp"

#include <chrono>
#include <termios.h>

using splinefeed::test::DriveProcess;
using splinefeed::test::Tool;
using splinefeed_test::Bytes;
using splinefeed_test::with_crc;

namespace {

constexpr int patience_ms = 5000;

/// A connection to the drive: bytes out, and what came within a time.
class Wire {
public:
    explicit Wire(int port) : line_(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in there{};
        there.sin_family = AF_INET;
        there.sin_port = htons(static_cast<std::uint16_t>(port));
        there.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        REQUIRE(connect(line_, reinterpret_cast<const sockaddr*>(&there), sizeof(there)) == 0);
    }
    Wire(const Wire&) = delete;
    Wire& operator=(const Wire&) = delete;
    ~Wire() { close(line_); }

    void put(const Bytes& bytes) const {
        REQUIRE(write(line_, bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size()));
    }
    /// Until nothing has come for so long, or there are `most` bytes. The first may take longer.
    [[nodiscard]] Bytes take(int silence_ms, std::size_t most = 256) const {
        Bytes out;
        pollfd ready{line_, POLLIN, 0};
        while (out.size() < most && poll(&ready, 1, out.empty() ? first_ms : silence_ms) == 1) {
            std::uint8_t byte = 0;
            if (read(line_, &byte, 1) != 1) {
                break;
            }
            out.push_back(byte);
        }
        return out;
    }
    int first_ms = patience_ms;

private:
    int line_;
};

/// Reads one register of the unit: by TCP with this transaction.
Bytes tcp_read(std::uint8_t transaction, std::uint8_t unit = 1) {
    return {0, transaction, 0, 0, 0, 6, unit, 3, 0, 0, 0, 1};
}
const Bytes answer{0, 1, 0, 0, 0, 5, 1, 3, 2, 0x53, 0x46};

} // namespace

TEST_CASE("line faults: a reply breaks off, drips, comes late, and none comes while the drive is mute",
          "[drive][process][faults]") {
    const Tool tool;
    {
        DriveProcess drive(tool, "--listen tcp://127.0.0.1:0 --faults short=1,seed=1");
        const Wire wire(drive.port());
        wire.put(tcp_read(1));
        const Bytes got = wire.take(100);
        CHECK_FALSE(got.empty());
        CHECK(got.size() < answer.size());
        CHECK(std::equal(got.begin(), got.end(), answer.begin()));
    }
    for (const char* fault : {"drip=20:1", "delay=200:1", "late=1:1,delay=200:1"}) {
        CAPTURE(fault);
        DriveProcess drive(tool, std::string("--listen tcp://127.0.0.1:0 --faults seed=1,") + fault);
        const Wire wire(drive.port());
        const auto began = std::chrono::steady_clock::now();
        wire.put(tcp_read(1));
        CHECK(wire.take(patience_ms, answer.size()) == answer);
        CHECK(std::chrono::steady_clock::now() - began >= std::chrono::milliseconds(200));
    }
    DriveProcess drive(tool, "--listen tcp://127.0.0.1:0 --faults mute-at=2:300");
    Wire wire(drive.port());
    const auto asks = [&](std::uint8_t transaction) {
        wire.put(tcp_read(transaction));
        return !wire.take(50).empty();
    };
    CHECK(asks(1));
    wire.first_ms = 100;
    const auto began = std::chrono::steady_clock::now();
    CHECK_FALSE(asks(2));
    std::uint8_t transaction = 2;
    while (!asks(++transaction) && transaction < 200) {
    }
    CHECK(std::chrono::steady_clock::now() - began >= std::chrono::milliseconds(300));
}

TEST_CASE("line faults: a flood, and what another exchange left, on TCP", "[drive][process][faults]") {
    const Tool tool;
    {
        DriveProcess drive(tool, "--listen tcp://127.0.0.1:0 --faults flood@0:5000");
        const Wire wire(drive.port());
        CHECK(wire.take(patience_ms, 20'000) == Bytes(20'000, 0x55));
    }
    DriveProcess drive(tool, "--listen tcp://127.0.0.1:0 --faults foreign=1,seed=1");
    const Wire wire(drive.port());
    wire.put(tcp_read(1));
    CHECK(wire.take(patience_ms, 2 * answer.size()).size() == 2 * answer.size());
    wire.put(tcp_read(2));
    const Bytes both = wire.take(patience_ms, 2 * answer.size());
    CHECK(Bytes(both.begin(), both.begin() + 11) == answer); // the first transaction again
    CHECK(both[12] == 2);
}

TEST_CASE("line faults: a drive on TCP answers to its own number, and to those of the device at the address",
          "[drive][process][faults]") {
    const Tool tool;
    DriveProcess drive(tool, "--listen 'tcp://127.0.0.1:0?unit=7'");
    CHECK(drive.line().find("?unit=7, profile") != std::string::npos);
    Wire wire(drive.port());
    for (const std::uint8_t unit : {std::uint8_t{7}, std::uint8_t{255}, std::uint8_t{0}}) {
        wire.put(tcp_read(1, unit));
        CHECK(wire.take(20, answer.size()).size() == answer.size());
    }
    wire.first_ms = 200;
    wire.put(tcp_read(1, 1));
    CHECK(wire.take(20).empty());
    wire.put(tcp_read(1, 7));
    CHECK(wire.take(20).size() == answer.size());
}

TEST_CASE("line faults: an echo and another drive's answer, on a serial line", "[drive][process][faults]") {
    const Tool tool;
    const int line = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
    REQUIRE((line >= 0 && grantpt(line) == 0 && unlockpt(line) == 0));
    const std::string device = ptsname(line);
    DriveProcess drive(tool, "--listen 'rtu://" + device + "?baud=115200&pace=off' --faults echo=1,foreign=1,seed=1");
    const Bytes request = with_crc({1, 3, 0, 0, 0, 1});
    REQUIRE(write(line, request.data(), request.size()) == static_cast<ssize_t>(request.size()));
    Bytes expected = request;
    for (const Bytes& frame : {with_crc({2, 0x83, 6}), with_crc({1, 3, 2, 0x53, 0x46})}) {
        expected.insert(expected.end(), frame.begin(), frame.end());
    }
    Bytes got;
    pollfd ready{line, POLLIN, 0};
    while (got.size() < expected.size() && poll(&ready, 1, patience_ms) == 1) {
        std::uint8_t byte = 0;
        REQUIRE(read(line, &byte, 1) == 1);
        got.push_back(byte);
    }
    CHECK(got == expected);
    close(line);
}
