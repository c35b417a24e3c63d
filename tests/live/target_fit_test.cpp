// SPDX-License-Identifier: MIT
#include "host_sim/live/target_fit.hpp"

#include "live/talking_target.hpp"
#include "support/catch.hpp"

using namespace splinefeed_test;

TEST_CASE("what a target cannot carry in its segments is refused before anything moves", "[live]") {
    TalkingWorld world{"slow"};
    const TalkingTarget target(world);
    MachineDescription machine = talking_machine();
    machine.settings.sample_period_us = 2000;
    machine.settings.segments_per_sample = 1;
    CHECK_THROWS_WITH(fit_to_target(machine, ScalarKind::fixed, target, true),
                      "its registers do not hold that in 2000 us");
    world.clear("slow");
    CHECK(fit_to_target(machine, ScalarKind::fixed, target, true).segment_ticks == 16'000);
}
