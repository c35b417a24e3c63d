// SPDX-License-Identifier: MIT
#include "splinefeed/hal/modbus/pvt/clock_estimate.hpp"

#include "support/catch.hpp"

#include <cmath>
#include <random>

using splinefeed::hal::modbus::ClockEstimate;

namespace {

/// A drive's clock, and exchanges that take a random time each way.
class Drive {
public:
    Drive(double skew_ppm, std::uint32_t start_us, std::uint64_t seed)
        : skew_(1e-6 * skew_ppm), start_us_(start_us), random_(seed) {}

    [[nodiscard]] std::int64_t exact_us(std::uint64_t host_us) const {
        return std::int64_t{start_us_} + std::llround((1.0 + skew_) * static_cast<double>(host_us - origin_us));
    }
    void exchange(ClockEstimate& estimate, std::uint64_t at_us) {
        const std::uint64_t out = 20 + random_() % 60 + (random_() % 20 == 0 ? random_() % 8000 : 0);
        const std::uint64_t back = 20 + random_() % 60 + (random_() % 20 == 0 ? random_() % 8000 : 0);
        estimate.sample(at_us, at_us + out + back, static_cast<std::uint32_t>(exact_us(at_us + out)));
    }

    static constexpr std::uint64_t origin_us = 5'000'000'000;

private:
    double skew_;
    std::uint32_t start_us_;
    std::mt19937_64 random_;
};

} // namespace

TEST_CASE("Clock estimate: within half the shortest round trip, whatever the skew, over the wrap of 32 bits") {
    for (const double skew_ppm : {0.0, 120.0, -300.0}) {
        INFO("skew " << skew_ppm << " ppm");
        Drive drive(skew_ppm, 0xFFFF0000U, 7);
        ClockEstimate estimate;
        CHECK_FALSE(estimate.known());
        std::int64_t base = 0;
        for (int i = 0; i < 20000; ++i) { // 100 s
            const std::uint64_t now = Drive::origin_us + static_cast<std::uint64_t>(i) * 5000U;
            drive.exchange(estimate, now);
            if (i == 0) {
                base = estimate.drive_us(now) - drive.exact_us(now);
                base = (base + (base < 0 ? -(1LL << 31) : 1LL << 31)) / (1LL << 32) * (1LL << 32); // whole ranges
            }
            if (i > 2000 && i % 50 == 0) {
                const auto ahead = now + 400'000U; // as far as segments are sent ahead
                const std::int64_t error = estimate.drive_us(ahead) - drive.exact_us(ahead) - base;
                CHECK(std::llabs(error) <= 60);
                CHECK(estimate.drive_clock(ahead) - static_cast<std::uint32_t>(drive.exact_us(ahead)) + 60U <= 120U);
            }
        }
        CHECK(std::fabs(estimate.skew_ppm() - skew_ppm) < 10.0);
        CHECK(estimate.uncertainty_us() < 60.0);
    }
}

TEST_CASE("Clock estimate: nothing is said of the skew before there is enough to tell it by") {
    Drive drive(500.0, 0, 3);
    ClockEstimate estimate;
    for (int i = 0; i < 400; ++i) {
        drive.exchange(estimate, Drive::origin_us + static_cast<std::uint64_t>(i) * 5000U);
    }
    CHECK(estimate.skew_ppm() == 0.0);
    estimate.clear();
    CHECK_FALSE(estimate.known());
}

