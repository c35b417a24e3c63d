// SPDX-License-Identifier: MIT
//
// The moving mean against a sum over the last positions in 128 bits.
#include "splinefeed/s4_segment_stream/moving_average.hpp"

#include "support/catch.hpp"

#include <random>
#include <vector>

using namespace splinefeed;

namespace {

__extension__ using Int128 = __int128;

/// The nearest integer to the mean of N + f positions, counted back from the newest, in 1/256.
std::uint64_t mean_of(const std::vector<std::uint64_t>& positions, std::uint32_t duration_q8) {
    Int128 sum = 0;
    std::size_t i = positions.size();
    std::uint32_t left = duration_q8;
    while (left > 0) {
        const std::uint32_t part = left < 256 ? left : 256;
        sum += static_cast<Int128>(part) * (positions.back() - positions[--i]);
        left -= part;
    }
    return positions.back() - static_cast<std::uint64_t>((sum + duration_q8 / 2) / duration_q8);
}

} // namespace

TEST_CASE("the moving mean is that of the last positions, to the last digit", "[stream][mean]") {
    std::mt19937_64 random{414};
    CAPTURE("seed 414");
    // 100 m from the start; so that both ends of the range are passed; and where each tick is a long way.
    const auto [start, shortest_log2] = GENERATE(table<std::uint64_t, int>({
        {(std::uint64_t{1} << 57) + 12345, 20},
        {~std::uint64_t{0} << 40, 20},
        {std::uint64_t{1} << 63 >> 1, 20},
        {(std::uint64_t{1} << 63) - 5, 20},
        {~std::uint64_t{0} - 5, 12},
    }));
    for (const std::uint32_t duration : {256U, 257U, 300U, 512U, 4444U, 1024U * 256U}) {
        std::vector<PathPosition> storage(MovingAverage::places_for(duration));
        MovingAverage mean(storage);
        std::uint64_t place = start;
        mean.reset({place}, duration);
        std::vector<std::uint64_t> positions(mean.reach() + 1, place);
        CAPTURE(start, duration);
        REQUIRE(mean.value().raw == place);
        for (int i = 0; i < 3000; ++i) {
            // up to 16 mm a tick, and with 12 up to 4 m
            place += random() >> (static_cast<unsigned>(shortest_log2) + random() % 40);
            positions.push_back(place);
            mean.push({place});
            REQUIRE(mean.value().raw == mean_of(positions, duration));
        }
        for (std::uint32_t i = 0; i < mean.reach(); ++i) {
            mean.push({place});
        }
        REQUIRE(mean.value().raw == place); // at rest exactly where the motion is
    }
}

TEST_CASE("a position that goes back counts as the one before", "[stream][mean]") {
    std::vector<PathPosition> storage(MovingAverage::places_for(1024));
    MovingAverage mean(storage);
    mean.reset({1000}, 1024);
    mean.push({1010});
    const PathPosition before = mean.value();
    mean.push({1009});
    CHECK(mean.value().raw >= before.raw);
    for (int i = 0; i < 5; ++i) {
        mean.push({1010});
    }
    CHECK(mean.value().raw == 1010);
}
