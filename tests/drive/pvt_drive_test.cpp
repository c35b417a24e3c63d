// SPDX-License-Identifier: MIT
#include "pvt_bench.hpp"
#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <algorithm>

using namespace splinefeed_test;

namespace {

/// Random segments in blocks of as many as fit.
void feed_all(PvtBench& bench, const std::vector<PvtSegment>& segments, std::uint32_t first) {
    const std::size_t most = pvt::most_segments(bench.drive.axes());
    for (std::size_t at = 0; at < segments.size(); at += most) {
        const std::size_t end = std::min(at + most, segments.size());
        const auto from = segments.begin() + static_cast<std::ptrdiff_t>(at);
        const PvtStatus status = bench.feed(first + static_cast<std::uint32_t>(at),
                                            {from, segments.begin() + static_cast<std::ptrdiff_t>(end)});
        REQUIRE(status.refused == PvtRefusal::none);
    }
}

} // namespace

TEST_CASE("PVT drive: random segments through the map are the document's cubics", "[drive][pvt]") {
    const auto seed = random_seed();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    for (int round = 0; round < rounds(20); ++round) {
        const int axes = static_cast<int>(random() % 6) + 1;
        const auto segments = random_segments(random, axes, 1 + random() % 60, 1000.0);
        std::uint64_t ticks = 0;
        for (const PvtSegment& segment : segments) {
            ticks += segment.duration_ticks;
        }
        PvtBench bench(axes);
        const auto first = static_cast<std::uint32_t>(random());
        bench.begin(first);
        feed_all(bench, segments, first);
        bench.wait_us(random() % 1000);
        bench.start_now();
        const std::uint64_t start = bench.now_us;
        while (bench.state() == PvtState::running) {
            bench.wait_us(random() % 3000 + 1);
            const long double passed = 8.0L * static_cast<long double>(bench.now_us - start);
            for (int k = 0; k < axes; ++k) {
                const long double expected =
                    hermite(segments, static_cast<unsigned>(k), std::min<long double>(passed, ticks));
                REQUIRE(std::fabs(bench.drive.position_counts(k) - static_cast<double>(expected)) < 1e-6);
            }
        }
        CHECK(bench.state() == PvtState::standing);
        CHECK(bench.status().executed == first + static_cast<std::uint32_t>(segments.size()));
        REQUIRE(bench.executed.size() == segments.size());
        CHECK(bench.executed.back().end_us - static_cast<double>(start) ==
              Approx(static_cast<double>(ticks) / 8.0).margin(0.01));
        for (int k = 0; k < axes; ++k) {
            CHECK(bench.drive.position_counts(k) ==
                  static_cast<double>(segments.back().end[static_cast<unsigned>(k)]) / 65536.0);
        }
    }
}

TEST_CASE("PVT drive: whatever is delivered twice, late, damaged or out of order, each segment is executed once",
          "[drive][pvt]") {
    const auto seed = random_seed();
    INFO("seed " << seed);
    std::mt19937_64 random(seed);
    for (int round = 0; round < rounds(20); ++round) {
        const int axes = static_cast<int>(random() % 3) + 1;
        const auto segments = random_segments(random, axes, 300, 100.0);
        PvtDriveParameters parameters;
        parameters.ring = 32;
        PvtBench bench(axes, parameters);
        const std::uint32_t first = 0xFFFFFF00U + static_cast<std::uint32_t>(random() % 512); // past 2^32
        bench.begin(first);
        std::vector<std::vector<std::uint16_t>> late;
        std::uint16_t refusals = bench.status().refusals;
        for (int block = 0; bench.executed.size() < segments.size(); ++block) {
            REQUIRE(block < 20000);
            const PvtStatus status = bench.status();
            if (status.state == PvtState::standing || status.state == PvtState::held) {
                static_cast<void>(bench.command(
                    status.state == PvtState::standing ? PvtCommand::start : PvtCommand::resume, status.clock_us));
            }
            // From a place at or around what comes next, as many as there are, up to a block.
            const auto next = static_cast<std::int64_t>(static_cast<std::uint32_t>(status.next - first));
            const auto from = std::clamp<std::int64_t>(next + static_cast<std::int64_t>(random() % 9) - 5, 0, 299);
            const auto count = std::min<std::int64_t>(
                static_cast<std::int64_t>(random() % (pvt::most_segments(axes) + 1)), 300 - from);
            auto registers =
                bench.registers_of({.session = bench.session, .first = first + static_cast<std::uint32_t>(from)},
                                   {segments.begin() + from, segments.begin() + from + count});
            if (random() % 4 == 0) {
                late.push_back(registers);
            }
            const bool damaged = random() % 8 == 0;
            if (damaged) {
                std::uint16_t& word = registers[random() % registers.size()];
                word = static_cast<std::uint16_t>(word ^ 1U << random() % 16);
            }
            const ModbusException exception = bench.drive.write(pvt::block_address, registers);
            CHECK((damaged || exception == ModbusException::none));
            const PvtStatus after = bench.status();
            if (damaged) {
                CHECK(after.next == status.next);
                CHECK((exception == ModbusException::illegal_value || after.refused == PvtRefusal::checksum));
            } else if (count == 0) {
                CHECK(after.refused == PvtRefusal::none);
                CHECK(after.next == status.next);
            } else if (from > next) {
                CHECK(after.refused == PvtRefusal::gap);
            } else if (from + count - next > status.free) {
                CHECK(after.refused == PvtRefusal::no_room);
            } else {
                CHECK(after.refused == PvtRefusal::none);
                CHECK(after.next == std::max(status.next - first, static_cast<std::uint32_t>(from + count)) + first);
            }
            refusals = static_cast<std::uint16_t>(
                refusals + (exception == ModbusException::none && after.refused != PvtRefusal::none ? 1 : 0));
            CHECK(after.refusals == refusals);
            if (!late.empty() && random() % 3 == 0) {
                static_cast<void>(bench.drive.write(pvt::block_address, late[random() % late.size()]));
                refusals = bench.status().refusals;
            }
            bench.wait_us(random() % 4000);
        }
        REQUIRE(bench.executed.size() == segments.size());
        for (std::size_t i = 0; i < segments.size(); ++i) {
            REQUIRE(bench.executed[i].sequence == first + static_cast<std::uint32_t>(i));
            REQUIRE(bench.executed[i].segment.end == segments[i].end);
        }
        bench.wait_us(1'000'000);
        CHECK(bench.drive.position_counts(0) == static_cast<double>(segments.back().end[0]) / 65536.0);
    }
}

