// SPDX-License-Identifier: MIT
#include "splinefeed/base/spsc_ring.hpp"

#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <thread>

using splinefeed::SpscRing;

namespace {

/// An item of several words, so that one that is read while it is written does not fit together.
struct Item {
    std::uint64_t number = 0;
    std::array<std::uint64_t, 5> copies{};

    Item() = default;
    explicit Item(std::uint64_t n) : number(n) { copies.fill(~n); }

    [[nodiscard]] bool whole() const {
        for (const std::uint64_t copy : copies) {
            if (copy != ~number) {
                return false;
            }
        }
        return true;
    }
};

} // namespace

TEST_CASE("a ring gives its items back in order, and holds one less than its storage", "[ring]") {
    std::array<int, 4> storage{};
    SpscRing<int> ring(storage);
    int out = -1;
    CHECK(ring.capacity() == 3);
    CHECK_FALSE(ring.pop(out));
    CHECK(out == -1);
    int pushed = 0;
    int popped = 0;
    for (int round = 0; round < 9; ++round) { // the indices wrap at each offset
        while (ring.room() > 0) {
            ring.push(pushed++);
        }
        CHECK(ring.size() == 3);
        CHECK(ring.front() == popped);
        for (int i = 0; i < 1 + round % 3; ++i) {
            REQUIRE(ring.pop(out));
            CHECK(out == popped++);
        }
        CHECK(ring.size() == static_cast<std::size_t>(pushed - popped));
    }
    ring.clear();
    CHECK(ring.empty());
    CHECK(ring.room() == 3);
}

// tests/modbus/tsan_runs.sh runs it under the thread sanitizer, too.
TEST_CASE("a ring between two threads loses nothing, and no item is torn", "[ring]") {
    // With two places each item may take two switches of threads, which a busy host makes slow.
    const auto items = static_cast<std::uint64_t>(splinefeed_test::rounds(80'000, 800'000));
    for (const std::size_t places : {2U, 3U, 64U}) {
        std::array<Item, 64> storage{};
        const std::span<Item> all(storage);
        SpscRing<Item> ring(all.first(places));
        std::thread writer([&ring, items] {
            for (std::uint64_t n = 1; n <= items;) {
                if (ring.room() > 0) {
                    ring.push(Item(n++));
                } else {
                    std::this_thread::yield();
                }
            }
        });
        std::uint64_t expected = 1;
        std::uint64_t wrong = 0;
        while (expected <= items) {
            if (ring.empty()) {
                std::this_thread::yield();
                continue;
            }
            const Item seen = ring.front();
            wrong += !seen.whole() || seen.number != expected || ring.size() > places - 1 ? 1U : 0U;
            ring.drop();
            ++expected;
        }
        writer.join();
        CAPTURE(places);
        CHECK(wrong == 0);
        CHECK(ring.empty());
    }
}
