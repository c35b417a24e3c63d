// SPDX-License-Identifier: MIT
#include "drive_bench.hpp"

#include <random>
#include <support/catch.hpp>

using namespace firmware;

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes exception(std::uint8_t function, std::uint8_t code) {
    return with_crc({1, static_cast<std::uint8_t>(function | 0x80U), code});
}

} // namespace

TEST_CASE("RTU frame: the CRC of the specification's example", "[rtu]") {
    // MODBUS over Serial Line V1.02, 6.2.2: 02 07 gives 41 12.
    CHECK(with_crc({0x02, 0x07}) == Bytes{0x02, 0x07, 0x41, 0x12});
}

TEST_CASE("RTU frame: reads what the map holds", "[rtu]") {
    DriveBench bench;
    CHECK(bench.ask(read_request(0, 2)) == with_crc({1, 3, 4, 0x53, 0x46, 0, 1}));
    CHECK(bench.ask(read_request(8, 3)) == with_crc({1, 3, 6, 0x12, 0x34, 0x12, 0x34, 0x56, 0x78}));
    CHECK(bench.ask(read_request(0, 11)).size() == 5 + 22);
}

TEST_CASE("RTU frame: writes one register, and several", "[rtu]") {
    DriveBench bench;
    const Bytes one = with_crc({1, 6, 0, 0x11, 0, 250});
    CHECK(bench.ask(one) == one);
    CHECK(bench.drive.configuration().stop_reserve_ms == 250);
    CHECK(bench.ask(with_crc({1, 16, 0, 0x10, 0, 2, 4, 0x03, 0xE8, 0, 100})) == with_crc({1, 16, 0, 0x10, 0, 2}));
    CHECK(bench.drive.configuration().watchdog_ms == 1000);
    CHECK(bench.drive.configuration().stop_reserve_ms == 100);
}

TEST_CASE("RTU frame: exceptions", "[rtu]") {
    DriveBench bench;
    CHECK(bench.ask(with_crc({1, 4, 0, 0, 0, 1})) == exception(4, 1)); // not in the map: exception 1
    CHECK(bench.ask(with_crc({1, 0x2B})) == exception(0x2B, 1));
    CHECK(bench.ask(read_request(0, 12)) == exception(3, 2)); // across the end of a table
    CHECK(bench.ask(read_request(0x100, 1)) == exception(3, 2));
    CHECK(bench.ask(read_request(0xFFFF, 125)) == exception(3, 2));
    CHECK(bench.ask(read_request(0, 0)) == exception(3, 3));
    CHECK(bench.ask(read_request(0, 126)) == exception(3, 3));
    CHECK(bench.ask(with_crc({1, 3, 0, 0, 0})) == exception(3, 3));
    CHECK(bench.ask(with_crc({1, 6, 0, 0, 0, 1})) == exception(6, 2)); // read only
    CHECK(bench.ask(with_crc({1, 6, 0, 0x11, 0, 0})) == exception(6, 3));
    CHECK(bench.ask(with_crc({1, 6, 0, 0x11, 0x27, 0x11})) == exception(6, 3)); // 10001 ms
    CHECK(bench.ask(with_crc({1, 16, 0, 0x10, 0, 2, 2, 0, 1})) == exception(16, 3));
    CHECK(bench.ask(with_crc({1, 16, 0, 0x10, 0, 1, 2, 0, 1, 0})) == exception(16, 3));
    CHECK(bench.ask(with_crc({1, 16, 1, 0, 0, 1, 2, 0, 1})) == exception(16, 3)); // no whole block
    CHECK(bench.ask(with_crc({1, 16, 1, 1, 0, 1, 2, 0, 1})) == exception(16, 2)); // not from its beginning
}

TEST_CASE("RTU frame: nothing is written if the read would be refused", "[rtu]") {
    DriveBench bench;
    CHECK(bench.ask(with_crc({1, 23, 0, 0x0B, 0, 1, 0, 0x10, 0, 1, 2, 0, 99})) == exception(23, 2));
    CHECK(bench.drive.configuration().watchdog_ms == 0);
    CHECK(bench.ask(with_crc({1, 23, 0, 0x10, 0, 1, 0, 0x10, 0, 1, 2, 0, 99})) == with_crc({1, 23, 2, 0, 99}));
}

TEST_CASE("RTU frame: another unit, all units, a wrong CRC: no answer", "[rtu]") {
    DriveBench bench;
    CHECK(bench.ask(read_request(0, 1, 2)).empty());
    CHECK(bench.ask({}).empty());
    CHECK(bench.ask({1}).empty());
    CHECK(bench.ask(with_crc({1})).empty());
    CHECK(bench.ask(with_crc({0, 6, 0, 0x10, 0, 5})).empty());
    CHECK(bench.drive.configuration().watchdog_ms == 5); // but executed
    Bytes frame = with_crc({1, 6, 0, 0x10, 0, 77});
    for (std::size_t at = 0; at < frame.size(); ++at) {
        for (unsigned bit = 0; bit < 8; ++bit) {
            frame[at] = static_cast<std::uint8_t>(frame[at] ^ 1U << bit);
            CHECK(bench.ask(frame).empty());
            frame[at] = static_cast<std::uint8_t>(frame[at] ^ 1U << bit);
        }
    }
    CHECK(bench.drive.configuration().watchdog_ms == 5);
}

TEST_CASE("RTU frame: how long a request is, from its beginning", "[rtu]") {
    for (const Bytes& whole :
         {read_request(0, 1), with_crc({1, 6, 0, 0x10, 0, 5}), with_crc({1, 16, 0, 0x10, 0, 2, 4, 1, 2, 3, 4}),
          with_crc({1, 23, 0, 0, 0, 1, 0, 0x10, 0, 1, 2, 0, 9})}) {
        for (std::size_t size = 0; size < whole.size(); ++size) {
            CHECK(request_size(std::span(whole).first(size)) > size);
        }
        CHECK(request_size(whole) == whole.size());
    }
    CHECK(request_size(Bytes{1, 0x2B, 0, 0, 0, 0}) == 6); // of an unknown function a silence says it
}

TEST_CASE("RTU frame: whatever comes with a right CRC does no harm", "[rtu]") {
    std::mt19937 random(5246);
    DriveBench bench;
    for (int round = 0; round < 20000; ++round) {
        Bytes frame{1, std::array<std::uint8_t, 5>{3, 6, 16, 23, 4}[random() % 5]};
        const std::size_t size = random() % 253;
        while (frame.size() < size) {
            frame.push_back(static_cast<std::uint8_t>(random() % 3 == 0 ? random() : random() % 4));
        }
        const Bytes answer = bench.ask(with_crc(frame));
        REQUIRE(answer.size() >= 5);
        REQUIRE(rtu_crc(answer) == 0);
    }
}
