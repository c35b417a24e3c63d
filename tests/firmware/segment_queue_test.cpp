// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt_drive/segment_queue.hpp"

#include <array>
#include <support/catch.hpp>
#include <vector>

using splinefeed::hal::modbus::SegmentQueue;
using Segment = SegmentQueue::Segment;
using Refusal = SegmentQueue::Refusal;

namespace {

/// Each segment has its number as its duration.
std::vector<Segment> numbered(std::uint32_t from, std::uint32_t count) {
    std::vector<Segment> segments(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        segments[i].duration_ticks = 1000 + (from + i) % 1000;
    }
    return segments;
}

} // namespace

TEST_CASE("Segment queue: each once and in order, across the end of the numbers", "[queue]") {
    std::array<Segment, 19> storage{}; // no power of two
    SegmentQueue queue(storage, 3);
    std::uint32_t number = 0xFFFF'FF00;
    queue.begin(number);
    for (int round = 0; round < 500; ++round) {
        CHECK(queue.take(number, numbered(number, 3)) == Refusal::none);
        CHECK(queue.take(number, numbered(number, 3)) == Refusal::none); // repeated
        CHECK(queue.take(number - 2, numbered(number - 2, 4)) == Refusal::none);
        CHECK(queue.take(number + 4, numbered(number + 4, 1)) == Refusal::gap);
        CHECK(queue.next() == number + 3);
        for (int i = 0; i < 3; ++i) {
            REQUIRE(queue.front().duration_ticks == 1000 + number % 1000);
            queue.pass();
            ++number;
        }
        CHECK(queue.empty());
        CHECK(queue.ticks() == 0);
        queue.set_executed(number);
    }
}

TEST_CASE("Segment queue: what is computed but not made keeps its place", "[queue]") {
    std::array<Segment, 16> storage{};
    SegmentQueue queue(storage, 3);
    CHECK(queue.take(0, numbered(0, 16)) == Refusal::none);
    CHECK(queue.free() == 0);
    queue.pass();
    queue.pass();
    CHECK(queue.take(16, numbered(16, 1)) == Refusal::no_room);
    queue.set_executed(1);
    CHECK(queue.free() == 1);
    CHECK(queue.take(16, numbered(16, 2)) == Refusal::no_room); // and then none of them
    CHECK(queue.next() == 16);
    CHECK(queue.take(15, numbered(15, 2)) == Refusal::none);
}

TEST_CASE("Segment queue: what the map does not allow", "[queue]") {
    std::array<Segment, 16> storage{};
    SegmentQueue queue(storage, 3);
    for (const std::uint32_t ticks : {0U, 799U, 80'000'001U}) {
        std::vector<Segment> segments = numbered(0, 3);
        segments[2].duration_ticks = ticks;
        CHECK(queue.take(0, segments) == Refusal::malformed);
    }
    std::vector<Segment> segments = numbered(0, 1);
    segments[0].rest = true;
    segments[0].end_velocity[2] = 1;
    CHECK(queue.take(0, segments) == Refusal::malformed);
    CHECK(queue.next() == 0);
    CHECK(queue.take(7, {}) == Refusal::none); // of nothing there is no first
}

TEST_CASE("Segment queue: dropped from a number on, but not what is begun", "[queue]") {
    std::array<Segment, 16> storage{};
    SegmentQueue queue(storage, 3);
    std::vector<Segment> segments = numbered(0, 10);
    segments[6].rest = true;
    CHECK(queue.take(0, segments) == Refusal::none);
    CHECK(queue.rests_ahead());
    CHECK_FALSE(queue.left_before(6, false).rests);
    CHECK(queue.left_before(7, false).rests);
    const SegmentQueue::Left left = queue.left_before(2, false);
    CHECK(left.ticks == 2001);
    queue.drop_from(left);
    CHECK(queue.next() == 2);
    CHECK(queue.ticks() == 2001);
    CHECK_FALSE(queue.rests_ahead());
    CHECK(queue.left_before(0, true).end == 1);
    CHECK(queue.left_before(0xFFFF'0000, false).end == 0);
    CHECK(queue.left_before(900, false).end == 2);
}
