// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt/pvt_map.hpp"

#include "support/catch.hpp"

#include <random>

using namespace splinefeed;
using namespace splinefeed::hal::modbus;

TEST_CASE("PVT map: the checksum is the CRC-32 that everybody has") {
    // "123456789" has an odd number of bytes: "12345678" by zlib.
    const std::array<std::uint16_t, 4> text{0x3132, 0x3334, 0x3536, 0x3738};
    CHECK(crc32(text) == 0x9AE0DAAF);
    CHECK(crc32(std::span(text).subspan(1), crc32(std::span(text).first(1))) == 0x9AE0DAAF);
}

TEST_CASE("PVT map: a block is what the document says, register by register") {
    PvtSegment segment;
    segment.duration_ticks = 0x00010203;
    segment.end = {0x123456789ABC, -1};
    segment.end_velocity = {-0x10000, 5};
    const PvtBlock block{.nonce = 0x1111,
                         .session = 0x2222,
                         .command = PvtCommand::start,
                         .command_counter = 7,
                         .argument = 0xAABBCCDD,
                         .count = 1,
                         .first = 0x00050006};
    PvtBlockRegisters registers{};
    const std::size_t size = encode(block, std::span(&segment, 1), 2, registers);
    const std::array<std::uint16_t, 25> expected{0x1111, 0x2222, 4,      7,      0xAABB, 0xCCDD, 1,      5,      6,
                                                 0,      0,      1,      0x0203, 0x1234, 0x5678, 0x9ABC, 0xFFFF, 0xFFFF,
                                                 0,      0xFFFF, 0xFFFF, 0xFFFF, 0,      0,      5};
    REQUIRE(size == expected.size());
    for (std::size_t i = 0; i < size; ++i) {
        INFO("register " << i);
        CHECK((i == 9 || i == 10 || registers[i] == expected[i]));
    }
    CHECK(checksum_holds(std::span(registers).first(size)));
    for (std::size_t i = 0; i < size; ++i) {
        PvtBlockRegisters changed = registers;
        changed[i] ^= 0x0100U;
        CHECK_FALSE(checksum_holds(std::span(changed).first(size)));
    }
}

TEST_CASE("PVT map: blocks and status come back as they were, and blocks of a wrong length do not") {
    std::mt19937_64 random(20261122);
    for (int round = 0; round < 200; ++round) {
        const int axes = static_cast<int>(random() % 6) + 1;
        PvtSegments segments{};
        PvtBlock block{.nonce = static_cast<std::uint16_t>(random()),
                       .session = static_cast<std::uint16_t>(random()),
                       .command = static_cast<PvtCommand>(random() % 12),
                       .command_counter = static_cast<std::uint16_t>(random()),
                       .argument = static_cast<std::uint32_t>(random()),
                       .count = static_cast<std::uint16_t>(random() % (pvt::most_segments(axes) + 1)),
                       .first = static_cast<std::uint32_t>(random())};
        for (PvtSegment& segment : segments) {
            segment.duration_ticks = static_cast<std::uint32_t>(random() >> 33U);
            segment.rest = random() % 2 == 0;
            for (const unsigned k : indices(axes)) {
                segment.end[k] = static_cast<std::int64_t>(random()) >> 16;
                segment.end_velocity[k] = static_cast<std::int64_t>(random()) >> 16;
            }
        }
        PvtBlockRegisters registers{};
        const std::size_t size = encode(block, segments, axes, registers);
        REQUIRE(size <= pvt::most_block_registers);
        PvtSegments read{};
        const auto back = decode_block(std::span(registers).first(size), axes, read);
        REQUIRE(back.has_value());
        CHECK(back->nonce == block.nonce);
        CHECK(back->session == block.session);
        CHECK(back->command == block.command);
        CHECK(back->command_counter == block.command_counter);
        CHECK(back->argument == block.argument);
        CHECK(back->count == block.count);
        CHECK(back->first == block.first);
        for (std::size_t i = 0; i < block.count; ++i) {
            CHECK(read[i].duration_ticks == segments[i].duration_ticks);
            CHECK(read[i].rest == segments[i].rest);
            CHECK(read[i].end == segments[i].end);
            CHECK(read[i].end_velocity == segments[i].end_velocity);
        }
        CHECK_FALSE(decode_block(std::span(registers).first(size - 1), axes, read).has_value());

        PvtStatus status;
        status.nonce = block.nonce;
        status.state = PvtState::held;
        status.fault = 0x101;
        status.next = block.first;
        status.executed = block.argument;
        status.clock_us = static_cast<std::uint32_t>(random());
        for (const unsigned k : indices(axes)) {
            status.position[k] = static_cast<std::int32_t>(random());
            status.following_error[k] = static_cast<std::int32_t>(random());
        }
        std::array<std::uint16_t, pvt::status_registers(6)> raw{};
        encode(status, axes, raw);
        const std::span<std::uint16_t> whole(raw.data(), pvt::status_registers(axes));
        CHECK(status_holds(whole));
        whole[random() % whole.size()] ^= 0x10U;
        CHECK_FALSE(status_holds(whole));
        encode(status, axes, raw);
        const PvtStatus again = decode_status(raw, axes);
        CHECK(again.nonce == status.nonce);
        CHECK(again.state == status.state);
        CHECK(again.fault == status.fault);
        CHECK(again.next == status.next);
        CHECK(again.executed == status.executed);
        CHECK(again.clock_us == status.clock_us);
        CHECK(again.position == status.position);
        CHECK(again.following_error == status.following_error);
    }
}

