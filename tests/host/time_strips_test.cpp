// SPDX-License-Identifier: MIT
#include "host_sim/report/time_strips.hpp"

#include "support/catch.hpp"

using namespace splinefeed::host;

namespace {

constexpr std::uint64_t ticks = 8000; // of a part

void add(TimeStrips& strips, std::uint64_t part, float low, float high, std::uint8_t code = 0) {
    const TimeStrips::Range range{low, high};
    strips.add(part * ticks, 1e-3, &range, static_cast<double>(part), 100.0, code);
}

} // namespace

TEST_CASE("parts in their own bins stay as they are") {
    TimeStrips strips(1, ticks);
    add(strips, 0, -1.0F, 1.0F, 7);
    add(strips, 1, 2.0F, 3.0F, 9);
    REQUIRE(strips.bins().size() == 2);
    CHECK(strips.range(0, 0).low == -1.0F);
    CHECK(strips.range(1, 0).high == 3.0F);
    CHECK(strips.bins()[0].code == 7);
    CHECK(strips.bins()[1].length_mm == 1.0);
}

TEST_CASE("a bin that a long part covers is as the part") {
    TimeStrips strips(1, ticks);
    add(strips, 0, 4.0F, 5.0F);
    add(strips, 3, 1.0F, 1.0F);
    REQUIRE(strips.bins().size() == 4);
    CHECK(strips.range(2, 0).high == 5.0F);
    CHECK(strips.range(3, 0).high == 1.0F);
}

TEST_CASE("however long the run, there are few bins, and no extreme is lost") {
    TimeStrips strips(1, ticks);
    constexpr std::uint64_t parts = 1'000'000;
    for (std::uint64_t i = 0; i < parts; ++i) {
        add(strips, i, i == 123'457 ? -50.0F : 0.0F, i == 765'431 ? 80.0F : 1.0F, i < parts / 2 ? 1 : 2);
    }
    CHECK(strips.bins().size() <= TimeStrips::most_bins);
    CHECK(strips.bins().size() > TimeStrips::most_bins / 4);
    const std::uint64_t together = strips.bin_ticks() / ticks;
    CHECK(strips.range(123'457 / together, 0).low == -50.0F);
    CHECK(strips.range(765'431 / together, 0).high == 80.0F);
    CHECK(strips.bins()[1].length_mm == static_cast<double>(together));
    CHECK(strips.bins()[3].code == 1);
    CHECK(strips.bins()[strips.bins().size() - 3].code == 2);
}
