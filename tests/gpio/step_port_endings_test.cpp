// SPDX-License-Identifier: MIT
// However a motion ends in its middle, the port brakes on the path within the axes' accelerations, by its steps.
#include "port_rig.hpp"
#include "support/catch.hpp"
#include "support/random_path.hpp"
#include "support/rounds.hpp"

#include <functional>

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

constexpr double acceleration = 1000.0;          // of both axes [mm/s^2]
constexpr double resolution = 2.0 / 80.0 / 4e-4; // of a second difference of whole steps over 20 ms

struct Ending {
    const char* name;
    std::function<void(PortRig&)> end;
    hal::PortPhase phase;
    const char* why;
};

const std::array endings{
    Ending{"complete too early", [](PortRig& rig) { rig.port.complete(); }, hal::PortPhase::halted,
           "the motion ends before the axes are at rest"},
    Ending{"the planner delivers nothing more", [](PortRig&) {}, hal::PortPhase::running, ""},
    Ending{"the port is stopped", [](PortRig& rig) { rig.port.close(); }, hal::PortPhase::halted, ""},
    Ending{"quick stop", [](PortRig& rig) { rig.port.quick_stop(); }, hal::PortPhase::halted, ""},
    Ending{"a segment that does not join",
           [](PortRig& rig) {
               while (rig.port.room() == 0) {
                   rig.clock.sleep_us(1000);
               }
               FeedSegment segment;
               segment.duration_ticks = 8000;
               CHECK_FALSE(rig.port.submit(segment));
           },
           hal::PortPhase::halted, "a segment does not begin where the one before it ends"},
};

} // namespace

TEST_CASE("a motion that ends in its middle is braked on the path, within the axes' accelerations", "[stopping]") {
    const std::uint64_t seed = 35'001;
    for (std::size_t kind = 0; kind < endings.size(); ++kind) {
        for (std::uint64_t round = 0; round < static_cast<std::uint64_t>(rounds(8, 80)); ++round) {
            RandomPath random(seed + 1000 * kind + round);
            const double at_ms = random.between(100.0, 2200.0); // the motion has begun
            const Ending& ending = endings[kind];
            CAPTURE(ending.name, seed, round, at_ms);
            PortRig rig;
            hal::StraightMotion motion(rig.machine.settings, {0.0, 0.0}, {200.0, 100.0}, 100.0);
            static_cast<void>(rig.port.start());
            bool more = true;
            while (rig.now_ms() < at_ms && more) {
                more = rig.feed(motion);
                rig.clock.sleep_us(1000);
            }
            REQUIRE(more);
            ending.end(rig);
            rig.clock.sleep_us(250'000);
            CHECK(rig.port.at_standstill());
            CHECK(rig.port.poll().phase == ending.phase);
            CHECK(rig.port.failure().what == ending.why);
            const std::size_t rows = rig.lines.rows().size();
            rig.port.close();
            rig.port.power_off();
            CHECK(rig.lines.rows().size() <= rows + 2); // brake, enable
            CHECK_FALSE(rig.lines.enabled());
            CHECK(rig.port.position_known());
            for (unsigned k = 0; k < 2; ++k) {
                CHECK(rig.port.counts(static_cast<int>(k)) == rig.steps(k));
            }
            CHECK(std::llabs(rig.steps(0) - 2 * rig.steps(1)) <= 2); // on the line
            // While the plan itself brakes, the clock's slow-down comes on top.
            const bool cruises = at_ms > 250.0 && at_ms < 1900.0;
            CHECK(rig.most_acceleration(0) <= (cruises ? 1.05 : 2.0) * acceleration + resolution);
        }
    }
}

TEST_CASE("a motion that is complete too early before it begins moves nothing", "[stopping]") {
    PortRig rig;
    hal::StraightMotion motion(rig.machine.settings, {0.0, 0.0}, {200.0, 100.0}, 100.0);
    FeedSegment segment;
    REQUIRE(motion.next(segment));
    REQUIRE(rig.port.submit(segment));
    rig.port.complete();
    static_cast<void>(rig.port.start());
    rig.clock.sleep_us(100'000);
    CHECK(rig.port.poll().phase == hal::PortPhase::halted);
    CHECK(rig.steps(0) == 0);
    rig.port.close();
}

TEST_CASE("an e-stop between two motions leaves no drive on", "[stopping]") {
    PortRig rig;
    static_cast<void>(rig.port.start());
    rig.port.complete();
    rig.clock.sleep_us(100'000);
    rig.port.close();
    SECTION("behind the last one") {
        rig.port.disable();
        rig.port.power_off();
    }
    SECTION("before the next one") {
        rig.port.reset();
        rig.port.disable();
        static_cast<void>(rig.port.start());
    }
    SECTION("while the brake engages") {
        const auto switches = rig.clock.start([&] {
            rig.clock.sleep_us(10'000);
            rig.port.disable();
        });
        const double before_ms = rig.now_ms();
        rig.port.power_off();
        CHECK(rig.now_ms() < before_ms + 15.0);
        switches->join();
    }
    CHECK_FALSE(rig.lines.enabled());
    CHECK_FALSE(rig.port.position_known());
    CHECK(rig.port.poll().phase == hal::PortPhase::fault);
}

TEST_CASE("a thread that stands still is a fault within a bound, and disables the drives when it goes on",
          "[stopping]") {
    PortRig rig;
    hal::StraightMotion motion(rig.machine.settings, {0.0, 0.0}, {200.0, 100.0}, 100.0);
    static_cast<void>(rig.port.start());
    bool stalls = false;
    while (rig.port.poll().phase == hal::PortPhase::running) {
        rig.feed(motion);
        if (!stalls && rig.now_ms() > 500.0) {
            rig.lines.stall(10'000'000'000);
            stalls = true;
        }
        rig.clock.sleep_us(1000);
        REQUIRE(rig.now_ms() < 2600.0);
    }
    CHECK(rig.port.failure().what.find("the thread that makes steps has not run for 2 s") == 0);
    CHECK(rig.port.may_be_on());
    CHECK_FALSE(rig.port.position_known());
    rig.port.close();
    CHECK_FALSE(rig.lines.enabled());
    CHECK_FALSE(rig.port.may_be_on());
}