TEST_CASE("PVT map: a feed segment's ends are rounded to the nearest, whatever their sign") {
    FeedSegment segment;
    segment.duration_ticks = 8000;
    constexpr std::int64_t unit = units_per_count >> 16;
    segment.end = {0, 3 * unit + unit / 2 - 1, -(3 * unit) - unit / 2 - 1, -(units_per_count * 2147483647)};
    segment.end_velocity = {0, units_per_count, -units_per_count / 2, 0};
    PvtSegment pvt;
    pvt.end[3] = 77;
    REQUIRE(to_pvt(segment, std::array<PvtAxis, 4>{1, 2, 3, -1}, pvt));
    CHECK(pvt.end[3] == 77);
    CHECK(pvt.end[0] == 3);
    CHECK(pvt.end[1] == -4);
    CHECK(pvt.end[2] == -(std::int64_t{2147483647} << 16));
    CHECK(pvt.end_velocity[0] == 1 << 24);
    CHECK(pvt.end_velocity[1] == -(1 << 23));
    CHECK(pvt.duration_ticks == 8000);
    CHECK_FALSE(pvt.rest);
    segment.end_velocity = {0, 0, 0, 1}; // another drive's axis moves, by less than this one could tell
    REQUIRE(to_pvt(segment, std::array<PvtAxis, 2>{1, 2}, pvt));
    CHECK_FALSE(pvt.rest);
    segment.end_velocity = {};
    REQUIRE(to_pvt(segment, std::array<PvtAxis, 2>{1, 2}, pvt));
    CHECK(pvt.rest);
    PvtBlockRegisters registers{};
    encode({.count = 1}, std::span(&pvt, 1), 2, registers);
    CHECK(registers[11] == 0x8000);
    CHECK(registers[12] == 8000);
}

TEST_CASE("PVT map: what does not fit its registers is refused, whole; nothing wraps") {
    constexpr std::int64_t velocity_unit = units_per_count >> 24;
    constexpr std::int64_t position_unit = units_per_count >> 16;
    constexpr std::int64_t largest = (std::int64_t{1} << 47) - 1;
    const std::array<PvtAxis, 1> axis{0};
    FeedSegment segment;
    segment.duration_ticks = 8000;
    PvtSegment out;
    out.end[0] = 77;
    const auto refused = [&](const FeedSegment& bad) {
        const bool taken = to_pvt(bad, axis, out);
        CHECK(out.end[0] == 77);
        CHECK(out.duration_ticks == 0);
        return !taken;
    };
    for (const std::int64_t sign : {1, -1}) {
        FeedSegment fast = segment;
        fast.end_velocity[0] = sign * (largest * velocity_unit + 1);
        CHECK(refused(fast));
        fast.end_velocity[0] = sign * std::numeric_limits<std::int64_t>::max();
        CHECK(refused(fast));
        FeedSegment far = segment;
        far.end[0] = sign * (largest * position_unit + 1);
        CHECK(refused(far));
        far.end[0] = sign * std::numeric_limits<std::int64_t>::max();
        CHECK(refused(far));
    }
    FeedSegment lowest = segment;
    lowest.end[0] = std::numeric_limits<std::int64_t>::min();
    CHECK(refused(lowest));
    for (const std::uint32_t ticks : {0U, pvt::shortest_ticks - 1, pvt::longest_ticks + 1, 0x80000000U}) {
        FeedSegment timed = segment;
        timed.duration_ticks = ticks;
        CHECK(refused(timed));
    }
    // The last that fit come through the registers as they are.
    for (const std::int64_t sign : {1, -1}) {
        segment.end[0] = sign * largest * position_unit;
        segment.end_velocity[0] = sign * largest * velocity_unit;
        PvtSegment taken;
        REQUIRE(to_pvt(segment, axis, taken));
        PvtBlockRegisters registers{};
        const std::size_t size = encode({.count = 1}, std::span(&taken, 1), 1, registers);
        PvtSegments read{};
        REQUIRE(decode_block(std::span(registers).first(size), 1, read).has_value());
        CHECK(read[0].end[0] == sign * largest);
        CHECK(read[0].end_velocity[0] == sign * largest);
    }
}

TEST_CASE("PVT map: an inverted axis counts down where the machine's goes up") {
    FeedSegment segment;
    segment.duration_ticks = 8000;
    segment.end = {5 * units_per_count, 5 * units_per_count};
    segment.end_velocity = {-units_per_count, -units_per_count};
    PvtSegment out;
    REQUIRE(to_pvt(segment, std::array<PvtAxis, 2>{PvtAxis{0, true}, PvtAxis{1, false}}, out));
    CHECK(out.end[0] == -out.end[1]);
    CHECK(out.end[1] == 5 << 16);
    CHECK(out.end_velocity[0] == 1 << 24);
    CHECK(out.end_velocity[1] == -(1 << 24));
}
