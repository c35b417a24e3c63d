// SPDX-License-Identifier: MIT
#include "drive/path_rate.hpp"

#include <cmath>
#include <support/catch.hpp>

using firmware::PathRate;

namespace {

constexpr std::uint32_t reserve_ms = 100;
constexpr double reserve = reserve_ms * 8000.0;
double sigma(const PathRate& rate) {
    return static_cast<double>(rate.rate()) / PathRate::full;
}

} // namespace

TEST_CASE("Path rate: it falls along the law's curve and ends exactly at the end, in any steps", "[rate]") {
    for (const std::uint32_t step : {400U, 8000U, 7777U, 32000U}) {
        PathRate rate;
        rate.set_stop_reserve(reserve_ms);
        std::uint64_t left = 8000 * 150;
        rate.start({left, true, false});
        CHECK(sigma(rate) == 1.0);
        double ms = 0.0;
        while (left > 0 && ms < 1000.0) {
            const std::uint64_t way = rate.pass(step, {left, true, false});
            REQUIRE(way <= left);
            left -= way;
            ms += step / 8000.0;
            CHECK(sigma(rate) == Approx(std::min(1.0, std::sqrt(static_cast<double>(left) / reserve))).margin(3e-4));
        }
        // 50 ms at full rate, then 2 S.
        CHECK(left == 0);
        CHECK(ms == Approx(250.0).margin(0.5 + 2.0 * step / 8000.0));
        CHECK(rate.rate() == 0);
    }
}

TEST_CASE("Path rate: a hold ends within the reserve, in twice its time", "[rate]") {
    PathRate rate;
    rate.set_stop_reserve(reserve_ms);
    rate.start({80'000'000, true, false});
    std::uint64_t way = 0;
    int steps = 0;
    for (; rate.rate() > 0 && steps < 1000; ++steps) {
        way += rate.pass(8000, {80'000'000 - way, true, true});
    }
    CHECK(steps == Approx(200).margin(1));
    CHECK(static_cast<double>(way) == Approx(reserve).epsilon(1e-4));
}

TEST_CASE("Path rate: it rises by 1 / (2 S), and a standstill ahead lets it ignore the end", "[rate]") {
    PathRate rate;
    rate.set_stop_reserve(reserve_ms);
    for (int step = 1; step <= 200; ++step) {
        static_cast<void>(rate.pass(8000, {8000, false, false}));
        CHECK(sigma(rate) == Approx(step / 200.0).margin(1e-6));
    }
    rate.pass_rest({static_cast<std::uint64_t>(reserve) / 4, true, false});
    CHECK(sigma(rate) == Approx(0.5).epsilon(1e-6));
    CHECK(rate.stops_within(static_cast<std::uint64_t>(reserve) / 4));
    CHECK_FALSE(rate.stops_within(static_cast<std::uint64_t>(reserve) / 4 - 100));
}

TEST_CASE("Path rate: from standstill it comes to the end of any way, with any reserve", "[rate]") {
    for (const std::uint32_t reserve_of_test_ms : {1U, 100U, 10000U}) {
        for (const std::uint64_t way : {1ULL, 9ULL, 800ULL, 123'456ULL, 80'000'000ULL}) {
            PathRate rate;
            rate.set_stop_reserve(reserve_of_test_ms);
            std::uint64_t left = way;
            int steps = 0;
            for (; left > 0 && steps < 100'000; ++steps) {
                left -= rate.pass(8000, {left, true, false});
            }
            INFO(reserve_of_test_ms << " ms, " << way << " ticks");
            CHECK(left == 0);
        }
    }
}
