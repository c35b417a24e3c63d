// SPDX-License-Identifier: MIT
// TraceWriter: the trace .csv: what the axes were told at every sample period.
#pragma once

#include "host_sim/base/output_file.hpp"
#include "host_sim/config/machine_description.hpp"
#include "host_sim/machine/simulated_machine.hpp"

namespace splinefeed::host {

/// Header `t,<axis>,...,speed`; times in s, positions in mm, speed along the path in mm/s.
/// Times have 6 decimals where they are whole microseconds (all but perhaps the last are), else 9; positions 12,
/// speed 9. Cost of a row: about 0.1 us for three axes; no allocation. Errors: OutputError from the file.
class TraceWriter final : public TraceSink {
public:
    /// Writes the header. The caller commits the file, which must outlive the writer.
    TraceWriter(OutputFile& file, const MachineDescription& machine);

    void row(std::uint64_t ticks, const PerAxis<double>& position_mm, double speed_mm_s) override;

private:
    OutputFile* file_;
    unsigned axes_;
};

} // namespace splinefeed::host
