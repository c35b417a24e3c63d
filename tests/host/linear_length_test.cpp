// SPDX-License-Identifier: MIT
#include "host_sim/analysis/linear_length.hpp"

#include "support/catch.hpp"
#include "support/machine_motion.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

TEST_CASE("millimetres count, degrees do not; where there is nothing else they do") {
    MachineSettings machine = machine_of({"x", "y", "a"}).settings;
    FeedSegment straight; // at one speed
    straight.duration_ticks = millisecond;
    straight.end = {units(30.0), units(40.0), units(120.0)};
    straight.start_velocity = straight.end_velocity = straight.end;
    const auto length_of = [&] {
        LinearLength length(machine);
        length.add(straight);
        return length;
    };
    CHECK_FALSE(length_of().is_part());
    CHECK(length_of().mm() == Approx(130.0).epsilon(1e-9));
    machine.axis[2].rotary = true;
    CHECK(length_of().is_part());
    CHECK(length_of().mm() == Approx(50.0).epsilon(1e-9));
    machine.axis[0].rotary = machine.axis[1].rotary = true;
    CHECK_FALSE(length_of().is_part());
    CHECK(length_of().mm() == Approx(130.0).epsilon(1e-9));
}
