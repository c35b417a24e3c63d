// SPDX-License-Identifier: MIT
#include "host_sim/output/segment_writer.hpp"

#include "splinefeed/s3_feed_plan/limits/motion_limits.hpp"

namespace splinefeed::host {

SegmentWriter::SegmentWriter(OutputFile& file, const MachineDescription& machine)
    : file_(&file), axes_(static_cast<unsigned>(machine.settings.axes)) {
    file.append("# Each row is a cubic in time for each axis, given by position and velocity at both ends.\n");
    file.format("# duration_ticks: 1 tick = 1/{} us = {} s.\n", ticks_per_us, 1e-6 / ticks_per_us);
    for (unsigned k = 0; k < axes_; ++k) {
        const double steps_per_mm = machine.settings.axis[k].steps_per_mm;
        const std::string& name = machine.axis_name[k];
        file.format(
            "# {0}_start, {0}_end: position in units of 1/{1} count; {2} counts per mm; 1 unit = {3:.17g} mm.\n", name,
            units_per_count, steps_per_mm, 1.0 / (static_cast<double>(units_per_count) * steps_per_mm));
        file.format(
            "# {0}_v_start, {0}_v_end: velocity in the same units per duration of the segment; velocity in mm/s = "
            "value * {1:.17g} / duration_ticks.\n",
            name, ticks_per_us * 1e6 / (static_cast<double>(units_per_count) * steps_per_mm));
    }
    file.append("index,duration_ticks");
    for (unsigned k = 0; k < axes_; ++k) {
        file.format(",{0}_start,{0}_end,{0}_v_start,{0}_v_end", machine.axis_name[k]);
    }
    file.append("\n");
}

void SegmentWriter::segment(const FeedSegment& segment) {
    file_->format("{},{}", segment.index, segment.duration_ticks);
    for (unsigned k = 0; k < axes_; ++k) {
        file_->format(",{},{},{},{}", segment.start[k], segment.end[k], segment.start_velocity[k],
                      segment.end_velocity[k]);
    }
    file_->append("\n");
}

} // namespace splinefeed::host
