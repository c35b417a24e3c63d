// SPDX-License-Identifier: MIT
// One motion of a SetpointPort behind the other, as a machine that is served has them.
#include "ports/run_plant.hpp"
#include "ports/setpoint_plant.hpp"

using namespace splinefeed;
using namespace splinefeed::hal;
using namespace splinefeed_test;

TEST_CASE("Setpoint port, virtual: motion follows motion, behind an end, a hold and a quick stop", "[ports]") {
    const SmoothMotion out_and_back = smooth_motion(20000.0, 2, 150, 4000);
    for (const char* const profile : setpoint_profiles) {
        INFO(profile);
        SetpointPlant plant({.profile = profile});
        REQUIRE_FALSE(plant.begin(out_and_back));
        PerAxis<std::int64_t> from{}; // [counts]
        for (const StopRequest stop :
             {StopRequest::none, StopRequest::hold, StopRequest::none, StopRequest::quick_stop, StopRequest::none}) {
            SmoothMotion motion = out_and_back;
            for (FeedSegment& segment : motion.segments) {
                for (unsigned k = 0; k < plant.drives.size(); ++k) {
                    segment.start[k] += from[k] * units_per_count;
                    segment.end[k] += from[k] * units_per_count;
                }
            }
            if (plant.next > 0) { // behind another motion
                REQUIRE_FALSE(plant.port->renew(motion.segments.front()));
            }
            plant.next = 0;
            plant.began_us = plant.clock.now_us();
            const std::uint64_t when_us = 700'000;
            const Asked asked{.hold_us = stop == StopRequest::hold ? when_us : UINT64_MAX,
                              .quick_us = stop == StopRequest::quick_stop ? when_us : UINT64_MAX};
            const PortPhase end = run(plant, motion, asked);
            CHECK(end == (stop == StopRequest::none ? PortPhase::idle : PortPhase::halted));
            for (unsigned k = 0; k < plant.drives.size(); ++k) {
                const std::int64_t stands = std::llround(plant.port->position_counts(k).value_or(0.0));
                CHECK((stop != StopRequest::none || std::abs(stands - from[k]) <= 2));
                CHECK((stop == StopRequest::none || std::abs(stands - from[k]) > 100));
                from[k] = stop == StopRequest::none ? from[k] : stands;
            }
        }
    }
}
