// SPDX-License-Identifier: MIT
//
// Motions of a GpioPort, one behind the other.
#include "port_rig.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;
using namespace splinefeed_test;

namespace {

struct Motions : TargetRig {
    Motions() : TargetRig(two_axes(), map_text), port(run_target().port()) {}

    [[nodiscard]] RunTarget& run_target() { return *target; }
    /// Of x, in units, in 200 ms. Returns how it ended.
    hal::PortPhase move(std::int64_t from, std::int64_t to) {
        FeedSegment segment{.duration_ticks = 1'600'000};
        segment.start[0] = from;
        segment.end[0] = to;
        REQUIRE_FALSE(port.renew(segment));
        static_cast<void>(port.submit(segment));
        port.complete();
        hal::PortPhase phase = hal::PortPhase::running;
        for (int ms = 0; ms < 2000 && (phase = port.poll().phase) == hal::PortPhase::running; ++ms) {
            clock.sleep_us(1000);
        }
        return phase;
    }
    [[nodiscard]] double x_counts() const { return target->places()[0].mm.value() * steps_per_mm; }

    hal::MotionPort& port;
};

} // namespace

TEST_CASE("motions that begin a little beside the middle between two counts lose no step", "[serve]") {
    Motions motions;
    constexpr std::int64_t middle = 10 * units_per_count + units_per_count / 2;
    for (const std::int64_t off : {0, -1, 1, -7}) {
        CHECK(motions.move(0, middle + (off > 0 ? -1 : 0)) == hal::PortPhase::idle);
        CHECK(motions.x_counts() == (off > 0 ? 10.0 : 11.0));
        CHECK(motions.move(middle + off, 0) == hal::PortPhase::idle);
        CHECK(motions.x_counts() == 0.0);
    }
}

TEST_CASE("a motion that begins elsewhere than where its axis stands is refused", "[serve]") {
    Motions motions;
    CHECK(motions.move(0, 10 * units_per_count) == hal::PortPhase::idle);
    CHECK(motions.move(9 * units_per_count, 0) == hal::PortPhase::halted);
    CHECK(motions.x_counts() == 10.0);
    CHECK(motions.run_target().signs().stop.why == "axis x stands at 0.125 mm, and its motion begins at 0.1125 mm");
}
