// SPDX-License-Identifier: MIT
#include "host_sim/drive/drive_record.hpp"

#include <cmath>
#include <cstdlib>

namespace splinefeed::host {

DriveRecord::DriveRecord(const std::string& path, std::string_view profile, int axes, double start_s) : file_(path) {
    file_.format("# splinefeed drive, profile {}; shafts in counts, t in s of the drive's own time\n", profile);
    file_.format("# t = 0 is CLOCK_MONOTONIC {:.6f} s\n", start_s);
    file_.append("t");
    for (int k = 0; k < axes; ++k) {
        file_.format(",a{}", k);
    }
    file_.append("\n");
}

void DriveRecord::row(std::uint64_t time_ms, const DriveModel& drive) {
    constexpr std::int64_t scale = 1'000'000;
    file_.format("{}.{:03}", time_ms / 1000, time_ms % 1000);
    for (int k = 0; k < drive.axes(); ++k) {
        const std::int64_t millionths = std::llround(drive.position_counts(k) * scale);
        file_.format(",{}{}.{:06}", millionths < 0 ? "-" : "", std::abs(millionths / scale),
                     std::abs(millionths % scale));
    }
    file_.append("\n");
}

SegmentRecord::SegmentRecord(const std::string& path, int axes) : file_(path), axes_(static_cast<unsigned>(axes)) {
    file_.append("# positions in 1/65536 count, velocities in 1/16777216 count per duration, 8000000 ticks a second\n");
    file_.append("sequence,duration_ticks");
    for (unsigned k = 0; k < axes_; ++k) {
        file_.format(",a{0}_end,a{0}_v_end", k);
    }
    file_.append(",t_end\n");
}

void SegmentRecord::row(const ExecutedSegment& executed) {
    file_.format("{},{}", executed.sequence, executed.segment.duration_ticks);
    for (unsigned k = 0; k < axes_; ++k) {
        file_.format(",{},{}", executed.segment.end[k], executed.segment.end_velocity[k]);
    }
    file_.format(",{:.9f}\n", executed.end_us * 1e-6);
}

} // namespace splinefeed::host
