// SPDX-License-Identifier: MIT
// TraceWriter: writes the trace .csv: the planned positions of the axes at every sample period.
#pragma once

#include "host_sim/base/output_file.hpp"
#include "host_sim/config/machine_description.hpp"
#include "host_sim/machine/simulated_machine.hpp"

namespace splinefeed::host {

/// Header `t,<axis>,...,speed`, and `,line` for programs; times in s, positions in mm, speed along the path in mm/s.
/// Times have 6 decimals if they are whole microseconds (all except perhaps the last), otherwise 9; positions have 12,
/// speed has 9. Cost of a row: about 0.1 us for three axes; no allocation. Errors: OutputError from the file.
class TraceWriter final : public TraceSink {
public:
    /// Writes the header. The caller commits the file, which must outlive the writer.
    /// @param has_lines  there is a column line
    TraceWriter(OutputFile& file, const MachineDescription& machine, bool has_lines = false);

    /// Line of the program that the rows from now on come from.
    void set_line(std::uint64_t line) noexcept { line_ = line; }

    void row(std::uint64_t ticks, const PerAxis<double>& position_mm, double speed_mm_s) override;

private:
    OutputFile* file_;
    unsigned axes_;
    bool has_lines_;
    std::uint64_t line_ = 0;
};

} // namespace splinefeed::host
