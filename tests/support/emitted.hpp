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
    for (const unsigned k : splinefeed::indices(machine.axes)) {
        CAPTURE(k, start[k], end[k], machine.axis[k].steps_per_mm);
        REQUIRE(run.segments.front().start[k] == target_units(start[k], machine.axis[k]));
        REQUIRE(run.segments.back().end[k] == target_units(end[k], machine.axis[k]));
    }
}

/// The last point that is no part of the one before: WaypointCurve merges what is within 0.1 um.
inline const PerAxis<double>& last_apart(const Program& program) {
    const PerAxis<double>* last = &program.points.front().mm;
    for (const auto& point : program.points) {
        for (const unsigned k : splinefeed::indices(program.axes)) {
            const std::int64_t move = position_from_mm(point.mm[k]).raw - position_from_mm((*last)[k]).raw;
            if (std::abs(move) >= (std::int64_t{1} << 40) / 10000) {
                last = &point.mm;
                break;
            }
        }
    }
    return *last;
}

template <class Run>
void require_ends(const Run& run, const MachineSettings& machine, const Program& program) {
    require_ends(run, machine, program.points.front().mm, last_apart(program));
}

} // namespace splinefeed_test