TEST_CASE("Clock estimate: an answer that came quicker than the line is not to this request, and does not count") {
    constexpr std::uint64_t host_us = 5'000'000'000;
    ClockEstimate estimate;
    estimate.sample(host_us + 1, host_us, 77);
    CHECK_FALSE(estimate.known());
    estimate.sample(host_us, host_us, 1000);
    REQUIRE(estimate.known());
    // Two steps are more than half the clock's range: the answer between them is not taken, but the clock goes on by
    // it.
    constexpr std::uint32_t step_us = 0x70000000U;
    estimate.sample(host_us + step_us + 500'000, host_us + step_us, 1000 + step_us);
    CHECK(estimate.drive_us(host_us) == 1000);
    CHECK(estimate.uncertainty_us() == 1.0);
    estimate.sample(host_us + 2ULL * step_us, host_us + 2ULL * step_us, 1000 + 2U * step_us);
    CHECK(estimate.drive_us(host_us) == 1000);
    CHECK(estimate.drive_us(host_us + 2ULL * step_us) == 1000 + 2LL * step_us);
}

TEST_CASE("Clock estimate: a line that is quicker than its rate has the times of sending and answering as its bounds") {
    constexpr std::uint64_t host_us = 5'000'000'000;
    ClockEstimate estimate;
    estimate.sample({host_us, host_us + 100, host_us + 900, host_us + 1000}, 500);
    CHECK(estimate.uncertainty_us() == 401.0);
    CHECK(estimate.earliest_us({host_us, host_us + 100, 0, 0}) == host_us + 100);
    for (std::uint32_t i = 1; i < 20; ++i) { // frames of 3 ms each way in 1 ms
        const std::uint64_t at_us = host_us + i * 5000;
        estimate.sample({at_us, at_us + 3000, at_us - 2000, at_us + 1000}, 500 + 5000 * i);
        REQUIRE(estimate.known());
        CHECK(std::llabs(estimate.drive_us(at_us + 500) - (500 + std::int64_t{5000} * i)) <= 1);
        CHECK(estimate.uncertainty_us() == 501.0);
        CHECK(estimate.earliest_us({at_us, at_us + 3000, 0, 0}) == at_us);
    }
}

TEST_CASE("Clock estimate: the truth is within its uncertainty, which is that of the tightest exchange or less") {
    std::mt19937_64 random(11);
    bool better = false;
    for (int round = 0; round < 500; ++round) {
        ClockEstimate estimate;
        std::uint64_t tightest = UINT64_MAX;
        for (unsigned i = 0; i < 40; ++i) { // of one half second
            const std::uint64_t at = Drive::origin_us + i * 5000U;
            const std::uint64_t out = 20 + random() % 2000;
            const std::uint64_t back = 20 + random() % 2000;
            estimate.sample(at, at + out + back, static_cast<std::uint32_t>(at + out));
            tightest = std::min(tightest, out + back);
            const std::int64_t error =
                static_cast<std::int32_t>(estimate.drive_clock(at) - static_cast<std::uint32_t>(at));
            const double known_to = estimate.uncertainty_us();
            REQUIRE(std::fabs(static_cast<double>(error)) <= known_to + 1.0);
            REQUIRE(known_to <= 0.5 * static_cast<double>(tightest) + 1.0);
            better = better || known_to < 0.4 * static_cast<double>(tightest);
        }
    }
    CHECK(better);
}

TEST_CASE("Clock estimate: for days, over many wraps of 32 bits, and across an hour in which nobody was heard") {
    constexpr std::uint64_t second = 1'000'000;
    constexpr std::int64_t range = std::int64_t{1} << 32;
    Drive drive(-80.0, 0xFFF00000U, 11);
    ClockEstimate estimate;
    std::int64_t base = 0;
    std::int64_t worst = 0;
    for (std::uint64_t i = 0; i < 4 * 86400; ++i) {
        const bool silent = i > 100'000 && i < 104'000; // more than half of the range of 71 minutes
        if (silent) {
            continue;
        }
        const std::uint64_t now = Drive::origin_us + i * second;
        drive.exchange(estimate, now);
        const std::int64_t error = estimate.drive_us(now) - drive.exact_us(now);
        base = i == 0 ? error : base;
        worst = std::max<std::int64_t>(worst, i == 0 || (i >= 104'000 && i < 104'020) ? 0 : std::llabs(error - base));
    }
    const std::int64_t rest = std::llabs(base) % range; // whole ranges are an origin
    CHECK(std::min(rest, range - rest) < 10'000);
    CHECK(worst < 10'000); // within the longest of its round trips
    CHECK(std::fabs(estimate.skew_ppm() + 80.0) < 30.0);
}
