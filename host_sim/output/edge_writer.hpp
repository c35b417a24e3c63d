// SPDX-License-Identifier: MIT
// EdgeWriter: writes the edges .csv: the edges of the step and direction lines, on a virtual clock.
#pragma once

#include "host_sim/base/output_file.hpp"
#include "host_sim/config/machine_description.hpp"
#include "host_sim/output/segment_output.hpp"

#include "splinefeed/s5_pulse_train/any_pulse_train.hpp"

#include <array>
#include <string>

namespace splinefeed::host {

/// A header `t_ns,axis,line,value`, one row an edge, in order of time; t = 0 is the start of the first feed segment.
/// Each motor of an axis has its rows: the second one's axis is named with a 2 behind. No allocation per row.
class EdgeWriter final : public SegmentOutput {
public:
    /// Writes the header. The caller commits the file, which must outlive the writer. Throws OutputError from the file,
    /// as every method does, and InputError if the lines cannot carry the machine's limits (step_lines.hpp).
    EdgeWriter(OutputFile& file, const MachineDescription& machine);

    void segment(const FeedSegment& segment) override;
    void finish() override;

private:
    void drain();
    void row(const Edge& edge);

    OutputFile* file_;
    AnyPulseTrain train_;
    PerAxis<StepMotors> motors_;
    PerAxis<std::array<std::string, 2>> name_{};
};

} // namespace splinefeed::host
