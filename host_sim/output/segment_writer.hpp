// SPDX-License-Identifier: MIT
// SegmentWriter: writes the segments .csv: the feed segments of the machine, in integers.
#pragma once

#include "host_sim/base/output_file.hpp"
#include "host_sim/config/machine_description.hpp"

#include "splinefeed/s4_segment_stream/feed_segment.hpp"

namespace splinefeed::host {

/// `#` lines with the units, a header `index,duration_ticks,<axis>_start,<axis>_end,<axis>_v_start,<axis>_v_end,...`,
/// then one row per segment. No allocation per row. Errors: OutputError from the file.
class SegmentWriter {
public:
    /// Writes the header. The caller commits the file, which must outlive the writer.
    SegmentWriter(OutputFile& file, const MachineDescription& machine);

    void segment(const FeedSegment& segment);

private:
    OutputFile* file_;
    unsigned axes_;
};

} // namespace splinefeed::host
