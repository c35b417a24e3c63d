// SPDX-License-Identifier: MIT
#include "splinefeed/s4_segment_stream/segment_ring.hpp"

#include "support/catch.hpp"

#include <array>
#include <random>
#include <thread>

using splinefeed::FeedSegment;
using splinefeed::SegmentRing;

namespace {

FeedSegment segment(std::uint64_t index) {
    FeedSegment one;
    one.index = index;
    one.duration_ticks = static_cast<std::uint32_t>(index % 1000 + 1);
    one.end[0] = static_cast<std::int64_t>(3 * index);
    return one;
}

bool is(const FeedSegment& one, std::uint64_t index) {
    const FeedSegment wanted = segment(index);
    return one.index == wanted.index && one.duration_ticks == wanted.duration_ticks && one.end[0] == wanted.end[0];
}

} // namespace

TEST_CASE("Segment ring: first in, first out, and one place less than the storage has", "[ring]") {
    std::array<FeedSegment, 5> storage{};
    SegmentRing ring(storage);
    CHECK(ring.capacity() == 4);
    CHECK(ring.empty());
    FeedSegment out;
    CHECK_FALSE(ring.pop(out));
    std::mt19937_64 random(3);
    std::uint64_t pushed = 0;
    std::uint64_t popped = 0;
    for (int i = 0; i < 10'000; ++i) {
        REQUIRE(ring.room() == ring.capacity() - (pushed - popped));
        REQUIRE(ring.empty() == (pushed == popped));
        if (random() % 2 == 0 && ring.room() > 0) {
            ring.push(segment(pushed++));
        } else if (!ring.empty()) {
            REQUIRE(is(ring.front(), popped));
            REQUIRE(ring.pop(out));
            REQUIRE(is(out, popped++));
        }
    }
    ring.clear();
    CHECK(ring.empty());
    CHECK(ring.room() == ring.capacity());
}

TEST_CASE("Segment ring: two threads lose and repeat nothing", "[ring]") {
    constexpr std::uint64_t count = 200'000;
    std::array<FeedSegment, 8> storage{};
    SegmentRing ring(storage);
    std::thread writer([&] {
        for (std::uint64_t i = 0; i < count;) {
            if (ring.room() > 0) {
                ring.push(segment(i++));
            } else {
                std::this_thread::yield();
            }
        }
    });
    bool right = true;
    FeedSegment out;
    for (std::uint64_t i = 0; i < count;) {
        if (ring.pop(out)) {
            right = right && is(out, i++);
        } else {
            std::this_thread::yield();
        }
    }
    writer.join();
    CHECK(right);
    CHECK(ring.empty());
}