TEST_CASE("PVT drive: what is not in the map is answered by exceptions, and changes nothing", "[drive][pvt]") {
    PvtBench bench(2);
    std::vector<std::uint16_t> some(64);
    const auto read = [&](int address, std::size_t count) {
        return bench.drive.read(address, std::span(some).first(count));
    };
    const auto write = [&](int address, std::vector<std::uint16_t> values) {
        return bench.drive.write(address, values);
    };
    CHECK(read(0x0000, 11) == ModbusException::none);
    CHECK(some[0] == 0x5346);
    CHECK(some[9] == 0x1234);
    CHECK(some[10] == 0x5678);
    CHECK(read(0x000A, 1) == ModbusException::none);
    CHECK(read(0x0020, 26) == ModbusException::none);
    CHECK(read(0x0039, 1) == ModbusException::none);
    for (const auto& [address, count] : {std::pair<int, std::size_t>{0x000B, 1},
                                         {0x0000, 12},
                                         {0x0014, 1},
                                         {0x0010, 5},
                                         {0x001F, 2},
                                         {0x003A, 1},
                                         {0x0020, 27},
                                         {0x0100, 11},
                                         {0xFFFF, 1}}) {
        CAPTURE(address, count);
        CHECK(read(address, count) == ModbusException::illegal_address);
    }
    CHECK(write(0x0000, {1}) == ModbusException::illegal_address);
    CHECK(write(0x0020, {1}) == ModbusException::illegal_address);
    CHECK(write(0x0013, {1, 1}) == ModbusException::illegal_address);
    CHECK(write(0x0101, std::vector<std::uint16_t>(11)) == ModbusException::illegal_address);
    CHECK(write(0x0010, {500, 0}) == ModbusException::illegal_value);
    CHECK(write(0x0011, {10001}) == ModbusException::illegal_value);
    CHECK(bench.drive.machine().configuration().watchdog_ms == 0);
    CHECK(write(0x0010, {500, 20, 1, 2}) == ModbusException::none);
    CHECK(write(0x0013, {3}) == ModbusException::none);
    CHECK(bench.drive.machine().configuration().watchdog_ms == 500);
    CHECK(bench.drive.machine().configuration().stop_reserve_ms == 20);
    CHECK(bench.drive.machine().configuration().following_window == 0x10003);
    auto block = bench.registers_of({.session = 77, .command = PvtCommand::enable, .command_counter = 1});
    block.push_back(0);
    CHECK(write(0x0100, block) == ModbusException::illegal_value);
    block.resize(10);
    CHECK(write(0x0100, block) == ModbusException::illegal_value);
    CHECK(write(0x0100, std::vector<std::uint16_t>(123)) == ModbusException::illegal_value);
    CHECK(bench.status().nonce == 0);
    CHECK(bench.state() == PvtState::disabled);
}

TEST_CASE("PVT drive: a segment out of its range, or with a wrong mark, and a block in a wrong session",
          "[drive][pvt]") {
    PvtBench bench(2);
    const auto good = steady(2, 3, 8000, 100.0);
    CHECK(bench.feed(0, good).refused == PvtRefusal::session);
    bench.begin(5);
    CHECK(bench.feed(5, good).refused == PvtRefusal::none);
    CHECK(bench.status().next == 8);
    for (const std::uint32_t ticks : {0U, 799U, 80'000'001U}) {
        auto bad = good;
        bad[2].duration_ticks = ticks;
        CHECK(bench.feed(8, bad).refused == PvtRefusal::malformed);
        CHECK(bench.feed(6, bad).refused == PvtRefusal::malformed); // its first two were taken already, the last is new
        CHECK(bench.status().next == 8);
    }
    auto marked = good;
    marked[2].rest = true;
    CHECK(bench.feed(8, marked).refused == PvtRefusal::malformed);
    marked[2].end_velocity = {};
    marked[2].end_velocity[5] = 1; // no axis of this drive
    CHECK(bench.feed(8, marked).refused == PvtRefusal::none);
    CHECK(bench.send({.session = 78, .first = 11}, good).refused == PvtRefusal::session);
    CHECK(bench.status().refusals == 9);
    CHECK(bench.status().next == 11);
}
