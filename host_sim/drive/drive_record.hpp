// SPDX-License-Identifier: MIT
// DriveRecord: the positions of the shafts of a simulated drive, one row per millisecond; SegmentRecord: the segments
// that it executed.
#pragma once

#include "host_sim/base/output_file.hpp"
#include "host_sim/drive/drive_model.hpp"
#include "host_sim/drive/pvt_machine.hpp"

#include <string>

namespace splinefeed::host {

/// Header `t,a0,a1,...`; t in s with 3 decimals, shafts in counts with 6.
class DriveRecord {
public:
    /// @param start_s  CLOCK_MONOTONIC at t = 0. Throws OutputError if the file cannot be created.
    DriveRecord(const std::string& path, std::string_view profile, int axes, double start_s);
    /// Throws OutputError.
    void row(std::uint64_t time_ms, const DriveModel& drive);
    void commit() { file_.commit(); }

private:
    OutputFile file_;
};

/// Header `sequence,duration_ticks,a0_end,a0_v_end,...,t_end`: the integers of the map, and the drive's time at the end
/// in s. The duration does not contain the rest mark.
class SegmentRecord {
public:
    /// Throws OutputError if the file cannot be created.
    SegmentRecord(const std::string& path, int axes);
    void row(const ExecutedSegment& executed);
    void commit() { file_.commit(); }

private:
    OutputFile file_;
    unsigned axes_;
};

} // namespace splinefeed::host
