// SPDX-License-Identifier: MIT
#include "splinefeed/hal/gpio/debounce.hpp"

#include "support/catch.hpp"
#include "support/rounds.hpp"

#include <random>
#include <vector>

using splinefeed::hal::gpio::Debounce;

namespace {

constexpr std::uint64_t us = 1000;

struct Flip {
    std::uint64_t time_ns;
    bool level;
};

struct Accepted {
    bool level;
    std::uint64_t since_ns;
    std::uint64_t at_ns;

    friend bool operator==(const Accepted&, const Accepted&) = default;
};

// Switches that bounce: flips close together, then rests of any length, some of them just as long as the debouncing.
std::vector<Flip> random_flips(std::mt19937& random, std::uint64_t debounce_ns) {
    std::vector<Flip> flips;
    std::uint64_t now = 1000 * us;
    bool level = false;
    const auto between = [&](std::uint64_t low, std::uint64_t high) {
        return std::uniform_int_distribution<std::uint64_t>(low, high)(random);
    };
    for (int i = 0; i < 60; ++i) {
        level = !level;
        flips.push_back({now, level});
        switch (between(0, 5)) {
        case 0: now += debounce_ns + between(0, 2); break;
        case 1: now += debounce_ns > 0 ? debounce_ns - 1 : 1; break;
        case 2: now += between(1, 4 * debounce_ns + 1000); break;
        default: now += between(1, debounce_ns / 3 + 1);
        }
    }
    return flips;
}

// From the whole history at once, where Debounce sees one edge after the other: a level counts from the first end of a
// stretch that is long enough on; since the first edge to it that no long enough stretch of the other level follows.
std::vector<Accepted> by_stretches(const std::vector<Flip>& flips, std::uint64_t debounce_ns) {
    std::vector<Accepted> out;
    bool accepted = false;
    std::size_t calm = 0; // flips before this one are over and done with
    for (std::size_t i = 0; i < flips.size(); ++i) {
        const bool last = i + 1 == flips.size();
        const bool lasts = last || flips[i + 1].time_ns - flips[i].time_ns >= debounce_ns;
        if (!lasts) {
            continue;
        }
        if (flips[i].level != accepted) {
            std::size_t first = calm;
            while (flips[first].level == accepted) {
                ++first;
            }
            accepted = flips[i].level;
            out.push_back({accepted, flips[first].time_ns, flips[i].time_ns + debounce_ns});
        }
        calm = i + 1;
    }
    return out;
}

} // namespace

TEST_CASE("Debounce: a level counts when it has lasted, since the first edge to it") {
    Debounce input(false, 1000);
    CHECK_FALSE(input.settled(500 * us));
    CHECK(input.due_ns() == Debounce::never);
    CHECK_FALSE(input.edge(5000 * us, true));
    CHECK_FALSE(input.edge(5050 * us, false));
    CHECK_FALSE(input.edge(5080 * us, true));
    CHECK(input.due_ns() == 6080 * us);
    CHECK_FALSE(input.settled(6080 * us - 1));
    CHECK(input.settled(6080 * us));
    CHECK(input.since_ns() == 5000 * us);
    CHECK(input.due_ns() == Debounce::never);
}

TEST_CASE("Debounce: lost edges start the time anew, and a level that was read is an edge where it is another") {
    Debounce input(false, 1000);
    CHECK_FALSE(input.edge(5000 * us, true));
    CHECK_FALSE(input.edge(5900 * us, true)); // down and up in between were lost
    CHECK_FALSE(input.settled(6000 * us));
    CHECK_FALSE(input.sample(6500 * us, true)); // reading it does not
    CHECK(input.sample(6900 * us, true));
    CHECK(input.since_ns() == 5000 * us);
    CHECK_FALSE(input.sample(8000 * us, false));
    CHECK(input.sample(9000 * us, false));
    CHECK_FALSE(input.settled(9000 * us));
    CHECK(input.since_ns() == 8000 * us);
}

TEST_CASE("Debounce: time that goes back is the latest before") {
    Debounce input(false, 10);
    CHECK_FALSE(input.edge(50000, true));
    CHECK_FALSE(input.settled(40000));
    CHECK_FALSE(input.edge(40000, false));
    CHECK_FALSE(input.edge(45000, true));
    CHECK(input.due_ns() == 60000);
}

TEST_CASE("Debounce: random bounces give what the whole history says, however often one asks") {
    const unsigned seed = splinefeed_test::random_seed();
    INFO("seed " << seed);
    std::mt19937 random(seed);
    for (int round = 0; round < splinefeed_test::rounds(300); ++round) {
        constexpr std::uint32_t times_us[] = {0, 1, 50, 1000, 100000};
        const std::uint32_t debounce_us = times_us[static_cast<unsigned>(round) % 5];
        const std::vector<Flip> flips = random_flips(random, debounce_us * us);
        const bool asks_often = round % 2 == 0;
        INFO("round " << round << ", " << debounce_us << " us");
        Debounce input(false, debounce_us);
        std::vector<Accepted> seen;
        const auto level = [&] {
            return !seen.empty() && seen.back().level;
        };
        const auto changed = [&](std::uint64_t at_ns) {
            seen.push_back({!level(), input.since_ns(), at_ns});
        };
        for (std::size_t i = 0; i < flips.size(); ++i) {
            if (input.edge(flips[i].time_ns, flips[i].level)) {
                changed(flips[i].time_ns);
            }
            const std::uint64_t due = input.due_ns();
            if (asks_often && i + 1 < flips.size() && due < flips[i + 1].time_ns) {
                CHECK(input.settled(due - 1) == level());
                REQUIRE(input.settled(due) != level());
                changed(due);
            }
        }
        if (const std::uint64_t due = input.due_ns(); due != Debounce::never) {
            REQUIRE(input.settled(due) != level());
            changed(due);
        }
        std::vector<Accepted> wanted = by_stretches(flips, debounce_us * us);
        REQUIRE(seen.size() == wanted.size());
        for (std::size_t i = 0; i < seen.size() && !asks_often; ++i) {
            wanted[i].at_ns = seen[i].at_ns; // who asks late is told late
        }
        CHECK((seen == wanted));
    }
}
