// SPDX-License-Identifier: MIT
// Outputs: the files of one run, opened together and committed together.
#pragma once

#include "host_sim/base/output_file.hpp"
#include "host_sim/output/curve_writer.hpp"
#include "host_sim/output/edge_writer.hpp"
#include "host_sim/output/segment_writer.hpp"
#include "host_sim/output/trace_writer.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace splinefeed::host {

/// Names of the outputs of a run. Empty: no such output; "-": standard output.
struct OutputNames {
    std::string trace;
    std::string segments;
    std::string edges;
    std::string curve;
    bool prints_summary = true; ///< on standard output
};

/// A writer exists if its output has a name. Without commit() nothing is left.
class Outputs {
public:
    /// Opens only the curve. Throws OutputError, as every method does.
    Outputs(const OutputNames& names, std::string_view method, bool closed);
    /// Opens every output that has a name.
    Outputs(const OutputNames& names, std::string_view method, bool closed, const MachineDescription& machine);

    [[nodiscard]] TraceWriter* trace() noexcept { return trace_ ? &*trace_ : nullptr; }
    [[nodiscard]] SegmentWriter* segments() noexcept { return segments_ ? &*segments_ : nullptr; }
    [[nodiscard]] EdgeWriter* edges() noexcept { return edges_ ? &*edges_ : nullptr; }
    [[nodiscard]] CurveWriter* curve() noexcept { return curve_ ? &*curve_ : nullptr; }

    /// Completes the files and puts them in place. @pre the writers have received everything
    /// @param results  of the curve's method, written after its segments; null: none
    void commit(const nlohmann::ordered_json* results = nullptr);

private:
    std::optional<OutputFile> trace_file_;
    std::optional<OutputFile> segments_file_;
    std::optional<OutputFile> edges_file_;
    std::optional<OutputFile> curve_file_;
    std::optional<TraceWriter> trace_;
    std::optional<SegmentWriter> segments_;
    std::optional<EdgeWriter> edges_;
    std::optional<CurveWriter> curve_;
};

} // namespace splinefeed::host
