// SPDX-License-Identifier: MIT
// SegmentWriter: writes the segments .csv: the feed segments of the machine, in integers.
#pragma once

#include "host_sim/base/output_file.hpp"
#include "host_sim/config/machine_description.hpp"
#include "host_sim/output/segment_output.hpp"

namespace splinefeed::host {

/// `#` lines with the units, a header `index,duration_ticks,<axis>_start,<axis>_end,<axis>_v_start,<axis>_v_end,...`,
/// one row a segment. No allocation per row. Errors: OutputError from the file.
class SegmentWriter final : public SegmentOutput {
public:
    /// Writes the header. The caller commits the file, which must outlive the writer.
    SegmentWriter(OutputFile& file, const MachineDescription& machine);

    void segment(const FeedSegment& segment) override;

private:
    OutputFile* file_;
    unsigned axes_;
};

} // namespace splinefeed::host
