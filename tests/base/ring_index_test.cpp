// SPDX-License-Identifier: MIT
#include "splinefeed/base/ring_index.hpp"

#include "support/catch.hpp"

using splinefeed::ring_index;

TEST_CASE("Ring index: the remainder of a division, over twice the ring") {
    for (std::size_t size = 1; size <= 40; ++size) {
        for (std::size_t i = 0; i < 2 * size; ++i) {
            INFO("place " << i << " of " << size);
            CHECK(ring_index(i, size) == i % size);
        }
    }
}
