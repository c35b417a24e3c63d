// SPDX-License-Identifier: MIT
//
// What has to hold for everything that is emitted, a Stream or a SteeredRun.
#pragma once

#include "catch.hpp"
#include "stream_reference.hpp"

namespace splinefeed_test {

/// It ends, is a chain without a jump from rest to rest, and keeps every limit. Returns what it uses of them.
/// @param slack  of the acceleration, for scalars with few digits
template <class Run>
Used require_limits(const Run& run, const MachineSettings& machine, Real slack = 0.0L) {
    REQUIRE_FALSE(run.endless);
    Used used;
    REQUIRE(std::string(check_stream(run.segments, machine, used)) == "");
    CAPTURE(static_cast<double>(used.jerk), static_cast<double>(used.acceleration - 1.0L),
            static_cast<double>(used.velocity - 1.0L), static_cast<double>(used.feed - 1.0L));
    CHECK(used.jerk <= 1.0L);
    CHECK(used.acceleration <= 1.0L + slack);
    CHECK(used.velocity <= 1.0L);
    CHECK(used.feed <= 1.0L);
    return used;
}

/// It begins and ends exactly at these places.
template <class Run>
void require_ends(const Run& run, const MachineSettings& machine, const PerAxis<double>& start,
                  const PerAxis<double>& end) {
    for (unsigned k = 0; k < static_cast<unsigned>(machine.axes); ++k) {
        CAPTURE(k, start[k], end[k], machine.axis[k].steps_per_mm);
        REQUIRE(run.segments.front().start[k] == target_units(start[k], machine.axis[k]));
        REQUIRE(run.segments.back().end[k] == target_units(end[k], machine.axis[k]));
    }
}

template <class Run>
void require_ends(const Run& run, const MachineSettings& machine, const Program& program) {
    require_ends(run, machine, program.points.front().mm, program.points.back().mm);
}

} // namespace splinefeed_test
