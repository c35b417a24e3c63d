// SPDX-License-Identifier: MIT
#include "host_sim/config/doubtful_numbers.hpp"

#include "host_sim/config/machine_file.hpp"
#include "support/catch.hpp"

using namespace splinefeed;
using namespace splinefeed::host;

TEST_CASE("Numbers that look like those of another unit are told, with what they would be") {
    using Texts = std::vector<std::string>;
    MachineDescription machine = default_machine();
    CHECK(doubtful_numbers(machine).empty());
    machine.settings.axis[0].max_velocity_mm_s = 8000.0;
    machine.settings.max_feed_mm_s = 0.3;
    CHECK(doubtful_numbers(machine) == Texts{"max_feed_mm_s is 0.3: is that m/s? Then it is 300",
                                             "max_velocity_mm_s of x is 8000: is that mm/min? Then it is 133.333333"});
    machine = default_machine();
    machine.settings.axis[1].max_acceleration_mm_s2 = 2.5;
    machine.settings.axis[2].max_jerk_mm_s3 = 20.0;
    CHECK(doubtful_numbers(machine) ==
          Texts{"max_acceleration_mm_s2 of y is 2.5: is that m/s^2? Then it is 2500",
                "max_jerk_mm_s3 of z is 20: is that m/s^3, or a jump of the velocity, as in Marlin? Then it is 20000"});
    machine = default_machine();
    machine.settings.axis[0].max_acceleration_mm_s2 = 360'000.0;
    CHECK(doubtful_numbers(machine) ==
          Texts{"max_acceleration_mm_s2 of x is 360000: is that mm/min^2? Then it is 100"});
    // The ends of what machines have are no doubt, nor is what turns.
    machine.settings.axis[0] = {
        .max_velocity_mm_s = 2000.0, .max_acceleration_mm_s2 = 100'000.0, .max_jerk_mm_s3 = 1e8};
    machine.settings.axis[1] = {.max_velocity_mm_s = 0.5, .max_acceleration_mm_s2 = 5.0, .max_jerk_mm_s3 = 100.0};
    machine.settings.axis[2] = {.max_velocity_mm_s = 9000.0, .max_acceleration_mm_s2 = 1.0, .rotary = true};
    CHECK(doubtful_numbers(machine).empty());
}
